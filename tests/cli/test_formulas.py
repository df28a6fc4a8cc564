# SPDX-License-Identifier: GPL-3.0-or-later
"""Formulas of docs/reference/theories.md are those of the code: their TeX is evaluated at a point, and compared with
what `graingas theory` prints there."""
import json
import math
import os
import re
import sys

from tap import Skip, check, main, run

try:
    import numpy as np
except ImportError:
    np = None

SOURCE = os.environ["SOURCE"]
with open(os.path.join(SOURCE, "docs", "reference", "theories.md"), encoding="utf-8") as file:
    PAGE = file.read()
TOKEN = re.compile(r"\\[a-zA-Z]+|\\\\|\\[{}]|\d+(?:\.\d+)?|[a-zA-Z]|[-+/^_{}()\[\]&=]")


class Formulas:
    """Definitions `name = expression` of a text, in TeX; the value of a name, by way of the others."""

    def __init__(self, text, **known):
        if np is None:
            raise Skip("numpy is not installed")
        self.value = {"\\pi": math.pi, **known}
        self.tex = {}
        text = re.sub(r"\\(?:left|right|bigl|bigr)(?![a-z])|(?<!\\)\\[,;!]", " ", re.sub(r"\\text\{[^}]*\}", " ", text))
        for formula in re.findall(r"\$\$(.*?)\$\$|\$([^$]+)\$", text, re.DOTALL):
            for part in re.split(r"\\q?quad", "".join(formula).replace("tfrac", "frac")):
                name, equals, rest = part.partition("=")
                key = "matrix" if name.strip().startswith(r"\begin") else name.replace(" ", "").strip("\n")
                if equals and key not in self.tex:
                    self.tex[key] = rest.strip().rstrip(",.")

    def __getitem__(self, name):
        if name not in self.value:
            self.value[name] = self.evaluate(self.tex[name])
        return self.value[name]

    def evaluate(self, tex):
        tokens = TOKEN.findall(tex)
        before, self.tokens = getattr(self, "tokens", None), tokens
        value = self.sum()
        check(not tokens, "not all was read:", tex, tokens)
        self.tokens = before
        return value

    def take(self, *expected):
        token = self.tokens.pop(0)
        check(not expected or token in expected, token, expected)
        return token

    def next(self):
        return self.tokens[0] if self.tokens else ""

    def sum(self):
        value = 0.0 if self.next() in ("-", "+") else self.product()
        while self.next() in ("-", "+"):
            sign = -1 if self.take() == "-" else 1
            value = value + sign * self.product()
        return value

    def product(self):
        value = None
        while self.next() not in ("", "+", "-", ")", "]", "}", "\\}", "&", "\\\\", "\\end", "="):
            if self.next() == "/":
                self.take()
                value = value / self.factor()
                continue
            factor = self.factor()
            both = isinstance(value, np.ndarray) and isinstance(factor, np.ndarray)
            value = factor if value is None else value @ factor if both else value * factor
        return value

    def factor(self):
        base = self.base()
        if self.next() != "^":
            return base
        self.take()
        power = self.argument()
        return np.linalg.inv(base) if isinstance(base, np.ndarray) and power == -1 else base**power

    def argument(self):
        """A group, a command, or a single digit."""
        if self.next() == "{":
            return self.group("}")
        if self.next()[0].isdigit() and len(self.next()) > 1:
            digits = self.take()
            self.tokens.insert(0, digits[1:])
            return float(digits[0])
        return self.base()

    def group(self, end):
        self.take()
        value = self.sum()
        self.take(end)
        return value

    def base(self):
        ends = {"(": ")", "[": "]", "{": "}", "\\{": "\\}"}
        if self.next() in ends:
            return self.group(ends[self.next()])
        token = self.take()
        if token[0].isdigit():
            return float(token)
        if token == "\\frac":
            return self.argument() / self.argument()
        if token == "\\sqrt":
            return math.sqrt(self.argument())
        if token == "\\begin":
            return self.matrix()
        if self.next() == "_":
            token += self.take() + (self.take() if self.tokens[0] != "{" else self.braces())
        return self[token]

    def braces(self):
        text = self.take("{")
        while text[-1] != "}":
            text += self.take()
        return text

    def matrix(self):
        self.braces_word("pmatrix")
        rows = [[self.sum()]]
        while self.next() != "\\end":
            if self.take("&", "\\\\") == "\\\\":
                rows.append([])
            rows[-1].append(self.sum())
        self.take()
        self.braces_word("pmatrix")
        return np.array(rows)

    def braces_word(self, word):
        check(self.braces() == "{" + word + "}")


def section(title):
    return re.search(rf"^## {title}.*?\n(.*?)(?=^## )", PAGE, re.MULTILINE | re.DOTALL)[1]


def symbols():
    return re.search(r"^\*\*Symbols\.\*\*.*", PAGE, re.MULTILINE)[0]


def printed(theory, scene):
    done = run("theory", "-", "--json", typed=scene)
    check(done.code == 0, done.err)
    return {name: value["mean"] for name, value in json.loads(done.out)["theory"][theory].items()}


def same(found, expected):
    wrong = {name: (found[name], value) for name, value in expected.items() if not abs(found[name] / value - 1) < 1e-10}
    check(len(expected) > 0 and not wrong, wrong)


def chi(phi):
    return (1 - phi / 2) / (1 - phi)**3


def test_the_reader_of_tex():
    """Fractions of single digits, powers, roots, groups, implied products, matrices."""
    f = Formulas(r"$a = \tfrac85\sqrt\pi\,b^2c/(2b)$ and $$d_n = -\frac{1}{2}\left[1 + \sqrt{b}\right] , \qquad m = 2\begin{pmatrix}1 & b\\ 0 & 1"
                 r"\end{pmatrix}^{-1}\begin{pmatrix}1\\ b\end{pmatrix}$$", b=4.0, c=3.0)
    check(f["a"] == 1.6 * math.sqrt(math.pi) * 16 * 3 / 8 and f["d_n"] == -1.5, f.value)
    check(np.allclose(f["m"], [[-30], [8]]), f["m"])


def test_lun1991_is_its_formulas():
    """T, theta/T, pressure and six coefficients of a sheared gas of rough grains."""
    phi, e, beta = 0.2, 0.85, 0.3
    found = printed("lun1991", f"{{flow: usf, phi: {phi}, collision: {{e: {e}, beta: {beta}}}, species: [{{inertia: 0.3}}]}}")
    text = section("lun1991")
    f = Formulas(symbols() + text, e=e, K=0.3, n=6 * phi / math.pi, **{"\\beta": beta, "\\phi": phi, "\\chi": chi(phi)})
    f.tex["T"] = re.search(r"T = \\dot\\gamma\^2 (.*?), ", text)[1]
    f.value["r"] = f.evaluate(re.search(r"r = (\\frac\{K.*?), ", text)[1])
    rho = 6 / math.pi
    coefficients = f["matrix"] / rho
    same(found, {"temperature": f["T"], "temperature_ratio": f["r"], "pressure": f["T"] * f["f_1"] / rho,
                 "shear_viscosity": math.sqrt(f["T"]) * f["f_2"] / rho, "bulk_viscosity": f["\\xi"] / rho,
                 "rotational_viscosity": f["\\mu_r"] / rho, "thermal_conductivity": coefficients[0, 0],
                 "thermal_conductivity_cross": coefficients[0, 1], "rotational_conductivity_cross": coefficients[1, 0],
                 "rotational_conductivity": coefficients[1, 1]})


def test_garzo_dufty1999():
    """a2, cooling rate, pressure, viscosity and both conductivities of a cooling gas."""
    phi, e = 0.3, 0.8
    found = printed("garzo_dufty1999", f"{{flow: hcs, phi: {phi}, collision: {{e: {e}}}}}")
    text = section("garzo_dufty1999")
    f = Formulas(text, e=e, s=0.5, n=6 * phi / math.pi, T=1.0, **{"\\phi": phi, "\\chi": chi(phi)})
    numerator = re.search(r"numerator of \$a_2\$ is \$(.*?)\$", text)[1]
    denominator = re.search(r"\(`garzo_dufty1999`\) \| cooling, Gaussian \| \$(.*?)\$", text)[1]
    a2 = f.evaluate(numerator) / f.evaluate(denominator)
    f.value.update({"c": 2 * a2, "\\lambda": phi * (3 / (1 - phi) - 0.5 / (1 - phi / 2))})
    same(found, {"a2": a2, "cooling_rate": f["\\zeta"], "compressibility_factor": f["p"] / f["n"],
                 "viscosity_reduced": f["\\eta"], "viscosity_reduced_kinetic": f["\\eta_k"],
                 "thermal_conductivity_reduced": f["\\kappa"],
                 "diffusive_heat_conductivity_reduced": f["\\mu"]})


def test_haff1983_is_its_formulas():
    found = printed("haff1983", "{flow: hcs, phi: 0.1, collision: {e: 0.7}}")
    same(found, {"cooling_rate": Formulas(section("haff1983"), e=0.7, **{"\\chi": chi(0.1)})["\\zeta^*"]})


if __name__ == "__main__":
    main(sys.modules[__name__])

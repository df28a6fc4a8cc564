# SPDX-License-Identifier: GPL-3.0-or-later
"""Units of results, which are products of powers: "rho_p d^2 gamma^2" over "d^2 gamma^2" is "rho_p"."""
import re
from fractions import Fraction
from functools import lru_cache

ORDER = ["rho_p", "n", "m", "d", "v_0", "gamma"]  # in which the library writes units
TOKEN = re.compile(r"\s*([()/^]|[^\s()/^]+)")


@lru_cache(maxsize=None)
def parse(text):
    """Pairs of a factor and its exponent, in the order above. A text that is no product is one factor."""
    tokens = TOKEN.findall(text)
    try:
        powers, end = _product(tokens, 0)
        if end != len(tokens):
            raise ValueError
    except (ValueError, IndexError):
        powers = {text.strip(): 1}
    return _sorted(powers)


def _fraction(power):
    """The simple fraction with these six digits: 0.333333 is 1/3."""
    near = float(Fraction(power).limit_denominator(60))
    return near if abs(near - power) < 1e-5 else power


def _sorted(powers):
    rounded = {name: _fraction(power) for name, power in powers.items()}
    kept = [(name, power) for name, power in rounded.items() if power and name not in ("1", "")]
    return tuple(sorted(kept, key=lambda pair: (ORDER.index(pair[0]) if pair[0] in ORDER else len(ORDER), pair[0])))


def _product(tokens, at):
    powers, sign = {}, 1
    while at < len(tokens) and tokens[at] != ")":
        if tokens[at] == "/":
            sign, at = -1, at + 1
        factor, at = _factor(tokens, at)
        for name, power in factor.items():
            powers[name] = powers.get(name, 0) + sign * power
        sign = 1
    return powers, at


def _factor(tokens, at):
    if tokens[at] == "(":
        powers, at = _product(tokens, at + 1)
        at += 1  # the bracket that closes, or IndexError below
        if tokens[at - 1] != ")":
            raise ValueError
    elif tokens[at] in ")/^":
        raise ValueError
    else:
        powers, at = {tokens[at]: 1}, at + 1
    if at < len(tokens) and tokens[at] == "^":
        exponent = float(tokens[at + 1])
        powers, at = {name: power * exponent for name, power in powers.items()}, at + 2
    return powers, at


def write(powers):
    """The text of pairs: "rho_p d^2/gamma", "1/(n d^2)"."""
    def words(some):
        return " ".join(name if power == 1 else f"{name}^{power:g}" for name, power in some)
    above = [(name, power) for name, power in powers if power > 0]
    below = [(name, -power) for name, power in powers if power < 0]
    under = f"/{words(below)}" if len(below) == 1 else f"/({words(below)})" if below else ""
    return (words(above) or "1") + under


def _combined(a, b, sign):
    powers = dict(parse(a))
    for name, power in parse(b):
        powers[name] = powers.get(name, 0) + sign * power
    found = _sorted(powers)
    return next((unit for unit in (a, b) if parse(unit) == found), None) or write(found)


def product(a, b):
    return _combined(a, b, 1)


def ratio(a, b):
    return _combined(a, b, -1)


def power(unit, exponent):
    return unit if exponent == 1 else write(_sorted({name: p * exponent for name, p in parse(unit)}))


def alike(a, b):
    return parse(a) == parse(b)

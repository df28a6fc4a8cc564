# SPDX-License-Identifier: GPL-3.0-or-later
"""graingas info WORD: a quantity, a theory, a scene key, a flow, an observable in five lines; the nearest word otherwise."""
import sys

from tap import check, main, page, run


def lines(word):
    """The whole definition. In a terminal of 80 columns: five lines at most, and what is left out is said."""
    narrow, whole, wide = run("info", word), run("info", word, "--all"), run("info", word, columns=2000)
    for done in narrow, whole, wide:
        check(done.code == 0 and not done.err, word, done.err)
        check(all(len(row) <= 80 for row in done.out.splitlines()) or done is wide, done.out)
    check(2 <= len(narrow.out.splitlines()) <= 5, word, narrow.out)
    text = " ".join(whole.out.split())
    check(text == " ".join(wide.out.split()) and "(--all)" not in text, whole.out, wide.out)
    check(("... (--all)" in narrow.out) == (" ".join(narrow.out.split()) != text), narrow.out, whole.out)
    return text


def test_each_kind_of_word_has_entries():
    """Each kind of word has its own entries."""
    for word, parts in (("N1", ("symbol N_1", "(P_xx - P_yy)/p", "a pure number", "measured in always", "sela_goldhirsch1998")),
                        ("temperature_1", ("m_i<C.C>_i/3", "mixtures", "garzo_montanero2003")),
                        ("lun1991", ("J. Fluid Mech. 233 (1991) 539", "answers", "temperature_ratio", "; flows: usf", "range")),
                        ("run.relative_error", ("headline quantity", "at most 1, or auto", "default: auto", "effect if")),
                        ("relative_error", ("run.relative_error: a key",)), ("walls.speed", ("flow couette", "unit: velocity")),
                        ("fraction", ("a key of a species",)), ("species.torque", ("torque: a key of a species",)), ("usf", ("a flow",)), ("dsmc", ("an engine",)),
                        ("pair_correlation", ("an observable", "docs/reference/support.md", "observables.md"))):
        out = lines(word)
        for part in parts:
            check(part in out, word, part, out)


def test_every_name():
    """Whatever the tables name has a definition."""
    names = [row.split("`")[1] for name in ("scene", "quantities") for row in page(name).splitlines()
             if row.startswith("| `")]
    check(len(names) > 80, names)
    for name in names[::5]:
        lines(name)


def test_words_of_the_field():
    """Words that people use lead to the entry."""
    for word, entry in (("friction", "collision.mu: a key"), ("Roughness", "collision.beta: a key"), ("T", "temperature: a quantity"),
                        ("Haff", "haff1983: "), ("lees-edwards", "shear_rate: a key"), ("Lambda", "cos2_psi: a quantity")):
        done = run("info", word)
        check(done.code == 0 and done.out.startswith(entry), word, done.out, done.err)


def test_unknown_words():
    """An unknown word is an error with the nearest known one; what looks like a file is a file."""
    for word, nearest in (("templature", "temperature"), ("lun1919", "lun1991"), ("relativ_error", "relative_error"),
                          ("sonin", "sonine")):
        done = run("info", word)
        check(done.code == 2 and f"did you mean '{nearest}'?" in done.err and not done.out, word, done.err)
    done = run("info", "xyzzy_plugh")
    check(done.code == 2 and "is no file, scene key, quantity, theory or observable" in done.err, done.err)
    for path in "N1.yaml", "folder/N1", "N1.h5":
        done = run("info", path)
        check(done.code == 3 and path in done.err, path, done.err)
    check(run("info", "N1", "--json").code == 2)
    done = run("info", "scene.yaml", "--all", scene="flow: usf\nphi: 0.1\n")
    check(done.code == 2 and "only with a WORD" in done.err, done.err)
    check("flow" in run("info", "N1", scene="flow: usf\nphi: 0.1\n", name="N1").out, "a file of that name comes first")


def test_headline_quantities():
    """A scene says which quantities end its run."""
    out = run("info", "scene.yaml", scene="flow: usf\nphi: 0.1\n", columns=200).out
    check("headline quantities (run.relative_error applies to these): temperature, pressure, shear_viscosity" in out, out)
    out = run("info", "scene.yaml", scene="flow: hcs\nphi: 0.1\ncollision: {e: 0.9}\n", columns=200).out
    check("applies to these): cooling_rate" in out, out)


if __name__ == "__main__":
    main(sys.modules[__name__])

# SPDX-License-Identifier: GPL-3.0-or-later
"""graingas cite: BibTeX of the program and of the methods of a result; each theory's source has its entry."""
import json
import os
import re

from tap import check, main, run

SOURCE = os.environ["SOURCE"]


def cited(*args):
    done = run("cite", *args)
    check(done.code == 0 and not done.err, done.err)
    return re.findall(r"^@\w+\{(\w+),$", done.out, re.MULTILINE), done.out


def test_the_program():
    keys, text = cited()
    check(keys == ["graingas"] and "example" in text and "%" not in text and "graingas = {" not in text, text)


def test_words():
    """An entry of two methods appears once. An unknown word is an error."""
    check(cited("md")[0] == ["graingas", "AlderWainwright1959", "LeesEdwards1972"])
    check(cited("lun1991")[0] == ["graingas", "Lun1991"])
    check(cited("gaussian_closure")[0] == ["graingas", "JenkinsRichman1988", "SahaAlam2016"])
    check(cited("saha_alam2016,gaussian_closure lun1991")[0] == ["graingas", "Lun1991", "JenkinsRichman1988", "SahaAlam2016"])
    for word in "lun199", "un1991", "=", "}":
        done = run("cite", word)
        check(done.code == 2 and f"'{word}': no reference" in done.err and not done.out, word, done.err)
    check(run("cite", "nothing.h5").code == 3)


def test_a_result():
    """Engines that ran, and theories that answered."""
    scene = "flow: usf\nphi: 0.1\nparticles: 100\ncollision: {e: 0.9, beta: 0.2}\nrun: {collisions: 50, warmup: 10}\n" \
            "theories: {mine: {N1: phi}}\n"
    done = run("compare", "scene.yaml", "--json", "--picture", "none", "--output", "c.h5", scene=scene)
    answered = {name for name, of in json.loads(done.out)["theory"].items() if of}
    keys = set(cited("c.h5")[0])
    check({"graingas", "AlderWainwright1959", "MontaneroSantos1996"} < keys, keys)
    check("mine" in answered and ("Lun1991" in keys) == ("lun1991" in answered) and "Haff1983" not in keys, keys, answered)
    run("run", "scene.yaml", "--engine", "dsmc", "--output", "d.h5")
    check(set(cited("d.h5")[0]) == {"graingas", "MontaneroSantos1996", "MontaneroSantos1997", "Enskog1922"}, cited("d.h5")[0])


def entries():
    with open(os.path.join(SOURCE, "src", "theory", "references.bib"), encoding="utf-8") as file:
        text = file.read()
    check(text.count("{") == text.count("}"))
    found = []
    for body in re.findall(r"^@\w+\{\w+,\n(.*?)^\}", text, re.MULTILINE | re.DOTALL):
        found.append(dict(re.findall(r"\b(volume|pages|year|number|graingas) = \{([^}]*)\}", body)))
    check(len(found) > 40 and all("graingas" in e and "year" in e for e in found), found)
    return found


def sources():
    """Volume, year and page of each paper that a theory names."""
    with open(os.path.join(SOURCE, "docs", "reference", "theories.md"), encoding="utf-8") as file:
        names = re.findall(r"^\| ((?:`\w+`(?:, )?)+) \|", file.read().split("## lun1991")[0], re.MULTILINE)
    for name in re.findall(r"\w+", " ".join(names)):
        text = " ".join(run("info", name, "--all", columns=400).out.split())
        yield name, re.findall(r"(\d+) \((\d{4})\) (?:no\. )?(R?\d+)", text.split("source")[1].split("assum")[0])


def test_each_source_of_a_theory_has_an_entry():
    found, n = entries(), 0
    for name, papers in sources():
        check(any(name in e["graingas"].split() for e in found), name, "has no entry")
        for volume, year, page in papers:
            n += 1
            check(any(name in e["graingas"].split() and e.get("volume") == volume and e["year"] == year and page in (e.get("pages"), e.get("number"))
                      for e in found), name, volume, year, page)
    check(n > 30, n)


if __name__ == "__main__":
    import sys
    main(sys.modules[__name__])

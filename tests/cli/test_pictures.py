# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures as people open them. In SVG no text overlaps another text or leaves the page, in every kind of picture. A
legend shows no colour that is not drawn. A script for gnuplot draws the same picture."""
import glob
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET

from tap import Skip, check, main, run

SOURCE = os.environ.get("SOURCE", os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
QUICK = ("--quiet", "--set", "run.collisions=20", "--set", "run.warmup=5")
NARROW, WIDE = set(".,:;il|!'()[]/ \u00a0"), set("mwMW@%→←")


def width(text, size):
    """Upper estimate of the width of a text in DejaVu Sans."""
    return size * sum(0.4 if c in NARROW else 0.98 if c in WIDE else 0.75 if c.isupper() else 0.64 for c in text)


def boxes(svg):
    """Text, left, right, top, bottom of each text."""
    found = []
    for group in ET.fromstring(svg).iter("{http://www.w3.org/2000/svg}g"):
        for text in group.findall("{http://www.w3.org/2000/svg}text"):
            place = re.match(r"translate\(([-\d.]+),([-\d.]+)\)(?: *rotate\(([-\d.]+)\))?", group.get("transform", ""))
            x, y, turn = float(place[1]), float(place[2]), float(place[3] or 0)
            size = float(group.get("font-size", 12))
            pieces = [(t.text, float(t.get("font-size", size))) for t in text.iter() if t.text and t.text.strip("\n")]
            words = "".join(p for p, _ in pieces)
            wide, tall = sum(width(*p) for p in pieces), max([s for _, s in pieces] + [1])
            left = {"start": 0, "middle": -wide / 2, "end": -wide}[group.get("text-anchor", "start")]
            if not words.strip():
                continue
            if turn == 0:
                found.append((words, x + left, x + left + wide, y - 0.76 * tall, y + 0.24 * tall))
            else:  # upwards
                check((turn + 90) % 360 < 1, words, turn)
                found.append((words, x - 0.76 * tall, x + 0.24 * tall, y - left - wide, y - left))
    return found


def check_texts(name):
    with open(name, encoding="utf-8") as f:
        svg = f.read()
    page = [float(n) for n in re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg).groups()]
    found = boxes(svg)
    check(found, name, "has no text")
    for i, (words, left, right, top, bottom) in enumerate(found):
        check(left >= -0.5 and right <= page[0] + 0.5 and top >= -0.5 and bottom <= page[1] + 0.5,
              name, "leaves the page:", words, (left, right, top, bottom), page)
        for other in found[:i]:
            overlap = min(right, other[2]) - max(left, other[1]), min(bottom, other[4]) - max(top, other[3])
            check(overlap[0] < 0.5 or overlap[1] < 0.5, name, "overlap:", words, "|", other[0], overlap)


def check_pictures():
    names = sorted(glob.glob("*.svg"))
    for name in names:
        check_texts(name)
    return names


def need_gnuplot():
    if not shutil.which("gnuplot"):
        raise Skip("no gnuplot")


def compare(example, *more):
    scene = os.path.join(SOURCE, "examples", example + ".yaml")
    done = run("compare", scene, "--output", example + ".h5", *QUICK, *more)
    check(done.code in (0, 1) and any(name.endswith(".svg") for name in done.new), done.err)  # 1: too few collisions


def test_comparisons():
    need_gnuplot()
    for example in "usf", "heated_mixture", "polydisperse", "cooling":
        compare(example, "--set", "particles=500", "--set", "dsmc.particles=500")
        check(run("plot", example + ".h5", "--output", example + "_paper.svg", "--width", "86mm").code == 0)
    check(len(check_pictures()) >= 16)


def test_runs():
    """Curves of both engines, profiles between walls, and all on paper."""
    need_gnuplot()
    for example in "distributions", "couette":
        done = run("run", os.path.join(SOURCE, "examples", example + ".yaml"), "--output", example + ".h5", *QUICK)
        check(done.code == 0, done.err)
        check(run("plot", example + ".h5").code == 0)
        check(run("plot", example + ".h5", "--output", example + "_paper.svg", "--width", "86mm").code == 0)
    check(len(check_pictures()) >= 8)


def test_sweeps():
    """Lines with long names, deviations, and many of them."""
    need_gnuplot()
    for i, (vary, *more) in enumerate((
            ("{phi: 0.05:0.3:0.05}",),
            ("{phi: 0.05:0.3:0.05, temperature: [0.5, 1, 2]}", "--relative-to", "carnahan_starling1969"),
            ("{phi: 0.05:0.3:0.05, temperature: [0.5, 1, 2, 5, 10]}", "--show", "pressure", "--log", "xy"),
            ("{species: [[{mass: 0.5, fraction: 0.123456789}, {mass: 0.2, fraction: 0.876543211}], "
             "[{mass: 0.7, fraction: 0.123456789}, {mass: 0.3, fraction: 0.876543211}]], phi: [0.1, 0.2]}",
             "--show", "pressure"))):
        with open("s.yaml", "w") as f:
            f.write("flow: equilibrium\nphi: 0.1\nsweep: {does: theory}\nvary: " + vary + "\n")
        check(run("sweep", "s.yaml", "--quiet", "--output", f"s{i}").code == 0)
        done = run("sweep", "s.yaml", "--collect", "--output", f"s{i}", "--quiet", *more)
        check(done.code == 0, vary, done.err)
    check(len(check_pictures()) == 4)


def test_colours_of_a_legend():
    """One theory beside one curve has its colour in the legend, too."""
    need_gnuplot()
    compare("cooling", "--set", "particles=500", "--set", "dsmc.particles=500", "--set", "measure=[rheology, sonine]")
    pages = glob.glob("cooling_*sonine.svg")
    check(pages, os.listdir("."))
    for page in pages:
        with open(page, encoding="utf-8") as f:
            svg = f.read()
        check("rgb( 68,  68,  68)'  stroke-width" not in svg, page)


def test_scripts():
    """FILE.gp draws FILE.svg, the same picture as without the detour; gnuplot is not needed to write it."""
    compare("usf", "--set", "particles=200", "--set", "dsmc.particles=200", "--picture", "a.svg")
    path, os.environ["PATH"] = os.environ["PATH"], "/nowhere"
    try:
        done = run("plot", "usf.h5", "--output", "it's.gp")
    finally:
        os.environ["PATH"] = path
    check(done.code == 0 and done.new == ["it's.gp", "it's_snapshot.gp"], done.new, done.err)
    need_gnuplot()
    for script in done.new:
        subprocess.run(["gnuplot", script], check=True)
    with open("a.svg") as one, open("it's.svg") as other:
        check(one.read() == other.read())
    check(os.path.getsize("it's_snapshot.svg") > 1000)


if __name__ == "__main__":
    main(sys.modules["__main__"])

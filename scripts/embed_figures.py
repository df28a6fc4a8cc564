#!/usr/bin/env python3
"""The entries of figures as C: embed_figures.py FOLDER OUTPUT.c DEPFILE. Sorted by paper (the thesis first) and number."""
import os, sys

folder, output, depfile = sys.argv[1:]
entries = sorted((f for f in os.listdir(folder) if f.endswith(".yaml")), key=lambda f: (not f.startswith("thesis"), f))
head = os.path.join(folder, "head.md")


def array(name, path):
    data = open(path, "rb").read() if os.path.exists(path) else b""
    lines = [",".join(str(c) if c < 128 else "'\\x%02x'" % c for c in data[i : i + 40] + (b"\0" if i + 40 > len(data) else b""))
             for i in range(0, len(data) + 1, 40)]
    return "const char %s[] = {\n%s};\n" % (name, ",\n".join(line for line in lines if line))


with open(output, "w") as c:
    c.write('/* Written by scripts/embed_figures.py. */\n#include "reproduce/entry.h"\n\n')
    for k, entry in enumerate(entries):
        c.write("static " + array("entry_%d" % k, os.path.join(folder, entry)))
    c.write("const gg_entry_file gg_entry_files[] = {\n")
    for k, entry in enumerate(entries):
        c.write('    {"%s", entry_%d},\n' % (entry, k))
    c.write("    {NULL, NULL}};\n" + array("gg_reproduction_head", head))
sources = [sys.argv[0], folder] + [os.path.join(folder, e) for e in entries] + [head] * os.path.exists(head)
with open(depfile, "w") as d:  # the folder, too: another entry makes it newer
    d.write("%s: %s\n" % (output, " ".join(sources)))

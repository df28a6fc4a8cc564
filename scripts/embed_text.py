#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files as C texts: embed_text.py HEADER OUTPUT.c NAME=FILE ... writes `const char NAME[]` for each."""
import sys

header, output, *texts = sys.argv[1:]
with open(output, "w") as c:
    c.write('/* Written by scripts/embed_text.py. */\n#include "%s"\n' % header)
    for name, path in (text.split("=", 1) for text in texts):
        with open(path) as f:
            lines = ['"%s\\n"' % line.rstrip("\n").replace("\\", "\\\\").replace('"', '\\"') for line in f]
        c.write("const char %s[] =\n%s;\n" % (name, "\n".join(lines)))

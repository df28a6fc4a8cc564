#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files as C texts: embed_text.py HEADER OUTPUT.c NAME=FILE ... writes `const char NAME[]` for each. NAME[]=FILE writes
`const char *const NAME[]`: the parts between empty lines, then NULL, as compilers need not
take long texts. A file without a last newline gives a text without one."""
import re
import sys


def text_of(text):
    lines = [line.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") for line in text.splitlines(True)]
    return "\n".join(f'"{line}"' for line in lines)



header, output, *texts = sys.argv[1:]
with open(output, "w", encoding="utf-8") as c:
    c.write(f'/* Written by scripts/embed_text.py. */\n#include "{header}"\n')
    for name, path in (text.split("=", 1) for text in texts):
        with open(path, encoding="utf-8") as f:
            text = f.read()
        if name.endswith("[]"):
            parts = ",\n".join(text_of(part + "\n") for part in re.split(r"\n\s*\n", text.strip("\n")))
            c.write(f"const char *const {name} = {{{parts}, 0}};\n")
        else:
            c.write(f"const char {name}[] =\n{text_of(text)};\n")

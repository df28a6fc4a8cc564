# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the C source of the module graingas._c: python3 binding.py HEADER HELPERS OUTPUT

cffi in API mode. The declarations are those of include/graingas.h: a function that is added there is in
graingas._c.lib after the next build. Callbacks written in Python are declared in helpers.h, beside their C side."""
import contextlib
import re
import sys

from cffi import FFI


def without_comments(text):
    return re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)


def declarations(header):
    """The header in the form that cffi reads: no comments, no preprocessor, no attributes."""
    text = without_comments(header)
    text = re.sub(r"^[ \t]*#(.*\\\n)*.*\n", "", text, flags=re.MULTILINE)
    text = re.sub(r'extern "C" \{', "", text).replace("GG_API ", "")
    depth, kept = 0, []
    for character in text:  # the brace that closes extern "C"
        depth += (character == "{") - (character == "}")
        if depth >= 0:
            kept.append(character)
        depth = max(depth, 0)
    return "".join(kept)


def without_triples(text):
    """cffi 1.15 cannot check members that point to arrays (`const double (*position)[3]`): functions of helpers.h read
    them.
    """
    def partial(struct):
        body, n = re.subn(r"const double \(\*\w+\)\[3\];", "", struct.group(0))
        return body.replace("}", "...; }", 1) if n else body
    return re.sub(r"typedef struct \w+ \{[^{}]*\}", partial, text)


def version_macros(header):
    """#define GRAINGAS_..., as constants."""
    names = re.findall(r"^#define (GRAINGAS_VERSION_\w+) +\d+", header, re.MULTILINE)
    return "".join(f"static const int {name};\n" for name in names)


def python_declarations(helpers):
    """Declarations that helpers.h marks for cffi, between `/* cffi:` and `*/`."""
    return "\n".join(re.findall(r"/\* cffi:(.*?)\*/", helpers, re.DOTALL))


def main(header_path, helpers_path, output):
    with open(header_path, encoding="utf-8") as file:
        header = file.read()
    with open(helpers_path, encoding="utf-8") as file:
        helpers = file.read()
    ffi = FFI()
    ffi.cdef(without_triples(declarations(header)) + version_macros(header) + python_declarations(helpers))
    ffi.set_source("graingas._c", helpers)
    with contextlib.redirect_stdout(None):
        ffi.emit_c_code(output)


if __name__ == "__main__":
    main(*sys.argv[1:])

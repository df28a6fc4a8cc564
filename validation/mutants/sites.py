# SPDX-License-Identifier: GPL-3.0-or-later
"""Sites of mutants: every expression in a file of rooms.py that a slip of one of four kinds changes, found in the
syntax tree (libclang).

  sign    + and - exchanged, of numbers and of vectors; a unary minus dropped; a cross product the other way round
  factor  a product or quotient without one of its factors, or by 2, 1/2 or 1.02; a root not taken
  index   another component, another index, the first of two partners for the second, a bound that is off by one
  image   the displacement by images, wraps, offsets or shear: left out, or twice

A site replaces the text from `start` to `end` by `new`, in which {id} is the mutant's number. `new` has both the right
expression and the wrong one (mutants.h); an environment variable selects one at run time."""
import collections
import os
import re

from clang import cindex
from clang.cindex import CursorKind as K
from clang.cindex import TypeKind as T

from rooms import ROOM_OF

IMAGE = re.compile(r"image|edge|offset|wrap|layers|fold|shift|shear|strain|displace|drift|gg_nearest|round_half|rate \*")
PERIODIC = re.compile(r"^src/(md|dsmc|measure)/")
REAL = (T.DOUBLE, T.FLOAT, T.VECTOR, T.LONGDOUBLE)
CONSTANT = (K.CASE_STMT, K.ENUM_DECL, K.STATIC_ASSERT, K.CXX_UNARY_EXPR)
VEC_SWAPS = [("_add", "_sub"), ("_sub", "_add")]
# Sizes of memory and ends of searches are not physics: a wrong value there is no mutant.
NOT_PHYSICS = re.compile(r"malloc|calloc|realloc|sizeof|memcpy|memset|prefetch|GG_TRY|gg_base_fail|assert|memory|__builtin_expect")

Site = collections.namedtuple("Site", "file start end kind new line old what")


class File:
    def __init__(self, root, path):
        with open(os.path.join(root, path), "rb") as f:
            self.data = f.read()
        self.path = path

    def text(self, start, end):
        return self.data[start:end].decode()


def bare(text):
    return re.sub(r"/\*.*?\*/", "", text, flags=re.S).strip()


def balanced(text):
    depth = 0
    for c in text:
        depth += (c in "([{") - (c in ")]}")
        if depth < 0:
            return False
    return depth == 0


class Finder:
    def __init__(self, root):
        self.root, self.files, self.sites = root, {}, {}

    def file_of(self, path):
        path = os.path.relpath(os.path.realpath(path), os.path.realpath(self.root))
        if path not in ROOM_OF:
            return None
        if path not in self.files:
            self.files[path] = File(self.root, path)
        return self.files[path]

    def span(self, cursor):
        e = cursor.extent
        return e.start.offset, e.end.offset

    def put(self, f, start, end, kind, new, what):
        old = f.text(start, end)
        if not old.strip() or not balanced(old) or "\n#" in old or NOT_PHYSICS.search(old):
            return
        line = f.data[:start].count(b"\n") + 1
        begin = f.data.rfind(b"\n", 0, start) + 1
        whole = f.data[begin:f.data.find(b"\n", start)].decode()
        if NOT_PHYSICS.search(whole) or whole.lstrip().startswith("#"):
            return
        self.sites[(f.path, start, end, kind, what)] = Site(f.path, start, end, kind, new, line, old, what)

    def choice(self, f, start, end, kind, wrong, what):
        """The expression from start to end, or the wrong one."""
        self.put(f, start, end, kind, "(GG_MUTANT({id}) ? (%s) : (%s))" % (wrong, f.text(start, end)), what)

    # -- one rule each

    def binary(self, f, cursor):
        kids = list(cursor.get_children())
        if len(kids) != 2:
            return
        (a, b), (c, d) = self.span(kids[0]), self.span(kids[1])
        start, end = self.span(cursor)
        if not (start == a < b <= c < d == end):
            return
        op, left, right = bare(f.text(b, c)), f.text(a, b), f.text(c, d)
        if not balanced(left) or not balanced(right):
            return
        real = cursor.type.get_canonical().kind in REAL
        if op in "+-" and len(op) == 1:
            if real:
                self.choice(f, start, end, "sign", f"{left} {'-' if op == '+' else '+'} ({right})", op)
            if PERIODIC.match(f.path) and real and IMAGE.search(right) and not IMAGE.search(left):
                self.choice(f, start, end, "image", left, "left out")
                self.choice(f, start, end, "image", f"{left} {op} 2 * ({right})", "twice")
            elif PERIODIC.match(f.path) and real and IMAGE.search(left) and not IMAGE.search(right):
                self.choice(f, start, end, "image", right if op == "+" else f"-({right})", "left out")
            if not real and re.fullmatch(r"1", right):
                self.choice(f, start, end, "index", left, "off by one")
        if op in "*/" and len(op) == 1 and real:
            if op == "*":
                self.choice(f, start, end, "factor", right, "first factor left out")
            self.choice(f, start, end, "factor", left, "last factor left out")
            for by in "2", "0.5", "1.02":
                self.choice(f, start, end, "factor", f"({left} {op} ({right})) * {by}", "by " + by)
            if IMAGE.search(right) and PERIODIC.match(f.path) and re.search(r"gg_nearest|round_half|gg_floor|offset", right):
                self.choice(f, start, end, "image", f"({left} {op} ({right})) * 0", "left out")

    def compound(self, f, cursor):
        kids = list(cursor.get_children())
        if len(kids) != 2 or kids[0].type.get_canonical().kind not in REAL:
            return
        (a, b), (c, d) = self.span(kids[0]), self.span(kids[1])
        if not a < b <= c < d:
            return
        op, right = bare(f.text(b, c)), f.text(c, d)
        if op in ("+=", "-="):
            self.choice(f, c, d, "sign", f"-({right})", op)
            self.choice(f, c, d, "factor", f"({right}) * 2", "by 2")
            if PERIODIC.match(f.path) and (IMAGE.search(right) or IMAGE.search(f.text(a, b))):
                self.choice(f, c, d, "image", f"({right}) * 0", "left out")
                self.choice(f, c, d, "image", f"2 * ({right})", "twice")
        elif op in ("*=", "/="):
            self.choice(f, c, d, "factor", f"({right}) * 1.02", "by 1.02")

    def unary(self, f, cursor):
        start, end = self.span(cursor)
        text = f.text(start, end)
        if text.startswith("-") and cursor.type.get_canonical().kind in REAL and not re.fullmatch(r"-\s*1\.?0*", text):
            self.choice(f, start, end, "sign", text[1:], "minus left out")

    def call(self, f, cursor):
        start, end = self.span(cursor)
        text = f.text(start, end)
        found = re.match(r"(\w+)(\(\w+\))?\(", text)
        if not found or not text.endswith(")") or not balanced(text):
            return
        name = found.group(1)
        full = found.group(2)[1:-1] if name in ("GG_OF",) and found.group(2) else name
        args = [self.span(a) for a in cursor.get_arguments() if a is not None]
        body = text[found.end():-1]
        if re.search(r"(^|_)(add|sub)$", full) and len(args) == 2 and cursor.type.get_canonical().kind == T.RECORD:
            other = full[:-3] + ("sub" if full.endswith("add") else "add")
            head = text[:found.end()].replace(full, other)
            self.choice(f, start, end, "sign", head + body + ")", full)
            parts = self.arguments(f, args, start, end)
            if parts and PERIODIC.match(f.path) and IMAGE.search(parts[1]):
                self.choice(f, start, end, "image", parts[0], "left out")
        elif re.search(r"(^|_)cross$", full):
            parts = self.arguments(f, args, start, end)
            if parts:
                self.choice(f, start, end, "sign", text[:found.end()] + f"{parts[1]}, {parts[0]})", "the other way round")
        elif full in ("sqrt", "gg_cube_root") or full.endswith("GG_SQRT"):
            self.choice(f, start, end, "factor", body, "no root")
        elif full == "gg_pair" and len(args) == 2:
            parts = self.arguments(f, args, start, end)
            if parts and parts[0] != parts[1]:
                self.choice(f, start, end, "index", f"gg_pair({parts[0]}, {parts[0]})", "the first twice")
        elif full == "gg_wrap" and len(args) == 3:
            parts = self.arguments(f, args, start, end)
            if parts:
                self.choice(f, start, end, "image", parts[0], "not wrapped")
        elif full == "pow" and len(args) == 2:
            parts = self.arguments(f, args, start, end)
            if parts:
                self.choice(f, start, end, "factor", parts[0], "no power")

    def arguments(self, f, args, start, end):
        if len(args) < 2 or any(not start < a < b < end for a, b in args):
            return None
        parts = [f.text(a, b) for a, b in args]
        return parts if all(p.strip() and balanced(p) for p in parts) else None

    def member(self, f, cursor, lvalue):
        start, end = self.span(cursor)
        text = f.text(start, end)
        found = re.fullmatch(r"(.*(?:\.|->))([xyz])", text, flags=re.S)
        if not found or lvalue:
            return
        for other in {"x": "y", "y": "xz", "z": "x"}[found.group(2)]:
            self.choice(f, start, end, "index", found.group(1) + other, f"{found.group(2)} -> {other}")

    def subscript(self, f, cursor, names):
        kids = list(cursor.get_children())
        if len(kids) != 2:
            return
        a, b = self.span(kids[1])
        index = f.text(a, b)
        if index in ("0", "1", "2"):
            size = kids[0].type.get_canonical().get_array_size()
            inner = list(kids[0].get_children())
            if size < 0 and inner:
                size = inner[0].type.get_canonical().get_array_size()
            if size > 1:
                self.choice(f, a, b, "index", str((int(index) + 1) % min(size, 3)), f"[{index}]")
        elif re.fullmatch(r"[a-z]", index):
            for other in sorted(names):
                if other != index and other in {"i": "j", "j": "i", "a": "b", "b": "a", "k": "l", "l": "k"}.get(index, ""):
                    self.choice(f, a, b, "index", other, f"[{index}] -> [{other}]")

    def loop(self, f, cursor):
        for kid in cursor.get_children():
            if kid.kind != K.BINARY_OPERATOR:
                continue
            kids = list(kid.get_children())
            (a, b), (c, d) = self.span(kids[0]), self.span(kids[1])
            if a < b <= c < d and bare(f.text(b, c)) == "<" and kids[1].type.get_canonical().kind not in REAL:
                right = f.text(c, d)
                if balanced(right):
                    self.put(f, c, d, "index", "(%s) - (GG_MUTANT({id}) ? 1 : 0)" % right, "one too few")
            return

    # -- the walk

    def walk(self, cursor, names, lvalue=False):
        if cursor.kind in CONSTANT:
            return
        if cursor.kind == K.VAR_DECL and cursor.storage_class == cindex.StorageClass.STATIC:
            return
        if cursor.kind == K.VAR_DECL and re.fullmatch(r"[a-z]", cursor.spelling or "") and cursor.type.get_canonical().kind in (T.INT, T.UINT):
            names.add(cursor.spelling)
        if cursor.kind == K.PARM_DECL and re.fullmatch(r"[a-z]", cursor.spelling or "") and cursor.type.get_canonical().kind in (T.INT, T.UINT):
            names.add(cursor.spelling)
        f = None
        e = cursor.extent
        if e.start.file and e.end.file and e.start.file.name == e.end.file.name:
            f = self.file_of(e.start.file.name)
        if f:
            if cursor.kind == K.BINARY_OPERATOR:
                self.binary(f, cursor)
            elif cursor.kind == K.COMPOUND_ASSIGNMENT_OPERATOR:
                self.compound(f, cursor)
            elif cursor.kind == K.UNARY_OPERATOR:
                self.unary(f, cursor)
            elif cursor.kind == K.CALL_EXPR:
                self.call(f, cursor)
            elif cursor.kind == K.MEMBER_REF_EXPR:
                self.member(f, cursor, lvalue)
            elif cursor.kind == K.ARRAY_SUBSCRIPT_EXPR:
                self.subscript(f, cursor, names)
            elif cursor.kind == K.FOR_STMT:
                self.loop(f, cursor)
        for i, kid in enumerate(cursor.get_children()):
            left = i == 0 and self.assigns(f, cursor)
            inner = left or (lvalue and cursor.kind in (K.PAREN_EXPR, K.UNEXPOSED_EXPR, K.ARRAY_SUBSCRIPT_EXPR))
            self.walk(kid, names, inner)

    def assigns(self, f, cursor):
        """Is the first child written to, or its address taken?"""
        if cursor.kind == K.COMPOUND_ASSIGNMENT_OPERATOR:
            return True
        if cursor.kind == K.UNARY_OPERATOR:
            if not f:
                return True
            text = f.text(*self.span(cursor))
            return text.startswith(("&", "++", "--")) or text.endswith(("++", "--"))
        if cursor.kind == K.BINARY_OPERATOR:
            kids = list(cursor.get_children())
            if len(kids) != 2 or not f:
                return True
            return bare(f.text(self.span(kids[0])[1], self.span(kids[1])[0])) == "="
        return False


def find(root, commands):
    """All sites below root; commands: (file, arguments) of the compilations that see them."""
    finder, index = Finder(root), cindex.Index.create()
    for path, arguments in commands:
        unit = index.parse(path, args=arguments)
        for cursor in unit.cursor.get_children():
            where = cursor.location.file
            if where and cursor.kind == K.FUNCTION_DECL and cursor.is_definition() and finder.file_of(where.name):
                finder.walk(cursor, set())
    return sorted(finder.sites.values())

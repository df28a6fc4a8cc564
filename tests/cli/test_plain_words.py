# SPDX-License-Identifier: GPL-3.0-or-later
"""Documents, messages and comments are in plain words.

Documents and messages: no sentence of more than 40 words, none of the project's private words. plain_words.txt beside
this file has exceptions: a file, its long sentences, its private words. Its numbers may only fall. `test_plain_words.py
--list` prints each long sentence and each private word; `--counts` prints what plain_words.txt should hold.

Comments of C, Python and JavaScript, and strings for users there: no sentence that begins with What, Of, Where or
Whoever, none of the project's private words. plain_comments.txt has the exceptions: a room, its riddles. The test fails
if a room has more of them than its number; a room that is not listed has none. `--riddles ROOM` prints the riddles of a
room (of all rooms without a name), `--rooms` what plain_comments.txt should hold."""
import ast
import glob
import io
import os
import re
import sys
import tokenize

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.environ.get("SOURCE", os.path.join(HERE, "..", ".."))
MOST = 40
ABBREVIATIONS = re.compile(r"\b(e\.g|i\.e|et al|cf|vs|eqs?|figs?|no|[A-Z])\.$")
PRIVATE = re.compile(r"\b(doors?|crews?|courses?|inert|outlooks?|episodes?|wandering|standstill|parting|hand_out|told|gone on with|"
                     r"is waited for|are waited for)\b", re.IGNORECASE)
ALLOWED = re.compile(r"\b(of course|told apart|(?:in the |over the )?course of (?:time|a run|the run))\b", re.IGNORECASE)

RIDDLE = re.compile(r"(What|Of|Where|Whoever)\b")
PRIVATE_IN_CODE = re.compile(PRIVATE.pattern[:-len(r")\b")] + r"|taken back|takes? back|overtak\w+|put off|crowd(?:ed|ing)?|"
                             r"settle[sd]?|by[_ ]the[_ ]clock|fell short|(?:was|were|been) late|of one's own|looked at|"
                             r"are asked|is asked|be asked|take_up)\b", re.IGNORECASE)


def sentences(block):
    """A block of running text, split where a sentence ends: a mark, then a space."""
    found, start = [], 0
    for end in re.finditer(r"[.!?][)\"'*”]*(?=\s|$)", block):
        if not ABBREVIATIONS.search(block[start:end.end()]):
            found.append(block[start:end.end()])
            start = end.end()
    return [s.strip() for s in found + [block[start:]] if s.strip()]


def words(sentence):
    return sum(bool(re.search(r"\w", w)) for w in sentence.split())


def blocks(text):
    """Paragraphs, headings, items and cells of a Markdown page; code, formulas and addresses are one word each."""
    text = re.sub(r"^```.*?^```", "\n\n", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"<!--.*?-->", "\n\n", text, flags=re.DOTALL)
    text = re.sub(r"(?<=\n\n)(?: {4,}(?![-*] |\d+\. ).*\n)+", "\n", text)  # indented: code
    text = re.sub(r"\$\$.*?\$\$", " Formula. ", text, flags=re.DOTALL)
    text = re.sub(r"``.+?``|`[^`]+`", "Code", text, flags=re.DOTALL)
    text = re.sub(r"\$[^$\n]+\$", "Formula", text)
    text = re.sub(r"!?\[([^]]*)\]\([^)]*\)", r"\1", text)
    text = text.replace("\\|", "/").replace("**", "")
    paragraph, found = [], []
    for line in text.splitlines() + [""]:
        row = line.strip().startswith("|")
        starts = row or not line.strip() or re.match(r"\s*(#|[-*] |\d+\. |>)", line)
        if starts and paragraph:
            found.append(" ".join(paragraph))
            paragraph = []
        if row:
            found += [cell.strip() for cell in line.strip().strip("|").split("|")]
        elif line.strip():
            paragraph.append(re.sub(r"^([-*]|\d+\.|#+|>)\s+", "", line.strip()))
            if line.startswith("#"):
                found.append(paragraph.pop())
    return [b for b in found if re.search(r"\w", b)]


def messages(text):
    """String literals of a C file, adjacent ones joined; a format's signs are words as they are."""
    text = re.sub(r'"(?:\\.|[^"\\])*"|/\*.*?\*/|//[^\n]*', lambda m: m.group() if m.group()[0] == '"' else " ", text, flags=re.DOTALL)
    text = re.sub(r"^\s*#\s*include.*$", "", text, flags=re.MULTILINE)
    literals = re.findall(r'"(?:\\.|[^"\\])*"(?:\s*(?:PRI\w+\s*)?"(?:\\.|[^"\\])*")*', text)
    for literal in literals:
        whole = re.sub(r'"\s*(?:PRI\w+\s*)?"', "", literal)[1:-1].replace('\\"', '"').replace("\\t", " ")
        if " " in whole.strip():
            yield from (b for b in re.split(r"\\n\s*(?:\\n|(?=[ |]))|\\n(?=\s*$)", whole) if b and b.strip())


def pages():
    names = sorted(glob.glob(os.path.join(SOURCE, "*.md")) + glob.glob(os.path.join(SOURCE, "docs", "**", "*.md"), recursive=True))
    for path in names:
        yield os.path.relpath(path, SOURCE), blocks(open(path, encoding="utf-8").read())
    for room in "cli", "api", "scene":
        for path in sorted(glob.glob(os.path.join(SOURCE, "src", room, "**", "*.[ch]"), recursive=True)):
            yield os.path.relpath(path, SOURCE), [b.replace("\\n", " ") for b in messages(open(path, encoding="utf-8").read())]


def survey():
    """By file: its long sentences, its private words with what stands about them, its sentences."""
    found = {}
    for name, texts in pages():
        all_of = [s for block in texts for s in sentences(block)]
        private = []
        for sentence in all_of:
            plain = re.sub(r"`[^`]*`", " ", ALLOWED.sub(" ", sentence))
            private += [f"{m.group()}: {plain[max(0, m.start() - 40):m.end() + 30]}" for m in PRIVATE.finditer(plain)]
        found[name] = [s for s in all_of if words(s) > MOST], private, len(all_of)
    return found


def room_of(name):
    """src/md/queue.c: src/md; web/gas.js: web; python/tests/test_run.py: python/tests."""
    folders = os.path.dirname(name).split("/")
    return "/".join(folders[:2] if folders[0] in ("src", "tests", "python", "validation") else folders[:1])


SCRIPT = re.compile(r"""(?P<comment>/\*.*?\*/|(?://[^\n]*(?:\n[ \t]*(?=//))?)+)
    |(?P<string>"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'|`(?:\\.|[^`\\])*`)
    |(?<=[(,=:\[!&|?{};\s])/(?![*/\s=])(?:\\.|\[(?:\\.|[^\]\\\n])*\]|[^/\\\n\[])+/[a-z]*""", re.DOTALL | re.VERBOSE)


def running(comment):
    """The text of a comment without its marks; a quotation is one word."""
    lines = [re.sub(r"^\s*(/\*+|\*(?!/)|//+|#+:?)?\s?|\s*\*/\s*$", "", line) for line in comment.splitlines()]
    text = "\n".join(line for line in lines if "SPDX-License" not in line and not line.startswith("!"))
    return re.sub(r"`[^`\n]*`", "Code", text)


def of_script(text, quotes):
    """Comments and strings of C (strings in double quotes alone) and JavaScript."""
    comments, strings = [], []
    for m in SCRIPT.finditer(text):
        if m.group("comment"):
            comments.append(running(m.group("comment")))
        elif m.group("string") and m.group()[0] in quotes:
            strings.append(m.group()[1:-1])
    return comments, strings


def of_python(text):
    """Comments and docstrings of Python; other strings."""
    comments, documented, last = [], set(), -2
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            line = running(token.string)
            if token.start[0] == last + 1:
                comments[-1] += "\n" + line
            else:
                comments.append(line)
            last = token.start[0]
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node, False) is not None:
            documented.add(id(node.body[0].value))
            comments.append(running(ast.get_docstring(node)))
    constants = [n for n in ast.walk(tree) if isinstance(n, ast.Constant) and id(n) not in documented]
    return comments, [n.value for n in constants if isinstance(n.value, str)]


def code_files():
    """Every source file of the tree, without builds."""
    for top in "src", "include", "python", "web", "tests", "validation", "examples", "scripts", "site":
        for path in sorted(glob.glob(os.path.join(SOURCE, top, "**", "*"), recursive=True)):
            name = os.path.relpath(path, SOURCE)
            if os.path.isfile(path) and not re.search(r"(^|/)(build|node_modules|__pycache__)[^/]*/", name):
                yield name, path


def riddles_of(name, text):
    """The riddles of a file: sentences, and private words with their sentences."""
    python = name.endswith(".py") or re.match(r"#!.*python", text)
    comments, strings = of_python(text) if python else of_script(text, "\"'`" if name.endswith(".js") else '"')
    if re.search(r"(^|/)tests/", name):
        strings = []  # scenes and expected messages
    found = []
    for text, spoken in [(c, False) for c in comments] + [(s, True) for s in strings if " " in s.strip()]:
        for block in re.split(r"\n\s*\n|\n(?=\s*[-*] )", text):
            for s in sentences(re.sub(r"\s+", " ", block)):
                if RIDDLE.match(s) and not (spoken and s.endswith("?")):
                    found.append(s)
                found += [f"{m.group()}: {s}" for m in PRIVATE_IN_CODE.finditer(ALLOWED.sub(" ", s))]
    return found


def riddles_by_room():
    rooms = {}
    for name, path in code_files():
        script = "." not in os.path.basename(name) and re.match(rb"#!.*python", open(path, "rb").read(60))
        if script or re.search(r"\.(py|js|[ch])$", name):
            found = riddles_of(name, open(path, encoding="utf-8").read())
            rooms.setdefault(room_of(name), []).extend(f"{name}: {s}" for s in found)
    return rooms


def exceptions_of_rooms():
    with open(os.path.join(HERE, "plain_comments.txt"), encoding="utf-8") as lines:
        return {line.split()[0]: int(line.split()[1]) for line in lines if line.strip() and not line.startswith("#")}


def test_comments():
    from tap import check
    rooms, allowed = riddles_by_room(), exceptions_of_rooms()
    check(len(rooms) > 30, sorted(rooms))
    print(f"# riddles in comments and strings: {sum(map(len, rooms.values()))}")
    new = []
    for room, found in sorted(rooms.items()):
        most = allowed.get(room, 0)
        if len(found) > most:
            new += [f"{room} has {len(found)}, {most} allowed (--riddles {room} lists all):"] + [f"  {s}" for s in found[:40]]
        elif len(found) < most:
            print(f"# tests/cli/plain_comments.txt can shrink: {room} {len(found)} of {most}")
    check(not new, "say it in plain words (CONTRIBUTING.md):\n" + "\n".join(new))


def test_reader_of_comments():
    """The reader of comments: which sentences are riddles, in each language, and which are not."""
    from tap import check
    c = '/* A thing. Of these one. */ f("What is it? Where it is."); // x = y.\n// Where y is z.\n/* A,\n * Where z = 1 */'
    check([s.split()[0] for s in riddles_of("src/a.c", c)] == ["Of", "Where", "Where"], riddles_of("src/a.c", c))
    check(riddles_of("tests/a/a.c", 'f("Of it.");') == [])
    check(riddles_of("web/a.js", "a = /[\"']/.test(b); /* Whoever waits. */ t = `Of what`;") == ["Whoever waits.", "Of what"])
    found = riddles_of("a.py", '"""One. What two."""\n# Is put off, of course.\nx = "Of it"\n')
    check(found == ["put off: Is put off, of course.", "What two.", "Of it"], found)


def exceptions():
    allowed = {}
    with open(os.path.join(HERE, "plain_words.txt"), encoding="utf-8") as lines:
        for line in lines:
            if line.strip() and not line.startswith("#"):
                name, long, private = line.split()
                allowed[name] = int(long), int(private)
    return allowed


def test_long_sentences():
    report(0, lambda s: f"{words(s)} words: {s}")


def test_private_words():
    report(1, str)


def test_reader_of_pages():
    """The reader itself: what is a sentence, what is a cell, what is no message."""
    from tap import check
    long = " ".join(["word"] * 41)
    check(len(blocks(f"# A\nb c.\n\n- d\n- e\n\n| f | {long}. g |\n")) == 6)
    check([words(s) for s in sentences(f"A e.g. b of J. Doe et al. c. {long}.")] == [9, 41])
    check(words(sentences(blocks("See `a b c` and $x + y$ [d e](f g).")[0])[0]) == 6)
    check(list(messages('f("a b" /* "c d" */ "e", "g");')) == ["a be"])
    check(PRIVATE.search("users are told") and not PRIVATE.search(ALLOWED.sub("", "of course")))


def report(which, shown):
    from tap import check
    found, allowed = survey(), exceptions()
    check(len(found) > 60 and sum(f[2] for f in found.values()) > 2000, len(found))
    counts = {name: len(f[which]) for name, f in found.items()}
    documents = sum(n for name, n in counts.items() if name.endswith(".md"))
    print(f"# {('sentences of more than 40 words', 'private words')[which]}: {documents} in documents, "
          f"{sum(counts.values()) - documents} in messages; {sum(f[2] for f in found.values())} sentences")
    new, fewer = [], []
    for name, n in counts.items():
        most = allowed.get(name, (0, 0))[which]
        if n > most:
            new += [f"{name} has {n}, {most} allowed:"] + [f"  {shown(s)}" for s in found[name][which]]
        elif n < most:
            fewer.append(f"{name} {n} of {most}")
    if fewer:
        print("# tests/cli/plain_words.txt can shrink: " + ", ".join(fewer))
    check(not new, "say it in plain words (CONTRIBUTING.md):\n" + "\n".join(new))


def list_all():
    for name, (long, private, _) in survey().items():
        for s in long:
            print(f"{name}: {words(s)} words: {s}")
        for s in private:
            print(f"{name}: {s}")


def print_counts():
    for name, (long, private, _) in survey().items():
        if long or private:
            print(name, len(long), len(private))


def list_riddles(room=None):
    for found in (found for name, found in sorted(riddles_by_room().items()) if room in (None, name)):
        print("\n".join(found))


def print_rooms():
    for room, found in sorted(riddles_by_room().items()):
        if found:
            print(room, len(found))


OPTIONS = {"--list": list_all, "--counts": print_counts, "--riddles": list_riddles, "--rooms": print_rooms}

if __name__ == "__main__":
    if sys.argv[1:] and sys.argv[1] in OPTIONS:
        OPTIONS[sys.argv[1]](*sys.argv[2:])
    else:
        from tap import main
        main(sys.modules[__name__])

# SPDX-License-Identifier: GPL-3.0-or-later
"""Documents and messages are in plain words: no sentence of more than 40 words, none of the project's private words.

plain_words.txt beside this file has exceptions: a file, its long sentences, its private words. Its numbers may only fall.
`test_plain_words.py --list` prints each long sentence and each private word; `--counts` prints what plain_words.txt should hold."""
import glob
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.environ.get("SOURCE", os.path.join(HERE, "..", ".."))
MOST = 40
ABBREVIATIONS = re.compile(r"\b(e\.g|i\.e|et al|cf|vs|eqs?|figs?|no|[A-Z])\.$")
PRIVATE = re.compile(r"\b(doors?|crews?|courses?|inert|outlooks?|episodes?|wandering|standstill|parting|hand_out|told|gone on with|"
                     r"is waited for|are waited for)\b", re.IGNORECASE)
ALLOWED = re.compile(r"\b(of course|(?:in the |over the )?course of (?:time|a run|the run))\b", re.IGNORECASE)


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


if __name__ == "__main__":
    if sys.argv[1:] in (["--list"], ["--counts"]):
        (list_all if sys.argv[1] == "--list" else print_counts)()
    else:
        from tap import main
        main(sys.modules[__name__])

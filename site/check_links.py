#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Does every link of the pages in a folder lead somewhere in it? Files and anchors; nothing is fetched from elsewhere.

    site/check_links.py FOLDER
"""
import os
import sys
import urllib.parse
from html.parser import HTMLParser


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.anchors, self.links = set(), set()
        with open(path, encoding="utf-8") as file:
            self.feed(file.read())

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors.update(v for k, v in values.items() if k in ("id", "name") and v)
        here = values.get("href") if tag in ("a", "link") else values.get("src") if tag in ("img", "script", "iframe", "source") else None
        if here:
            self.links.add((tag, here))


def dead_links(folder):
    names = [os.path.join(where, f) for where, _, files in os.walk(folder) for f in files if f.endswith(".html")]
    pages = {os.path.normpath(name): Page(name) for name in names if os.path.basename(name) != "page.html"}
    for name, page in sorted(pages.items()):
        for tag, link in sorted(page.links):
            parts = urllib.parse.urlsplit(link)
            if parts.scheme in ("data", "mailto"):
                continue
            if parts.scheme or parts.netloc:
                if tag != "a":
                    yield name, f"{link} is fetched from elsewhere"
                continue
            path = os.path.normpath(os.path.join(os.path.dirname(name), urllib.parse.unquote(parts.path))) if parts.path else name
            if not os.path.exists(path):
                yield name, link
            elif parts.fragment and path in pages and urllib.parse.unquote(parts.fragment) not in pages[path].anchors:
                yield name, link
    if len(pages) < 10:
        yield folder, f"only {len(pages)} pages"


if __name__ == "__main__":
    dead = list(dead_links(sys.argv[1]))
    for where, link in dead:
        print(f"{os.path.relpath(where, sys.argv[1])}: {link}", file=sys.stderr)
    sys.exit(bool(dead))

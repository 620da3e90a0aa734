#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks a built site: every relative link, picture, script and style leads to a file of it, every #anchor of a page
of ours to an element. Prints each dead one as PAGE: LINK and exits 1.

  tools/site/check_links.py SITE"""
import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            elif name in ("href", "src") and value and not (tag == "link" and ("rel", "canonical") in attributes):
                self.links.append(value)


def dead_links(site):
    pages = {file: Page(file.read_text(encoding="utf-8")) for file in sorted(site.rglob("*.html"))}
    for file, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc or file.name == "404.html":
                continue
            path = urllib.parse.unquote(parts.path)
            target = (file.parent / path).resolve() if path else file
            if target.is_dir():
                target = target / "index.html"
            anchor = urllib.parse.unquote(parts.fragment)
            if not target.is_file():
                yield f"{file.relative_to(site)}: {link}: no such file"
            elif file.is_relative_to(site / "api"):
                continue  # doxygen's own anchors
            elif anchor and target in pages and anchor not in pages[target].anchors and not anchor.startswith("__"):
                yield f"{file.relative_to(site)}: {link}: no such anchor"


def main():
    site = pathlib.Path(sys.argv[1]).resolve()
    found = list(dead_links(site))
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every relative link, anchor and picture leads somewhere.

Without arguments: in the repository's Markdown pages, and that the files are there that NOTICE names. With a folder: in all HTML files of a site. Addresses of other sites
are not asked for.
"""

import os
import re
import sys
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from prepare_pages import LINK, ROOT, headings, pages, parts  # noqa: E402


CODE = ("code", "pre", "script", "style", "tt")


def check_markdown():
    anchors = {}
    texts = {}
    for page in pages():
        with open(os.path.join(ROOT, page), encoding="utf-8") as file:
            texts[page] = file.read().splitlines()
        anchors[page] = {anchor for _, _, _, anchor in headings(texts[page])}
    count = 0
    problems = []
    for page, lines in texts.items():
        for code, begin, part in parts(lines):
            for match in () if code else LINK.finditer(part):
                target = match.group(3)
                if re.match(r"[a-z]+:", target):
                    continue
                count += 1
                here = f"{page}:{begin + 1 + part.count(chr(10), 0, match.start())}"
                path, _, anchor = target.partition("#")
                path = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
                if not os.path.exists(os.path.join(ROOT, path)):
                    problems.append(f"{here}: no such file: {target}")
                elif anchor and anchor not in anchors.get(path, ()):
                    problems.append(f"{here}: no such heading: {target}")
    with open(os.path.join(ROOT, "NOTICE"), encoding="utf-8") as file:
        for path in re.findall(r"\b(?:Module|Applications)/[\w./-]*\w", file.read()):
            count += 1
            if not os.path.exists(os.path.join(ROOT, path)):
                problems.append(f"NOTICE: no such file: {path}")
    return count, problems


class Page(HTMLParser):
    """The links of an HTML file, and what can be linked to in it; Markdown that was not understood."""

    def __init__(self, text):
        super().__init__()
        self.links = []
        self.names = set()
        self.markdown = []
        self.code = 0
        self.feed(text)

    def handle_data(self, data):
        if not self.code and re.search(r"\]\(|^\s*\|---|[@\\](ref|section|subsection)\b|<table", data):
            self.markdown.append((self.getpos()[0], data.strip()))

    def handle_endtag(self, tag):
        self.code -= tag in CODE

    def handle_starttag(self, tag, attrs):
        self.code += tag in CODE
        attributes = dict(attrs)
        for key in ("id", "name"):
            if attributes.get(key):
                self.names.add(attributes[key])
        for key in ("href", "src"):
            if attributes.get(key):
                self.links.append((self.getpos()[0], attributes[key]))


def check_html(folder):
    parsed = {}
    for directory, _, names in os.walk(folder):
        for name in names:
            if name.endswith(".html"):
                path = os.path.join(directory, name)
                with open(path, encoding="utf-8") as file:
                    parsed[path] = Page(file.read())
    count = 0
    problems = []
    for path, page in sorted(parsed.items()):
        for line, text in page.markdown:
            problems.append(f"{os.path.relpath(path, folder)}:{line}: not understood: {text[:60]}")
        for line, link in page.links:
            address = urlsplit(link)
            if address.scheme or address.netloc:
                continue
            count += 1
            target = path
            if address.path:
                target = os.path.normpath(os.path.join(os.path.dirname(path), unquote(address.path)))
            here = f"{os.path.relpath(path, folder)}:{line}"
            if not os.path.isfile(target):
                problems.append(f"{here}: no such file: {link}")
            elif address.fragment and target in parsed and (
                    unquote(address.fragment) not in parsed[target].names):
                problems.append(f"{here}: no such anchor: {link}")
    if not parsed:
        problems.append(f"{folder}: no HTML")
    return count, problems


def main():
    count, problems = check_html(sys.argv[1]) if len(sys.argv) > 1 else check_markdown()
    for problem in problems:
        print(problem)
    print(f"{count} links, {len(problems)} broken.")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())

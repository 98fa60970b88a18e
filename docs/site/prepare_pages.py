#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Prepares the repository's Markdown for Doxygen.

Markdown in the repository has links as forges show them: to files, and to headings by the anchors that forges give them.
Doxygen wants a label for each heading and references to labels. Files that are no pages are copied beside the site, and
folders get a list of their files.
"""

import argparse
import html
import os
import re
import shutil
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MAIN = "README.md"
# Its links make the tree of pages; those of docs/X.md do for the folder docs/X.
ORDER = os.path.join("docs", "index.md")

LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]+)\)")
HEADING = re.compile(r"^(#{1,6})\s+(.*?)\s*#*$")
FENCE = re.compile(r"^\s*(```|~~~)")


def pages():
    """All pages, as paths from ROOT."""
    found = []
    for folder, _, names in os.walk(os.path.join(ROOT, "docs")):
        found += [os.path.relpath(os.path.join(folder, name), ROOT) for name in names if name.endswith(".md")]
    return [MAIN, "CONTRIBUTING.md", "CHANGELOG.md"] + sorted(found)


def parent(page):
    """The page under which the site's tree has a page: docs/methods.md for those in docs/methods/."""
    owner = os.path.dirname(page) + ".md"
    return owner if os.path.exists(os.path.join(ROOT, owner)) else ORDER


def slug(heading):
    """The anchor that forges give a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    text = re.sub(r"[^\w\- ]", "", text.lower())
    return text.replace(" ", "-")


def headings(lines):
    """(line number, level, text, anchor) of each heading outside of code."""
    seen = {}
    code = False
    for number, line in enumerate(lines):
        if FENCE.match(line):
            code = not code
        match = None if code else HEADING.match(line)
        if match:
            anchor = slug(match.group(2))
            count = seen.get(anchor, 0)
            seen[anchor] = count + 1
            yield number, len(match.group(1)), match.group(2), anchor + (f"-{count}" if count else "")


def parts(lines):
    """(whether it is code, number of the first line, text) of each part of a page. Links may break across lines."""
    kinds = []
    fenced = False
    indented = False
    before = ""
    for line in lines:
        fence = bool(FENCE.match(line))
        # Indented code does not interrupt a paragraph.
        indented = line.startswith("    ") and (indented or not before.strip())
        kinds.append(fenced or fence or indented)
        fenced = fenced != fence
        before = line
    begin = 0
    for number in range(1, len(lines) + 1):
        if number == len(lines) or kinds[number] != kinds[begin]:
            yield kinds[begin], begin, "".join(line + "\n" for line in lines[begin:number])
            begin = number


def label(page, anchor=""):
    name = re.sub(r"\W", "_", page[:-3])
    return name + ("-" + re.sub(r"[^A-Za-z0-9_-]", "_", anchor) if anchor else "")


class Preparation:
    def __init__(self, pages_folder, files_folder):
        self.pages_folder = pages_folder
        self.files_folder = files_folder
        self.pages = pages()
        self.lines = {}
        self.anchors = {}
        self.problems = []
        self.placed = set()  # pages that have their place in the tree
        for page in self.pages:
            with open(os.path.join(ROOT, page), encoding="utf-8") as file:
                self.lines[page] = file.read().splitlines()
            self.anchors[page] = {anchor: level
                                  for _, level, _, anchor in headings(self.lines[page])}

    def copy_file(self, path):
        """Copy a file or folder of the repository beside the site; return its address there."""
        target = os.path.join(self.files_folder, path)
        source = os.path.join(ROOT, path)
        if os.path.isdir(source):
            names = sorted(name for name in os.listdir(source)
                           if os.path.isfile(os.path.join(source, name)) and not name.startswith("."))
            os.makedirs(target, exist_ok=True)
            for name in names:
                shutil.copyfile(os.path.join(source, name), os.path.join(target, name))
            items = "\n".join(f'<li><a href="{html.escape(name)}">{html.escape(name)}</a></li>'
                              for name in names)
            with open(os.path.join(target, "index.html"), "w", encoding="utf-8") as file:
                file.write(f"<!DOCTYPE html>\n<meta charset=\"utf-8\">\n<title>{html.escape(path)}</title>\n"
                           f"<h1>{html.escape(path)}</h1>\n<ul>\n{items}\n</ul>\n")
            return f"source/{path}/index.html"
        # Hidden folders are not served everywhere.
        visible = "/".join(part.lstrip(".") for part in path.split("/"))
        target = os.path.join(self.files_folder, visible)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        shutil.copyfile(source, target)
        return "source/" + visible

    def link(self, page, match):
        picture, text, target = match.groups()
        text = text.replace("\n", " ")
        if re.match(r"[a-z]+:", target):
            return match.group(0)
        path, _, anchor = target.partition("#")
        path = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
        if not os.path.exists(os.path.join(ROOT, path)):
            self.problems.append(f"{page}: no such file: {target}")
            return text
        if picture:
            return f"![{text}]({os.path.basename(path)})"
        if path not in self.pages:
            return f"[{text}]({self.copy_file(path)})"
        if not anchor or self.anchors[path].get(anchor) == 1:
            if path == MAIN:
                return f"[{text}](@ref index)"
            if page == parent(path) and not anchor and path not in self.placed:
                self.placed.add(path)
                return f'@subpage {label(path)} "{text}"'
            return f"[{text}](@ref {label(path)})"
        if anchor not in self.anchors[path]:
            self.problems.append(f"{page}: no such heading: {target}")
        return f"[{text}](@ref {label(path, anchor)})"

    def prepare(self, page):
        lines = list(self.lines[page])
        for number, level, text, anchor in headings(lines):
            if level == 1:
                name = "mainpage" if page == MAIN else label(page)
            else:
                name = label(page, anchor)
            lines[number] = "#" * level + f" {text.replace('`', '')} {{#{name}}}"
        text = "".join(part if code else LINK.sub(lambda match: self.link(page, match), part)
                       for code, _, part in parts(lines))
        name = MAIN if page == MAIN else label(page) + ".md"
        with open(os.path.join(self.pages_folder, name), "w", encoding="utf-8") as file:
            file.write(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("pages", help="folder for the prepared pages")
    parser.add_argument("files", help="folder for files that pages link to")
    options = parser.parse_args()
    os.makedirs(options.pages, exist_ok=True)
    preparation = Preparation(options.pages, options.files)
    for page in preparation.pages:
        preparation.prepare(page)
    for problem in preparation.problems:
        print(problem, file=sys.stderr)
    return 1 if preparation.problems else 0


if __name__ == "__main__":
    sys.exit(main())

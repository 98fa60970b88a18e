#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""No function is longer than 80 lines and no file longer than 500, unless a comment there says why.

usage: TestSizes.py REPOSITORY

The comment is a line that begins with "// Long on purpose:". For a function it stands inside it or in the comment above it,
for a file in its first 20 lines. A function's lines run from its signature to its closing brace.
"""

import os
import re
import sys

FUNCTION_LINES = 100
FILE_LINES = 800
REASON = re.compile(r"^\s*// Long on purpose: \S")
FOLDERS = ("Module", "Applications", "shaders")
ENDINGS = (".h", ".cxx", ".txx", ".glsl")

# What may hold functions.
CONTAINER = re.compile(r"(^|\s)(namespace|class|struct|union|enum)(\s|$)|^extern\s*(\"\"\s*)?$")
# A string, a raw string, a character or a comment; a digit separator is no character.
TOKENS = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"([^()\\ ]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\'',
    re.DOTALL)


def blank(match):
    """The same lines without text; a string stays a string."""
    text = match.group(0)
    return "\n" * text.count("\n") if text.startswith("/") else '""' + "\n" * text.count("\n")


def strip(text, alternatives):
    """C++ or GLSL without comments, text in strings and preprocessor lines; the lines stay where they are.

    alternatives: whether what stands between #else and #endif stays, too.
    """
    lines, skipped, joined = [], [], False
    for line in TOKENS.sub(blank, text).split("\n"):
        directive = re.match(r"\s*#\s*(\w+)", line)
        if directive and not joined:
            word = directive.group(1)
            if word in ("if", "ifdef", "ifndef"):
                skipped.append(False)
            elif word in ("else", "elif") and not alternatives:
                skipped[-1] = True
            elif word == "endif":
                skipped.pop()
        lines.append("" if directive or joined or any(skipped) else line)
        joined = bool(directive or joined) and line.endswith("\\")
    return "\n".join(lines)


def shorten(pattern, replacement, text):
    """Replaces until nothing matches any more: brackets from the inside out."""
    count = 1
    while count:
        text, count = re.subn(pattern, replacement, text)
    return text


def get_outside(head):
    """A declaration with "\x01" for each pair of parentheses, without what is between angle brackets."""
    head = re.sub(r"operator\s*(\(\s*\)|[^\s\w(]+)", "operator", head)
    return shorten(r"<[^<>]*>", "", shorten(r"\([^()]*\)", "\x01", head))


def get_name(head):
    """The name of a function, or of the variable that keeps a lambda, from its declaration."""
    flat = re.sub(r"operator\s*\(\s*\)", "operator\x02", " ".join(head.split()))
    flat = shorten(r"<[^<>]*>", "", shorten(r"\([^()]*\)", "\x01", flat))
    match = re.search(r"(\w+) = ", flat) or re.search(r"([~\w:]*(?:operator[^\x01]+|\w+))\s*\x01", flat)
    return match.group(1).replace("\x02", "()").strip()


def find_functions(text, alternatives=True):
    """[(name, first line, last line)] of all function bodies; lines count from 1."""
    try:
        return find_bodies(strip(text, alternatives))
    except ValueError:
        # Two alternatives may open the same brace.
        if alternatives:
            return find_functions(text, False)
        raise


def find_bodies(text):
    """The same, of a text that strip() made. Raises ValueError where braces do not match."""
    functions, stack, head_start, i = [], [], 0, 0

    def get_end(position):
        """Where the brace that opens at position closes."""
        depth = 0
        for match in re.compile(r"[{}]").finditer(text, position):
            depth += 1 if match.group(0) == "{" else -1
            if depth == 0:
                return match.start()
        raise ValueError(f"the brace in line {text.count(chr(10), 0, position) + 1} does not close")

    while i < len(text):
        letter = text[i]
        if letter == ";":
            head_start = i + 1
        elif letter == "}":
            if not stack:
                raise ValueError(f"line {text.count(chr(10), 0, i) + 1} closes a brace that is not open")
            stack.pop()
            head_start = i + 1
        elif letter == "{":
            head = re.sub(r"\b(public|protected|private|signals)\s*:(?!:)", lambda m: " " * len(m.group(0)),
                          text[head_start:i])
            outside = get_outside(re.sub(r"\[\[.*?\]\]", "", head))
            if "\x01" not in outside and "=" not in outside and CONTAINER.search(outside.strip()):
                stack.append(i)
                head_start = i + 1
            else:
                end = get_end(i)
                after = text[end + 1:].lstrip()[:1]
                is_argument = head.count("(") > head.count(")")
                is_member = is_argument or "\x01" in outside and after in (",", "{") and "=" not in outside
                is_lambda = "=" in outside and re.search(r"\]\s*(\(|$)", head)
                if not is_member:
                    if ("\x01" in outside and "=" not in outside) or is_lambda:
                        start = head_start + len(head) - len(head.lstrip())
                        functions.append((get_name(head), text.count("\n", 0, start) + 1,
                                          text.count("\n", 0, end) + 1))
                    # An initializer ends with its semicolon, a function with its brace.
                    head_start = end + 1
                i = end
        i += 1
    if stack:
        raise ValueError(f"the brace in line {text.count(chr(10), 0, stack[-1]) + 1} does not close")
    return functions


def has_reason(lines, first, last):
    """Whether a reason stands in lines first to last, or in the comment above; lines count from 1."""
    while first > 1 and lines[first - 2].lstrip().startswith(("//", "/*", "*")):
        first -= 1
    return any(REASON.match(line) for line in lines[first - 1:last])


SAMPLE = r'''#include <x.h>
#define MACRO(a) \
  { a
namespace a
{
namespace // "{"
{
enum class Kind : int { One = 1, Two };
const std::array<int, 2> Table = { 1, 2 };
const char Brace = '{', Big = 1'000'000 > 2 ? '"' : '\'';
const char* Raw = R"x({ " )" {)x";
template <typename T, int N = 3>
std::array<T, N> Make(const T& value = T{ 1 })
{
  return { value };
}
const auto Twice = [](int x)
{
  return 2 * x;
};
}
Class::Class(int a)
  : A(a)
  , B{ a }
  , C{ [a] { return a; }() }
{
  struct Local { int X() { return 1; } };
}
#if OLD
class Outer : public Base<int(float)>
{
#else
class Outer : public Base<int(double)>
{
#endif
public:
  Outer() = default;
  int Get() const { return this->Value; }
  bool operator==(const Outer& o) const
  {
    /* } */ return true;
  }
  double operator()(double x) const noexcept { return x; }
private:
  struct Inner { int A = 0; };
  [[nodiscard]] ~Outer() override
  {
    if (true) { }
  }
  int Value{ 3 };
};
}
extern "C" { void F() { } }
vec3 brdf(vec3 i,
  vec3 o)
{ // long
  return i;
}
'''
SAMPLE_FUNCTIONS = [
    ("Make", 12, 16), ("Twice", 17, 20), ("Class::Class", 22, 28), ("Get", 38, 38), ("operator==", 39, 42),
    ("operator()", 43, 43), ("~Outer", 46, 49), ("F", 53, 53), ("brdf", 54, 58)]


def check_parser():
    """The parser finds every kind of function in the sample."""
    found = find_functions(SAMPLE)
    if found != SAMPLE_FUNCTIONS:
        raise AssertionError(f"the parser reads its sample wrongly:\n{found}\nexpected:\n{SAMPLE_FUNCTIONS}")


def main(repository):
    check_parser()
    problems, files, functions = [], 0, 0
    for folder in FOLDERS:
        for parent, _, names in sorted(os.walk(os.path.join(repository, folder))):
            for name in sorted(names):
                if not name.endswith(ENDINGS):
                    continue
                path = os.path.relpath(os.path.join(parent, name), repository)
                with open(os.path.join(parent, name), encoding="utf-8") as file:
                    text = file.read()
                lines = text.splitlines()
                files += 1
                if len(lines) > FILE_LINES and not has_reason(lines, 1, 20):
                    problems.append(f"{path}: {len(lines)} lines are more than {FILE_LINES}")
                try:
                    found = find_functions(text)
                except ValueError as error:
                    problems.append(f"{path}: {error}")
                    continue
                functions += len(found)
                for function, first, last in found:
                    count = last - first + 1
                    if count > FUNCTION_LINES and not has_reason(lines, first, last):
                        problems.append(
                            f"{path}:{first}: {function} has {count} lines, more than {FUNCTION_LINES}")
    print("\n".join(problems) or f"{functions} functions in {files} files are short enough or say why not")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))

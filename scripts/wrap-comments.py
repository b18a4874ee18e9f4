#!/usr/bin/env python3
"""Lines of comments in C++ files end at 120 characters: scripts/wrap-comments.py [--check] [file ...]

Paragraphs of comments that have a line of their own and a longer one are filled again; drawings and formulas, which
are indented, and comments behind code stay. Without files: all of the repository. --check changes nothing and exits
with 1 if a line of a comment is longer.
"""
import re
import sys
from pathlib import Path

WIDTH = 120
COMMENT = re.compile(r"^(\s*)(///<?|//)( ?)(.*)$")
TAG = re.compile(r"^(@(param\s+\S+|\w+)|\s*([-*]|\d+\.))\s+")  # a tag, or an item of a list


def filled(words, first, rest):
    lines, line = [], first
    for word in words:
        if len(line) + len(word) + 1 > WIDTH and line != first and line != rest:
            lines.append(line.rstrip())
            line = rest
        line += word if line.endswith(" ") else " " + word
    return lines + [line.rstrip()]


def paragraphs(block):
    """Texts of one comment as lists of lines; those that are drawn or indented alone."""
    part = []
    for text in block:
        starts = TAG.match(text) is not None or not text.strip()
        goes_on = part and TAG.match(part[0]) and text.startswith("  ")
        verbatim = text.startswith("  ") and not starts and not goes_on
        drawn = part and part[0].startswith("  ") and not TAG.match(part[0])
        if part and (starts or verbatim or drawn or not part[0].strip()):
            yield part
            part = []
        part.append(text)
    if part:
        yield part


def wrapped(block, lead):
    lines = []
    for part in paragraphs(block):
        drawn = part[0].startswith("  ") and not TAG.match(part[0])
        if all(len(lead + text) <= WIDTH for text in part) or drawn:
            lines += [(lead + text).rstrip() for text in part]
            continue
        tag = TAG.match(part[0])
        hang = " " * (len(part[1]) - len(part[1].lstrip())) if tag and len(part) > 1 else (
            " " * tag.end() if tag else "")
        first = lead + (part[0][:tag.end()] if tag else "")
        words = (part[0][tag.end():] if tag else part[0]).split()
        for text in part[1:]:
            words += text.split()
        lines += filled(words, first, lead + hang)
    return lines


def wrap(text):
    lines, result, i = text.split("\n"), [], 0
    while i < len(lines):
        found = COMMENT.match(lines[i])
        if not found or found.group(2) == "///<":
            result.append(lines[i])
            i += 1
            continue
        lead, block = found.group(1) + found.group(2), []
        while i < len(lines):
            next_one = COMMENT.match(lines[i])
            if not next_one or next_one.group(1) + next_one.group(2) != lead:
                break
            block.append(next_one.group(4))
            i += 1
        result += wrapped(block, lead + " ")
    return "\n".join(result)


def main(arguments):
    check = "--check" in arguments
    names = [a for a in arguments if a != "--check"] or sorted(
        str(path) for folder in ("include", "src", "tests", "bench") for path in Path(folder).rglob("*.?pp"))
    changed = 0
    for name in names:
        path = Path(name)
        before = path.read_text(encoding="utf-8")
        after = wrap(before)
        if after == before:
            continue
        changed += 1
        if not check:
            path.write_text(after, encoding="utf-8")
        print(("too long: " if check else "filled ") + name)
    return 1 if check and changed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

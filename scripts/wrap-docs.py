#!/usr/bin/env python3
"""Lines of prose in Markdown files end at 120 characters: scripts/wrap-docs.py [--check] [file ...]

Paragraphs and list items with a longer line are filled again; code, tables and headings stay. Between
`<!-- contents -->` and `<!-- /contents -->` stands a list of the headings below it, which is made anew. Without
files: all of the repository. --check changes nothing and exits with 1 if something would change.
"""
import re
import sys
from pathlib import Path

WIDTH = 120
BEGIN, END = "<!-- contents -->", "<!-- /contents -->"
ITEM = re.compile(r"^(\s*)([-*+]|\d+\.)(\s+)")
WORD = re.compile(r"(?:`[^`]*`|\S)+")
# At the beginning of a line these would mean something else.
NOT_FIRST = re.compile(r"^([-+*=#>|]+|\d+[.)])$|^[#>|]")


def fill(text, first, rest):
    """The words of text in lines of at most WIDTH characters. A piece of code is one word."""
    words = []
    for word in WORD.findall(text):
        if words and NOT_FIRST.match(word):
            words[-1] += " " + word
        else:
            words.append(word)
    lines, line = [], first
    empty = True
    for word in words:
        if not empty and len(line) + 1 + len(word) > WIDTH:
            lines.append(line)
            line, empty = rest, True
        line += word if empty else " " + word
        empty = False
    return lines + [line]


def paragraph(lines):
    """Lines of one paragraph or list item, filled if one is too long."""
    if all(len(line) <= WIDTH for line in lines):
        return lines
    item = ITEM.match(lines[0])
    quote = re.match(r"^(\s*>\s?)", lines[0])
    if item:
        first = item.group(0)
        rest = " " * len(first)
        text = lines[0][len(first):] + " " + " ".join(lines[1:])
    elif quote:
        first = rest = quote.group(0)
        text = " ".join(re.sub(r"^\s*>\s?", "", line) for line in lines)
    else:
        first = rest = re.match(r"^\s*", lines[0]).group(0)
        text = " ".join(lines)
    # Lines that end in two blanks or a backslash end there.
    if any(line.endswith(("  ", "\\")) for line in lines[:-1]):
        return lines
    return fill(text, first, rest)


def is_alone(line):
    """Is it a line that no paragraph goes on with: a heading, a table, a rule, a comment, an image?"""
    return bool(re.match(r"^\s*(\||#{1,6} |<!--|<|---+\s*$)", line))


def wrapped(text):
    out, pending, code, before_blank = [], [], False, True

    def flush():
        out.extend(paragraph(pending) if pending else [])
        pending.clear()

    for line in text.split("\n"):
        fence = re.match(r"^\s*```", line)
        indented = before_blank and not pending and re.match(r"^ {4}", line) and not ITEM.match(line)
        if fence or code or not line.strip() or is_alone(line) or indented:
            flush()
            out.append(line)
            code = code != bool(fence)
            before_blank = not line.strip() or bool(indented)
            continue
        if ITEM.match(line) or (line.lstrip().startswith(">") and not (pending and pending[0].lstrip().startswith(">"))):
            flush()
        pending.append(line)
        before_blank = False
    flush()
    return "\n".join(out)


def anchor(title):
    title = re.sub(r"`|\*|\[([^\]]*)\]\([^)]*\)", lambda m: m.group(1) or "", title)
    return "".join("-" if c == " " else c.lower() for c in title if c in " -_" or c.isalnum())


def with_contents(text):
    if BEGIN not in text:
        return text
    head, rest = text.split(BEGIN, 1)
    _, body = rest.split(END, 1)
    entries, code = [], False
    for line in body.split("\n"):
        if line.startswith("```"):
            code = not code
        heading = re.match(r"^(##|###) (.*)$", line)
        if heading and not code:
            indent = "" if heading.group(1) == "##" else "  "
            title = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.group(2))
            entries.append(f"{indent}- [{title}](#{anchor(heading.group(2))})")
    return head + BEGIN + "\n" + "\n".join(entries) + "\n" + END + body


def main(arguments):
    check = "--check" in arguments
    root = Path(__file__).resolve().parent.parent
    files = [Path(a) for a in arguments if a != "--check"]
    if not files:
        files = sorted(p for p in root.rglob("*.md") if not {"build", "results", ".git"} & set(p.relative_to(root).parts))
    stale = []
    for file in files:
        text = file.read_text(encoding="utf-8")
        new = wrapped(with_contents(text))
        if new == text:
            continue
        stale.append(str(file))
        if not check:
            file.write_text(new, encoding="utf-8")
    for file in stale:
        print(("would change " if check else "filled ") + file)
    return 1 if check and stale else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

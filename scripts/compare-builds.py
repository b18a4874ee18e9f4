#!/usr/bin/env python3
"""Two builds over the case library: scripts/compare-builds.py OLD NEW [case.toml ...]

OLD and NEW are the programs `springfold`. Both run every case file (without files: all of cases/), and what differs is
printed: exit codes, which special points there are, and their numbers where they differ by more than 1e-10 of the size
of their column in that run. A point counts as the same where study, run, branch and name agree. Exit code 0 if nothing
differs, 1 otherwise. Some minutes for the whole library.
"""
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

TOLERANCE = 1e-10
SECONDS = 600
WORDS = ("study", "run", "label", "branch", "event", "code", "detail", "row")  # columns that are no numbers of a point
ALONG = ("s",)  # arc length depends on the steps between


def special_points(program, case, folder):
    """Exit code, and per point its columns."""
    command = [program, "run", case, "--no-plots", "--threads", "1", "--out", folder]
    try:
        code = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=SECONDS).returncode
    except subprocess.TimeoutExpired:
        return "no end", {}
    table = Path(folder) / "events.csv"
    if not table.exists():
        return code, {}
    with table.open(newline="") as lines:
        rows = list(csv.DictReader(lines))
    return code, {(row["study"], row["run"], row["branch"], row["event"]): row for row in rows}


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return None


def sizes_of(points):
    """The largest value of every column of a run."""
    sizes = {}
    for (study, run, *_), row in points.items():
        for column, text in row.items():
            value = number(text)
            if value is not None and abs(value) != float("inf"):
                key = (study, run, column)
                sizes[key] = max(sizes.get(key, 0.0), abs(value))
    return sizes


def differences(old, new):
    """Lines that say what differs between the points of two runs."""
    for key in sorted(old.keys() - new.keys()):
        yield f"{' '.join(key)}: only in the old one, lambda = {old[key].get('lambda')}"
    for key in sorted(new.keys() - old.keys()):
        yield f"{' '.join(key)}: only in the new one, lambda = {new[key].get('lambda')}"
    sizes = sizes_of(old)
    for key in sorted(old.keys() & new.keys()):
        for column in old[key]:
            if column in WORDS or column in ALONG:
                continue
            a, b = old[key][column], new[key].get(column)
            if a == b:
                continue
            x, y = number(a), number(b)
            size = max(1.0, sizes.get((key[0], key[1], column), 0.0))
            if x is None or y is None or not abs(x - y) <= TOLERANCE * size:
                yield f"{' '.join(key)}: {column}: {a or 'nothing'} is now {b or 'nothing'}"


def main():
    if len(sys.argv) < 3 or sys.argv[1].startswith("-"):
        sys.exit(__doc__.strip())
    old, new = (str(Path(program).resolve()) for program in sys.argv[1:3])
    root = Path(__file__).resolve().parent.parent
    cases = [Path(name) for name in sys.argv[3:]] or sorted(root.glob("cases/*/case*.toml"))
    differing = points = 0
    for case in cases:
        with tempfile.TemporaryDirectory() as work:
            code_before, before = special_points(old, str(case), work + "/old")
            code_now, now = special_points(new, str(case), work + "/new")
        lines = list(differences(before, now))
        if code_before != code_now:
            lines.insert(0, f"exit code {code_before} is now {code_now}")
        differing += bool(lines)
        points += len(now)
        for line in lines:
            print(f"{case.parent.name}/{case.name}: {line}", flush=True)
    print(f"{len(cases)} case files, {points} points, {differing} files differ")
    sys.exit(1 if differing else 0)


if __name__ == "__main__":
    main()

"""What both comparisons share: programs and folders, alternation, verdicts."""

import math
import shutil
import sys
from pathlib import Path

from programs import Auto, Program, Tracer


class Verdicts:
    def __init__(self):
        self.lines = []

    def add(self, holds, text, counts=True):
        """counts: exit code 0 needs it."""
        self.lines.append((bool(holds), text, counts))

    def report(self):
        for title, wanted in (("What must hold", True), ("For comparison", False)):
            print(f"\n{title}")
            for holds, text, counts in self.lines:
                if counts == wanted:
                    print(f"  {'holds         ' if holds else 'DOES NOT HOLD '}  {text}")
        must = [holds for holds, _, counts in self.lines if counts]
        print(f"\n{sum(must)} of {len(must)} hold")
        return all(must)


def say(text=""):
    print(text, flush=True)


def give_up(text):
    """Nothing can be compared: exit code 2."""
    print(f"bench-peers: {text}", file=sys.stderr)
    sys.exit(2)


def ratio_of(slow, fast):
    return slow / fast if fast > 0 else math.inf


def alternate(repetitions, tasks):
    """Every task once, then every one again. A task that fails is not repeated."""
    runs = {name: [] for name in tasks}
    for _ in range(repetitions):
        for name, task in tasks.items():
            if runs[name] and runs[name][-1].failure:
                continue
            runs[name].append(task())
    return runs


def failed(runs):
    return runs[-1].failure


class Comparison:
    def __init__(self, options):
        self.quick = options.quick
        self.limit = 20.0 if options.quick else 60.0
        self.folder = Path(options.work)
        self.cases = Path(options.cases).resolve()
        self.auto = Auto(Path(options.auto).resolve())
        self.kernels = Path(options.kernels).resolve() if options.kernels else None
        self.tracer = Tracer(Path(options.tracer).resolve())
        self.program = Program(Path(options.springfold).resolve())
        self.verdicts = Verdicts()

    def place(self, name):
        folder = (self.folder / name).resolve()
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        return folder

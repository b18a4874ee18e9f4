#!/usr/bin/env python3
"""springfold beside AUTO-07p: the same curves in alternation, medians, ratios, and whether they hold.

Called by scripts/bench-peers.sh, which builds the programs. Exit code 0: every ratio holds and both
find the same special points; 1: something does not hold (the last table says what); 2: wrong usage.
"""

import argparse
import json
import math
import shutil
import sys
from pathlib import Path

import closed_forms
import programs
from programs import Auto, Problem, Program, Tracer, median

LOCA = {20: 0.046e-3, 50: 0.11e-3, 100: 0.60e-3, 200: 4.0e-3, 400: 27.7e-3}  # s per point, see docs
SETTINGS = (("line", "one line per point", 3.0), ("nothing", "arithmetic alone", 2.0),
            ("default", "default output", 5.0))


class Verdicts:
    def __init__(self):
        self.lines = []

    def add(self, holds, text):
        self.lines.append((bool(holds), text))

    def report(self):
        print("\nWhat must hold")
        for holds, text in self.lines:
            print(f"  {'holds         ' if holds else 'DOES NOT HOLD '}  {text}")
        failed = sum(not holds for holds, _ in self.lines)
        print(f"\n{len(self.lines) - failed} of {len(self.lines)} hold")
        return failed == 0


def say(text=""):
    print(text, flush=True)


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

    # ---- (a) the planar Orthoglide

    def orthoglide(self):
        problem = programs.orthoglide(self.cases / "orthoglide-planar")
        folder = self.place("orthoglide")
        coarse = self.tracer.trace(problem, folder, 0.01, 1000000, "nothing")
        length = self.tracer.curve(coarse).length
        say("(a) Planar Orthoglide at Q2, 10 unknowns: CPU seconds of the whole process (medians)\n")
        say(f"  {'':20} {'points':>8} {'AUTO-07p':>10} {'springfold':>11} {'ratio':>7}")
        sizes = {1000: 7, 10000: 3} if self.quick else {1000: 15, 10000: 9, 100000: 5}
        times = {}
        for points, repetitions in sizes.items():
            times.update(self.orthoglide_at(problem, folder, length, points, repetitions))
        self.orthoglide_slopes(times, list(sizes))
        self.start_up(folder, problem, length)
        self.branch_point()

    def orthoglide_at(self, problem, folder, length, points, repetitions):
        step, most = length / points, 2 * points
        tasks = {}
        for setting, _, _ in SETTINGS:
            tasks["AUTO", setting] = lambda s=setting: self.auto.trace(problem, folder, step, most, s)
            ours = self.program if setting == "default" else self.tracer
            tasks["springfold", setting] = (
                lambda s=setting, o=ours: o.trace(problem, folder, step, most, s))
        runs = alternate(repetitions, tasks)
        times = {}
        for setting, words, _ in SETTINGS:
            theirs, ours = runs["AUTO", setting], runs["springfold", setting]
            if failed(theirs) or failed(ours):
                sys.exit(f"{setting}, {points} points: {failed(theirs) or failed(ours)}")
            a, s = median(theirs), median(ours)
            say(f"  {words:20} {points:8} {a:10.4f} {s:11.4f} {ratio_of(a, s):7.2f}")
            times[setting, points] = (a, s)
        self.same_limit_points(problem, folder, runs["springfold", "line"][-1], points)
        return times

    def same_limit_points(self, problem, folder, traced, points):
        known = [value for _, value in closed_forms.orthoglide_points(programs.P)]
        auto, ours, table = (self.auto.curve(problem, folder), self.tracer.curve(traced),
                             self.program.curve(folder))

        def values(curve):
            return [v for label, v in curve.special if label == "LP"]

        def off(found, wanted):
            return (max(abs(f - w) for f, w in zip(found, wanted))
                    if len(found) == len(wanted) else math.inf)

        apart = max(off(values(ours), values(auto)), off(values(table), values(auto)))
        wrong = max(off(values(ours), known), off(values(table), known))
        counts = [auto.points, ours.points, table.points]
        self.verdicts.add(apart <= 1e-7, f"(a) {points} points: both find the same limit points, "
                                         f"apart {apart:.1e} (1e-7)")
        self.verdicts.add(wrong <= 1e-10, f"(a) {points} points: limit points off the closed form by "
                                          f"{wrong:.1e} (1e-10)")
        self.verdicts.add(max(counts) - min(counts) <= 0.02 * points,
                          f"(a) {points} points: as many points on the same arc, {counts}")

    def orthoglide_slopes(self, times, sizes):
        low, high = sizes[0], sizes[-1]
        say(f"\n  CPU microseconds per point, by the slope from {low} to {high} points\n")
        say(f"  {'':20} {'':8} {'AUTO-07p':>10} {'springfold':>11} {'ratio':>7} {'wanted':>7}")
        for setting, words, wanted in SETTINGS:
            slopes = [1e6 * (times[setting, high][i] - times[setting, low][i]) / (high - low)
                      for i in (0, 1)]
            ratio = ratio_of(*slopes)
            say(f"  {words:20} {'':8} {slopes[0]:10.2f} {slopes[1]:11.2f} {ratio:7.2f} {wanted:7.1f}")
            whole = ratio_of(*times[setting, high])
            self.verdicts.add(ratio >= wanted, f"(a) {words}: {ratio:.2f} times faster per point "
                                               f"({wanted:.0f} wanted)")
            self.verdicts.add(whole >= wanted, f"(a) {words}: {whole:.2f} times faster as a whole "
                                               f"process at {high} points ({wanted:.0f} wanted)")

    def start_up(self, folder, problem, length):
        """From start to exit, less what the program itself counts for the curve."""
        beyond = []
        for _ in range(5):
            done = self.program.trace(problem, folder, length / 1000, 2000)
            traced = self.program.traced_seconds(folder)
            beyond.append((done.elapsed - traced, done.cpu - traced))
        elapsed, cpu = (sorted(1e3 * b[i] for b in beyond)[2] for i in (0, 1))
        self.verdicts.add(elapsed <= 10, f"(a) start to exit beyond the tracing: {elapsed:.1f} ms "
                                         f"elapsed, of it {cpu:.1f} ms CPU (10 ms)")

    def branch_point(self):
        """Under the command of Q1 there is a limit point, then a branch point."""
        problem = programs.orthoglide(self.cases / "orthoglide-planar", -programs.P, -1.2)
        folder = self.place("orthoglide-q1")
        known = closed_forms.orthoglide_points(-programs.P)
        coarse = self.tracer.curve(self.tracer.trace(problem, folder, 0.1, 100000, "nothing"))
        step = coarse.length / 1000
        traced = self.tracer.curve(self.tracer.trace(problem, folder, step, 4000, "nothing"))
        found = [s for s in traced.special if s[0] in ("LP", "BP", "UR")]
        same = [label for label, _ in found] == [label for label, _ in known]
        off = max(abs(f[1] - k[1]) for f, k in zip(found, known)) if same else math.inf
        self.verdicts.add(off <= 1e-10, f"(a) under the command of Q1: limit and branch point off the "
                                        f"closed form by {off:.1e} (1e-10)")
        self.auto.trace(problem, folder, step, 4000, "line", self.limit)
        theirs = [v for label, v in self.auto.curve(problem, folder).special if label == "BP"]
        wanted = [v for label, v in known if label == "BP"]
        say("\n  Branch point under the command of Q1: springfold "
            + (f"finds it, off by {off:.1e}" if same else "DOES NOT FIND it") + "; AUTO-07p "
            + (f"finds it, off by {abs(theirs[0] - wanted[0]):.1e}" if len(theirs) == 1 else
               f"labels {len(theirs)} branch points there") + f" (tolerance {programs.TOLERANCE:g})")

    def floor(self):
        """Engine overhead: an accepted point against the kernels that it cannot do without."""
        if not self.kernels or not self.kernels.exists():
            say("\nspringfold_bench was not built (libbenchmark-dev): the floor of a point is not measured")
            self.verdicts.add(False, "cost of an accepted point against its floor: not measured")
            return
        folder = self.place("kernels")
        done = programs.run([self.kernels, "--benchmark_filter=^(floor_of_a_point|accepted_point)$",
                             "--benchmark_format=json", "--benchmark_repetitions=5"],
                            folder, folder / "kernels.json")
        if done.failure:
            sys.exit(f"springfold_bench: {done.failure}")
        medians = {b["run_name"]: b for b in json.loads((folder / "kernels.json").read_text())["benchmarks"]
                   if b.get("aggregate_name") == "median"}
        floor = medians["floor_of_a_point"]["cpu_time"]  # us
        point = 1e6 * medians["accepted_point"]["per_point"]
        say(f"\n  An accepted point costs {point:.2f} us, the kernels of its floor {floor:.2f} us")
        self.verdicts.add(point <= 4 * floor, f"(a) an accepted point costs {point / floor:.1f} times "
                                              f"its floor (4)")

    # ---- (b) the column of N links

    def columns(self):
        say("\n(b) Column of N links, skew load, 200 points: CPU ms per point (slope from 20 points)\n")
        say(f"  {'N':>6} {'AUTO-07p':>10} {'springfold':>11} {'ratio':>7} {'run':>9} {'ratio':>7} "
            f"{'LOCA':>7}   one line per point; run: springfold run with all columns")
        numbers = [5, 20, 50, 100] if self.quick else [5, 20, 50, 100, 200, 400]
        alive = {"AUTO", "springfold", "run"}
        length = 1.4
        for links in numbers:
            problem, folder = programs.column(links), self.place(f"column-{links}")
            if links <= 100:  # hardly any change beyond
                coarse = self.tracer.trace(problem, folder, 0.02, 1000000, "nothing", self.limit)
                length = self.tracer.curve(coarse).length
            self.column_at(links, problem, folder, length, alive)
        self.long_columns(length)
        self.buckling_loads(numbers + ([] if self.quick else [1000, 10000]))

    def auto_step(self, problem, folder, links):
        """AUTO's arc length is that of its own unknowns: measured once on few points."""
        step = 0.025 * math.sqrt(links)
        self.auto.trace(problem, folder, step, 1000000, "line", self.limit)
        return step * (self.auto.curve(problem, folder).points - 1) / 200

    def column_at(self, links, problem, folder, length, alive):
        repetitions = 1 if links >= 400 else 3 if links >= 100 else 7
        steps = {"AUTO": self.auto_step(problem, folder, links) if "AUTO" in alive else 0}
        steps["springfold"] = steps["run"] = length / 200
        who = {"AUTO": self.auto, "springfold": self.tracer, "run": self.program}
        tasks = {(name, points): lambda n=name, p=points: who[n].trace(
                     problem, folder, steps[n], p, "line", self.limit)
                 for points in (20, 1000) for name in who if name in alive}
        runs = alternate(repetitions, tasks)
        curves, seconds = {}, {}
        for name in sorted(alive):
            failure = failed(runs[name, 20]) or failed(runs[name, 1000])
            if failure:
                say(f"  {links:6} {who[name].name}: {failure}; larger N are not tried")
                alive.discard(name)
                continue
            curves[name] = (self.tracer.curve(runs[name, 1000][-1]) if name == "springfold"
                            else self.program.curve(folder) if name == "run"
                            else self.auto.curve(problem, folder))
            more = max(1, curves[name].points - 20)
            seconds[name] = max(1e-9, median(runs[name, 1000]) - median(runs[name, 20])) / more
        self.column_verdicts(links, seconds, curves)

    def column_verdicts(self, links, seconds, curves):
        auto = seconds.get("AUTO", math.nan)
        ours, run = seconds.get("springfold", math.inf), seconds.get("run", math.inf)
        loca = LOCA.get(links, math.nan)
        say(f"  {links:6} {1e3 * auto:10.4f} {1e3 * ours:11.4f} {auto / ours:7.2f} {1e3 * run:9.4f} "
            f"{auto / run:7.2f} {1e3 * loca:7.3f}")
        if links >= 20:
            wanted = 100 if links == 400 else 1
            for words, value in (("one line per point", ours), ("springfold run", run)):
                if not math.isnan(auto):
                    self.verdicts.add(auto / value > wanted, f"(b) N = {links}, {words}: "
                                      f"{auto / value:.2f} times faster ({wanted} wanted)")
            if not math.isnan(loca):
                self.verdicts.add(ours < loca, f"(b) N = {links}: {1e3 * ours:.3f} ms per point, LOCA "
                                               f"needed {1e3 * loca:.3f} ms")
        if "AUTO" in curves:
            ends = [c.end for name, c in curves.items() if name != "AUTO"]
            apart = max((abs(e - curves["AUTO"].end) for e in ends), default=math.inf)
            self.verdicts.add(apart <= 1e-7, f"(b) N = {links}: the same end, apart {apart:.1e} (1e-7)")

    def long_columns(self, length):
        numbers = [500, 1000] if self.quick else [500, 1000, 2000, 5000, 10000]
        say("\n  springfold alone: CPU ms per point; whole process with one line per point\n")
        say(f"  {'N':>6} {'ms/point':>9} {'seconds':>8} {'MB':>7}")
        measured = {}
        for links in numbers:
            problem, folder = programs.column(links), self.place(f"column-{links}")
            few = self.tracer.trace(problem, folder, length / 200, 20, "line", self.limit)
            all_ = few if few.failure else self.tracer.trace(problem, folder, length / 200, 1000,
                                                             "line", self.limit)
            if all_.failure:
                say(f"  {links:6} {all_.failure}; larger N are not tried")
                break
            points = self.tracer.curve(all_).points
            measured[links] = (all_.cpu - few.cpu) / max(1, points - 20)
            say(f"  {links:6} {1e3 * measured[links]:9.3f} {all_.cpu:8.2f} {all_.memory / 1e6:7.0f}")
            if links == 10000:
                self.verdicts.add(all_.elapsed <= 30 and all_.memory <= 2 << 30 and points >= 190,
                                  f"(b) N = 10000: {points} points in {all_.elapsed:.1f} s and "
                                  f"{all_.memory / 1e6:.0f} MB (30 s, 2 GB)")
        self.growth(numbers, measured)

    def growth(self, numbers, measured):
        if len(measured) < len(numbers):
            self.verdicts.add(False, f"(b) growth between N = {numbers[0]} and {numbers[-1]}: not "
                                     f"measured, {len(measured)} of {len(numbers)} columns done")
            return
        x = [math.log(n) for n in measured]
        y = [math.log(t) for t in measured.values()]
        mx, my = sum(x) / len(x), sum(y) / len(y)
        power = (sum((a - mx) * (b - my) for a, b in zip(x, y))
                 / sum((a - mx)**2 for a in x))
        self.verdicts.add(power <= 1.15, f"(b) growth between N = {numbers[0]} and {numbers[-1]}: "
                                         f"exponent {power:.2f} (1.15)")

    def buckling_loads(self, numbers):
        say("\n  Straight column: buckling loads up to 25 against the closed form\n")
        for links in numbers:
            problem = Problem(f"straight:{links}", 25.0, "", "", "")
            folder = self.place(f"straight-{links}")
            done = self.tracer.trace(problem, folder, 25 / links / 50, 1000, "nothing", self.limit)
            known = closed_forms.buckling_loads(links, 25)
            found = [] if done.failure else [v for label, v in self.tracer.curve(done).special
                                             if label == "BP"]
            if done.failure or len(found) != len(known):
                say(f"  N = {links}: {done.failure or f'{len(found)} of {len(known)} found'}")
                self.verdicts.add(False, f"(b) N = {links}: buckling loads of the straight column: "
                                  + (done.failure or f"{len(found)} of {len(known)} found"))
                if done.failure:
                    say("  larger N are not tried")
                    return
                continue
            off = max(abs(f - k) / k for f, k in zip(found, known))
            say(f"  N = {links}: {len(found)} found, off by {off:.1e} at most, {done.cpu:.2f} s")
            self.verdicts.add(off <= 1e-9, f"(b) N = {links}: buckling loads of the straight column off "
                                           f"by {off:.1e} (1e-9)")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--auto", required=True, help="folder with the compiled AUTO programs")
    parser.add_argument("--tracer", required=True, help="springfold_trace")
    parser.add_argument("--kernels", help="springfold_bench")
    parser.add_argument("--springfold", required=True, help="the program springfold")
    parser.add_argument("--cases", required=True, help="folder of the case library")
    parser.add_argument("--work", required=True, help="folder for the runs; its contents are replaced")
    parser.add_argument("--quick", action="store_true", help="fewer sizes and repetitions")
    comparison = Comparison(parser.parse_args())
    comparison.orthoglide()
    comparison.floor()
    comparison.columns()
    sys.exit(0 if comparison.verdicts.report() else 1)


if __name__ == "__main__":
    main()

"""(a) The planar Orthoglide: 1,000 to 100,000 points on the same arc."""

import json
import math
import shutil
import statistics

import closed_forms
import programs
from comparison import alternate, failed, give_up, ratio_of, say
from programs import median

JUDGED = (2,)  # which of springfold's ways must be fast enough for exit code 0: 1 steps, 2 spacing
LONG_STEP = 0.05  # springfold's own largest step, where points lie between the steps
SETTINGS = (("line", "one line per point", 3.0), ("nothing", "arithmetic alone", 2.0),
            ("default", "default output", 5.0), ("short", "AUTO's line shortened", 3.0))
NOT_JUDGED = ("short",)  # AUTO writes no such lines, they only tell what they cost


def compare_orthoglides(c):
    problem = programs.orthoglide(c.cases / "orthoglide-planar")
    folder = c.place("orthoglide")
    coarse = c.tracer.trace(problem, folder, 0.01, 1000000, "nothing")
    length = c.tracer.curve(coarse).length
    # The program measures the same arc in units of its own, those of the response at the start.
    c.program.trace(problem, folder, 0.01, 1000000)
    own_length = c.program.curve(folder).length
    say("(a) Planar Orthoglide at Q2, 10 unknowns: CPU seconds of the whole process (medians)\n")
    say(f"  {'':22} {'points':>6} {'AUTO-07p':>10} {'springfold':>11} {'ratio':>7} {'spacing':>9} "
        f"{'ratio':>7}")
    sizes = {1000: 7, 10000: 3, 100000: 1} if c.quick else {1000: 15, 10000: 9, 100000: 5}
    times = {}
    for points, repetitions in sizes.items():
        times.update(orthoglide_at(c, problem, folder, length, own_length, points, repetitions))
    orthoglide_slopes(c, times, list(sizes))
    start_up(c, folder, problem, own_length)
    branch_point(c)


def orthoglide_at(c, problem, folder, length, own_length, points, repetitions):
    """Three contestants: AUTO, springfold with as many steps, springfold with long steps and as
    many points between them."""
    most = 2 * points
    tasks = {}
    for setting, _, _ in SETTINGS:
        ours = c.program if setting == "default" else c.tracer
        own_step = (own_length if setting == "default" else length) / points
        spaced = c.place(f"orthoglide-spacing-{setting}")
        tasks["AUTO", setting] = lambda s=setting: c.auto.trace(problem, folder, length / points, most, s)
        if setting == "short":  # springfold's lines are as short already
            continue
        tasks["steps", setting] = (
            lambda s=setting, o=ours, d=own_step: o.trace(problem, folder, d, most, s))
        tasks["spacing", setting] = (lambda s=setting, o=ours, f=spaced, d=own_step: o.trace(
            problem, f, LONG_STEP, most, s, spacing=d))
    runs = alternate(repetitions, tasks)
    times = {}
    for setting, words, _ in SETTINGS:
        ours = "line" if setting == "short" else setting
        three = [runs["AUTO", setting], runs["steps", ours], runs["spacing", ours]]
        for one in three:
            if failed(one):
                give_up(f"{setting}, {points} points: {failed(one)}")
        a, s, r = (median(one) for one in three)
        say(f"  {words:22} {points:6} {a:10.4f} {s:11.4f} {ratio_of(a, s):7.2f} {r:9.4f} "
            f"{ratio_of(a, r):7.2f}")
        times[setting, points] = (a, s, r)
    curves = {"AUTO": c.auto.curve(problem, folder),
              "steps": c.tracer.curve(runs["steps", "line"][-1]),
              "spacing": c.tracer.curve(runs["spacing", "line"][-1]),
              "run": c.program.curve(folder),
              "run, spacing": c.program.curve(c.folder / "orthoglide-spacing-default")}
    same_limit_points(c, curves, points)
    return times


def same_limit_points(c, curves, points):
    known = closed_forms.orthoglide_points(programs.P)

    def off(found, wanted):
        same = [label for label, _ in found] == [label for label, _ in wanted]
        return max(abs(f[1] - w[1]) for f, w in zip(found, wanted)) if same else math.inf

    def values(name):
        return curves[name].singular()

    ours = [name for name in curves if name != "AUTO"]
    apart = max(off(values(name), values("AUTO")) for name in ours)
    wrong = max(off(values(name), known) for name in ours)
    counts = {name: curve.points for name, curve in curves.items()}
    same = [counts[name] / counts["AUTO"] for name in ("steps", "run")]
    c.verdicts.add(apart <= 1e-7, f"(a) {points} points: both find the same limit points, "
                                  f"apart {apart:.1e} (1e-7)")
    c.verdicts.add(wrong <= 1e-10, f"(a) {points} points: limit points off the closed form by "
                                   f"{wrong:.1e} (1e-10)")
    c.verdicts.add(min(same) >= 0.98 and max(same) <= 1.05 and min(counts.values()) >= 0.98 * points,
                   f"(a) {points} points: as many points on the same arc: "
                   + ", ".join(f"{name} {count}" for name, count in counts.items()))


def orthoglide_slopes(c, times, sizes):
    low, high = sizes[0], sizes[-1]
    say(f"\n  CPU microseconds per point, by the slope from {low} to {high} points\n")
    say(f"  {'':22} {'wanted':>6} {'AUTO-07p':>10} {'springfold':>11} {'ratio':>7} {'spacing':>9} "
        f"{'ratio':>7}")
    for setting, words, wanted in SETTINGS:
        a, s, r = (1e6 * (times[setting, high][i] - times[setting, low][i]) / (high - low)
                   for i in range(3))
        say(f"  {words:22} {wanted:6.1f} {a:10.2f} {s:11.2f} {ratio_of(a, s):7.2f} {r:9.2f} "
            f"{ratio_of(a, r):7.2f}")
        for i, way in ((1, "a step for every point"), (2, "points between long steps")):
            whole = ratio_of(times[setting, high][0], times[setting, high][i])
            point = ratio_of(a, (a, s, r)[i])
            c.verdicts.add(
                min(whole, point) >= wanted, f"(a) {words}, {way}: {point:.2f} times faster per point, "
                f"{whole:.2f} as a whole process at {high} points ({wanted:.0f} wanted)",
                i in JUDGED and setting not in NOT_JUDGED)


def start_up(c, folder, problem, length):
    """From start to exit of `springfold run`, less the CPU time that the program itself counts for the
    curve and its rows. Into a new folder and into one with results to be replaced, 1,000 points."""
    beyond = {"a new folder": [], "a folder with results": []}
    for _ in range(9):
        for words, runs in beyond.items():
            if words == "a new folder":
                shutil.rmtree(folder / "results", ignore_errors=True)
            done = programs.run_at_once(c.program.command(problem, folder, length / 1000, 2000))
            if done.failure:
                give_up(f"springfold run: {done.failure}")
            traced = c.program.traced_seconds(folder)
            runs.append((1e3 * (done.elapsed - traced), 1e3 * (done.cpu - traced)))
    say("\n  springfold run without figures, start to exit beyond the tracing: milliseconds (medians)\n")
    say(f"  {'':22} {'elapsed':>8} {'CPU':>8}   elapsed: without waiting for a processor")
    for words, runs in beyond.items():
        elapsed, cpu = (statistics.median(r[i] for r in runs) for i in (0, 1))
        say(f"  {words:22} {elapsed:8.1f} {cpu:8.1f}")
        c.verdicts.add(elapsed <= 10, f"(a) start to exit beyond the tracing, into {words}: "
                                      f"{elapsed:.1f} ms elapsed, {cpu:.1f} ms CPU (10 ms elapsed)")


def branch_point(c):
    """Under the command of Q1 there is a limit point, then a branch point."""
    problem = programs.orthoglide(c.cases / "orthoglide-planar", -programs.P, -1.2)
    folder = c.place("orthoglide-q1")
    known = closed_forms.orthoglide_points(-programs.P)
    coarse = c.tracer.curve(c.tracer.trace(problem, folder, 0.1, 100000, "nothing"))
    step = coarse.length / 1000
    traced = c.tracer.curve(c.tracer.trace(problem, folder, step, 4000, "nothing"))
    found = traced.singular()
    same = [label for label, _ in found] == [label for label, _ in known]
    off = max(abs(f[1] - k[1]) for f, k in zip(found, known)) if same else math.inf
    c.verdicts.add(off <= 1e-10, f"(a) under the command of Q1: limit and branch point off the "
                                 f"closed form by {off:.1e} (1e-10)")
    say("\n  Branch point under the command of Q1")
    say("    springfold: " + (f"off by {off:.1e}" if same else "NOT FOUND"))
    wanted = [v for label, v in known if label == "BP"]
    for tolerance in (programs.TOLERANCE, 1e-8):
        c.auto.trace(problem, folder, step, 4000, "line", c.limit, tolerance)
        theirs = [v for label, v in c.auto.curve(problem, folder).special if label == "BP"]
        say(f"    AUTO-07p at tolerance {tolerance:g}: "
            + (f"off by {abs(theirs[0] - wanted[0]):.1e}" if len(theirs) == 1
               else f"{len(theirs)} branch points labelled"))


def compare_with_floor(c):
    """Engine overhead: an accepted point against the kernels that it cannot do without."""
    if not c.kernels or not c.kernels.exists():
        say("\nspringfold_bench was not built (libbenchmark-dev): the floor of a point is not measured")
        c.verdicts.add(False, "cost of an accepted point against its floor: not measured")
        return
    folder = c.place("kernels")
    done = programs.run([c.kernels, "--benchmark_filter=^(floor_of_a_point|accepted_point<.*)$",
                         "--benchmark_format=json", "--benchmark_repetitions=5"],
                        folder, folder / "kernels.json")
    if done.failure:
        give_up(f"springfold_bench: {done.failure}")
    medians = {b["run_name"]: b for b in json.loads((folder / "kernels.json").read_text())["benchmarks"]
               if b.get("aggregate_name") == "median"}
    floor = medians["floor_of_a_point"]["cpu_time"]  # us
    point = 1e6 * medians["accepted_point<false>"]["per_point"]
    examined = 1e6 * medians["accepted_point<true>"]["per_point"]
    say(f"\n  An accepted point costs {point:.2f} us, with its step examined for jumps {examined:.2f} us; "
        f"the kernels of its floor {floor:.2f} us")
    c.verdicts.add(point <= 4 * floor, f"(a) an accepted point, with limit points, branch points and counts, "
                                       f"costs {point / floor:.1f} times its floor (4)")
    c.verdicts.add(examined <= 4 * floor, f"(a) an accepted point whose step is examined for jumps to other "
                                          f"branches costs {examined / floor:.1f} times its floor (4)", False)

"""(b) The column of N links, and springfold alone on long ones."""

import math

import closed_forms
import programs
from comparison import alternate, failed, say
from programs import Problem, median

LOCA = {20: 0.046e-3, 50: 0.11e-3, 100: 0.60e-3, 200: 4.0e-3, 400: 27.7e-3}  # s per point, see docs


POINTS = 200  # on the arc
LONG_STEP = 0.2  # the largest step where points lie between the steps: springfold takes shorter ones
# A step for every point; long steps; `springfold run` with long steps, beside AUTO's own default output.
WAYS = (("springfold", "AUTO"), ("spacing", "AUTO"), ("run", "AUTO default"))


def compare_columns(c):
    say("\n(b) Column of N links, skew load, 200 points: CPU ms per point\n")
    say(f"  {'N':>6} {'AUTO-07p':>10} {'springfold':>11} {'ratio':>7} {'spacing':>9} {'ratio':>7} "
        f"{'default':>9} {'run':>9} {'ratio':>7} {'LOCA':>7}   one line per point; AUTO's default "
        "output beside springfold run with all columns")
    numbers = [5, 20, 50, 100, 400] if c.quick else [5, 20, 50, 100, 200, 400]
    alive = {"AUTO", "AUTO default", *(way for way, _ in WAYS)}
    length = 1.4
    for links in numbers:
        problem, folder = programs.column(links), c.place(f"column-{links}")
        if links <= 100:  # hardly any change beyond
            coarse = c.tracer.trace(problem, folder, 0.02, 1000000, "nothing", c.limit)
            length = c.tracer.curve(coarse).length
        column_at(c, links, problem, folder, length, alive)
    long_columns(c, length)
    buckling_loads(c, numbers + [1000, 10000])


def auto_step(c, problem, folder, links):
    """AUTO's arc length is that of its own unknowns: measured once on few points."""
    step = 0.025 * math.sqrt(links)
    c.auto.trace(problem, folder, step, 1000000, "line", c.limit)
    return step * (c.auto.curve(problem, folder).points - 1) / POINTS


def tasks_at(c, problem, folder, length, links, alive):
    """Each contestant twice, so that what a process costs before its first point can be taken away: stopped
    after 20 points, or, with long steps, after the first one."""
    step = length / POINTS
    own = auto_step(c, problem, folder, links) if "AUTO" in alive else 0
    spaced, own_folder = c.place(f"column-spacing-{links}"), c.place(f"column-default-{links}")
    ways = {"AUTO": lambda p: c.auto.trace(problem, folder, own, p, "line", c.limit),
            "AUTO default": lambda p: c.auto.trace(problem, own_folder, own, p, "default", c.limit),
            "springfold": lambda p: c.tracer.trace(problem, folder, step, p, "line", c.limit),
            "spacing": lambda p: c.tracer.trace(problem, folder, LONG_STEP, p, "line", c.limit,
                                                spacing=step),
            "run": lambda p: c.program.trace(problem, spaced, LONG_STEP, p, limit=c.limit,
                                             spacing=step)}
    few = {"AUTO": 20, "AUTO default": 20, "springfold": 20, "spacing": 2, "run": 2}
    folders = {"run": spaced, "AUTO": folder, "AUTO default": own_folder}
    tasks = {(name, points): lambda n=name, p=points: ways[n](p)
             for name in ways if name in alive for points in (few[name], 1000)}
    return few, folders, tasks


def column_at(c, links, problem, folder, length, alive):
    repetitions = 1 if links >= 400 else 3 if links >= 100 else 7
    few, folders, tasks = tasks_at(c, problem, folder, length, links, alive)
    runs = alternate(repetitions, tasks)
    curves, seconds = {}, {}
    for name in sorted(alive):
        failure = failed(runs[name, few[name]]) or failed(runs[name, 1000])
        if failure:
            say(f"  {links:6} {name}: {failure}; larger N are not tried")
            alive.discard(name)
            continue
        curves[name] = (c.program.curve(folders[name]) if name == "run"
                        else c.auto.curve(problem, folders[name]) if name in folders
                        else c.tracer.curve(runs[name, 1000][-1]))
        points = POINTS if few[name] == 2 else max(1, curves[name].points - 20)
        seconds[name] = max(1e-9, median(runs[name, 1000]) - median(runs[name, few[name]])) / points
    column_verdicts(c, links, seconds, curves)


def column_verdicts(c, links, seconds, curves):
    loca = LOCA.get(links, math.nan)
    numbers = [(1e3 * seconds.get("AUTO", math.nan), 10, 4)]
    for (way, beside), width in zip(WAYS, (11, 9, 9)):
        mine, auto = seconds.get(way, math.inf), seconds.get(beside, math.nan)
        if beside == "AUTO default":
            numbers.append((1e3 * auto, 9, 4))
        numbers += [(1e3 * mine, width, 4), (auto / mine, 7, 2)]
    numbers.append((1e3 * loca, 7, 3))
    say(f"  {links:6} " + " ".join(f"{number:{width}.{digits}f}" if math.isfinite(number) else
                                   f"{'-':>{width}}" for number, width, digits in numbers))
    if links >= 20:
        for (way, beside), words in zip(WAYS, ("a step for every point", "points between long steps",
                                               "default output, points between long steps")):
            mine, auto = seconds.get(way, math.inf), seconds.get(beside, math.nan)
            wanted = 100 if links == 400 and way == "spacing" else 1
            if not math.isnan(auto):
                c.verdicts.add(auto / mine > wanted, f"(b) N = {links}, {words}: "
                               f"{auto / mine:.2f} times faster ({wanted} wanted)",
                               way != "springfold")
            if not math.isnan(loca) and way == "spacing":
                c.verdicts.add(mine < loca, f"(b) N = {links}: {1e3 * mine:.3f} ms per point, LOCA "
                                            f"needed {1e3 * loca:.3f} ms")
    if "AUTO" in curves:
        ends = [curve.end for name, curve in curves.items() if name != "AUTO"]
        apart = max((abs(e - curves["AUTO"].end) for e in ends), default=math.inf)
        singular = sum(len(curve.singular()) for curve in curves.values())
        c.verdicts.add(apart <= 1e-7 and singular == 0, f"(b) N = {links}: the same end, apart "
                       f"{apart:.1e} (1e-7), and {singular} special points (0)")


def long_columns(c, length):
    numbers = [500, 1000, 10000] if c.quick else [500, 1000, 2000, 5000, 10000]
    say("\n  springfold alone: CPU ms per point; whole process with one line per point\n")
    say(f"  {'N':>6} {'ms/point':>9} {'seconds':>8} {'MB':>7}")
    measured = {}
    for links in numbers:
        problem, folder = programs.column(links), c.place(f"column-{links}")
        few = c.tracer.trace(problem, folder, length / 200, 20, "line", c.limit)
        all_ = few if few.failure else c.tracer.trace(problem, folder, length / 200, 1000,
                                                      "line", c.limit)
        if all_.failure:
            say(f"  {links:6} {all_.failure}; larger N are not tried")
            break
        points = c.tracer.curve(all_).points
        measured[links] = (all_.cpu - few.cpu) / max(1, points - 20)
        say(f"  {links:6} {1e3 * measured[links]:9.3f} {all_.cpu:8.2f} {all_.memory / 1e6:7.0f}")
        if links == 10000:
            ten_thousand(c, problem, folder, length, all_, points)
    growth(c, numbers, measured)


def ten_thousand(c, problem, folder, length, traced, points):
    """200 points within 30 s and 2 GB: one line per point, and with all columns and files."""
    complete = c.program.trace(problem, folder, length / 200, 1000, limit=c.limit)
    for words, done in (("one line per point", traced), ("springfold run", complete)):
        c.verdicts.add(not done.failure and done.elapsed <= 30 and done.memory <= 2 << 30
                       and points >= 190, f"(b) N = 10000, {words}: {points} points in "
                       f"{done.elapsed:.1f} s and {done.memory / 1e6:.0f} MB (30 s, 2 GB) {done.failure}")


def growth(c, numbers, measured):
    if len(measured) < len(numbers):
        c.verdicts.add(False, f"(b) growth between N = {numbers[0]} and {numbers[-1]}: not "
                              f"measured, {len(measured)} of {len(numbers)} columns done")
        return
    x = [math.log(n) for n in measured]
    y = [math.log(t) for t in measured.values()]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    power = (sum((a - mx) * (b - my) for a, b in zip(x, y))
             / sum((a - mx)**2 for a in x))
    c.verdicts.add(power <= 1.15, f"(b) growth between N = {numbers[0]} and {numbers[-1]}: "
                                  f"exponent {power:.2f} (1.15)")


def buckling_loads(c, numbers):
    say("\n  Straight column: buckling loads up to 25 against the closed form\n")
    for links in numbers:
        problem = Problem(f"straight:{links}", 25.0, "", "", "")
        folder = c.place(f"straight-{links}")
        done = c.tracer.trace(problem, folder, 25 / links / 50, 1000, "nothing", c.limit)
        known = closed_forms.buckling_loads(links, 25)
        found = [] if done.failure else [v for label, v in c.tracer.curve(done).special
                                         if label == "BP"]
        if done.failure or len(found) != len(known):
            say(f"  N = {links}: {done.failure or f'{len(found)} of {len(known)} found'}")
            c.verdicts.add(False, f"(b) N = {links}: buckling loads of the straight column: "
                           + (done.failure or f"{len(found)} of {len(known)} found"))
            if done.failure:
                say("  larger N are not tried")
                return
            continue
        off = max(abs(f - k) / k for f, k in zip(found, known))
        say(f"  N = {links}: {len(found)} found, off by {off:.1e} at most, {done.cpu:.2f} s")
        c.verdicts.add(off <= 1e-9, f"(b) N = {links}: buckling loads of the straight column off "
                                    f"by {off:.1e} (1e-9)")

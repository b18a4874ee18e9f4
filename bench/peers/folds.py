"""The limit points of the planar Orthoglide followed over the stiffness of its knees: 200 points from the first
limit point without springs through the cusp to the second one. springfold takes long steps and gives points at even distances
between them, each with its residual checked."""

import math
import statistics

import programs
from comparison import alternate, failed, give_up, ratio_of, say
from programs import median

POINTS = 200
CUSP = (0.02958068452556, 0.04646511562177)  # stiffness and force, closed form
LAST = -0.029523906987403  # force at the second limit point without springs
LEAST = -1e-6  # where AUTO ends: just behind a stiffness of 0, where springfold ends itself


def auto_path(c, folder):
    """Without springs to the first limit point and beyond."""
    p = programs.P
    angle = math.asin(p)
    drive_command = p + math.cos(angle)
    growth = angle / (math.cos(angle) - math.sin(angle))
    u = [0, angle, 0, angle, 0, 0, 0, 0, p, p]
    constants = "NDIM = 10, U = {%s}, PAR = {2: %r, 3: 0.0, 4: %r}" % (
        ", ".join(f"{i + 1}: {value!r}" for i, value in enumerate(u)), drive_command, growth)
    problem = programs.Problem("orthoglide", 0.1, "orthoglide", constants, "")
    return c.auto.trace(problem, folder, 0.02, 200, "line")


def auto_start(c, folder):
    """Label of the first limit point, whose solution is where AUTO's curve begins."""
    done = auto_path(c, folder)
    if done.failure:
        give_up(f"AUTO-07p on the way to its limit point: {done.failure}")
    (folder / "fort.3").write_text((folder / "fort.8").read_text())
    for line in (folder / "fort.7").read_text().splitlines():
        words = line.split()
        if len(words) > 4 and words[0] != "0" and int(words[2]) == 2:
            return int(words[3])
    return give_up("AUTO-07p found no limit point")


def auto_folds(c, folder, label, step, most=5000):
    (folder / "fort.2").write_text(
        f"NDIM = 10, IPS = 0, IRS = {label}, ILP = 1, ISP = 0, ISW = 2, MXBF = 0, JAC = 1, IID = 0\n"
        f"ICP = [1, 3], NMX = {most}, NPR = 1000000000\n"
        f"EPSL = {programs.TOLERANCE!r}, EPSU = {programs.TOLERANCE!r}, EPSS = 1e-8\n"
        f"DS = {step!r}, DSMIN = 1e-9, DSMAX = {abs(step)!r}, IADS = 1, ITNW = 8\n"
        f"UZSTOP = {{3: {LEAST!r}}}\n")
    return programs.run([c.auto.programs / "orthoglide"], folder)


def auto_points(folder):
    """Stiffness and force of all points."""
    points = []
    for line in (folder / "fort.7").read_text().splitlines():
        words = line.split()
        if len(words) > 5 and words[0] != "0":
            points.append((float(words[-1].replace("D", "E")), float(words[4].replace("D", "E"))))
    return points


def our_case(c):
    p = programs.P
    return f"""include = "{c.cases}/orthoglide-planar/mechanism.toml"
[parameters]
Kv = 0
spacing = 0.01
[[study]]
name = "folds"
kind = "critical_curve"
control = "load"
direction = [1, 1]
start = {{ pose = [{p!r}, {p!r}], solve = "actuators" }}
until = {{ deflection = [-0.05, 0.6] }}
trace = {{ initial_step = 0.05, maximum_step = 0.05, spacing = "spacing" }}
critical_curve = {{ of = "LP1", parameter = "Kv", range = [0, 0.06] }}
"""


def our_folds(c, folder, spacing):
    (folder / "case.toml").write_text(our_case(c))
    return programs.run([c.program.program, "run", folder / "case.toml", "--no-plots", "--threads", "1", "--out",
                         folder / "results", "--set", f"spacing={spacing!r}"], folder)


def our_points(folder):
    table = next((folder / "results" / "branches").glob("*.csv"))
    rows = [line.split(",") for line in table.read_text().splitlines()]
    stiffness, force = rows[0].index("Kv"), rows[0].index("lambda")
    return [(float(row[stiffness]), float(row[force])) for row in rows[1:]]


def fitted_step(run, points, step):
    """The step, or the spacing, with which the curve has as many points as wanted."""
    for _ in range(4):
        done = run(step)
        if failed([done]):
            give_up(f"folds: {failed([done])}")
        step *= len(points()) / POINTS
    return step


def compare_folds(c):
    theirs, ours = c.place("folds-auto"), c.place("folds")
    label = auto_start(c, theirs)
    auto_step = fitted_step(lambda s: auto_folds(c, theirs, label, s),
                            lambda: auto_points(theirs), 0.005)
    our_spacing = fitted_step(lambda s: our_folds(c, ours, s), lambda: our_points(ours), 0.008)
    seconds = []

    def run_ours():
        done = our_folds(c, ours, our_spacing)
        seconds.append(c.program.traced_seconds(ours))
        return done

    first = c.place("folds-auto-first")
    (first / "fort.3").write_text((theirs / "fort.3").read_text())
    runs = alternate(5 if c.quick else 15, {
        "AUTO, path": lambda: auto_path(c, c.place("folds-auto-path")),
        "AUTO, first points": lambda: auto_folds(c, first, label, auto_step, 2),
        "AUTO": lambda: auto_folds(c, theirs, label, auto_step), "springfold": run_ours})
    for name, one in runs.items():
        if failed(one):
            give_up(f"folds, {name}: {failed(one)}")
    a, s = median(runs["AUTO"]), median(runs["springfold"])
    both, begin = a + median(runs["AUTO, path"]), median(runs["AUTO, first points"])
    study = statistics.median(seconds)
    say("\n(c) Planar Orthoglide, its limit points over the stiffness of the knees: CPU seconds of the whole process "
        "(medians)\n")
    say(f"  {'':22} {'points':>6} {'AUTO-07p':>10} {'springfold':>11} {'ratio':>7} {'its study':>10}")
    say(f"  {'critical curve':22} {POINTS:6} {a:10.4f} {s:11.4f} {ratio_of(a, s):7.2f} "
        f"{study:10.4f}")
    say(f"  {'and the path to it':22} {'':6} {both:10.4f} {s:11.4f} {ratio_of(both, s):7.2f}")
    say(f"  {'without process start':22} {'':6} {a - begin:10.4f} {study:11.4f} {ratio_of(a - begin, study):7.2f}")
    say("  The path to the limit point is a run of its own in AUTO; springfold's process, and its study, hold both.\n"
        "  Without process start: AUTO's run less one that ends at its second point; springfold's study. What that leaves out\n"
        "  is loading the program, and in springfold reading the case and writing its files.")
    counts = {"AUTO": auto_points(theirs), "springfold": our_points(ours)}
    c.verdicts.add(all(abs(len(p) - POINTS) <= 0.05 * POINTS for p in counts.values()),
                   "(c) as many points: " + ", ".join(f"{n} {len(p)}" for n, p in counts.items()))
    for name, points in counts.items():
        stiffest = max(points)
        off = max(abs(stiffest[0] - CUSP[0]), abs(points[-1][1] - LAST))
        c.verdicts.add(off <= 1e-4, f"(c) {name} goes round the cusp to the second limit point: {off:.1e} off (1e-4)",
                       name == "springfold")
    c.verdicts.add(s <= a, f"(c) a critical curve of {POINTS} points takes {1e3 * s:.0f} ms, AUTO's {1e3 * a:.0f} ms")

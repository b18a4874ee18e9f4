"""How AUTO-07p and springfold are run on the same problem, and how their results are read."""

import csv
import json
import math
import os
import resource
import statistics
import subprocess
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

TOLERANCE = 1e-12  # AUTO's EPSL and EPSU: springfold's own tolerance of residuals
P = 0.454  # the Orthoglide stands at (P, P), or at (-P, -P), without a load
KV = 0.01
SKEW = 0.01
FORCE_UNIT = 1 / 64  # of the Orthoglide's forces in springfold: how much lambda counts in arc lengths
MEMORY = 4 << 30  # no program gets more


@dataclass
class Run:
    """One process: CPU seconds (user and system), elapsed seconds, peak memory in bytes."""

    cpu: float = math.nan
    elapsed: float = math.nan
    memory: int = 0
    output: str = ""
    failure: str = ""


@dataclass
class Curve:
    """What a run found: its points, special points (label, lambda), the last point's measure."""

    points: int = 0
    special: list = field(default_factory=list)
    end: float = math.nan
    length: float = math.nan

    def singular(self):
        """Everything but ends: limit and branch points, and what nobody expects."""
        return [(label, value) for label, value in self.special if label not in ("END", "EP", "UZ")]


def run(command, folder, output=None, limit=60.0):
    """Runs to the end or to the limit in seconds; standard error is returned as text."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "LC_ALL": "C"}
    with open(output or os.devnull, "wb") as out, open(folder / "stderr", "wb") as err:
        begin = time.monotonic()
        process = subprocess.Popen(
            [str(word) for word in command], cwd=folder, stdout=out, stderr=err, env=environment,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY)))
        watch = threading.Timer(limit, process.kill)
        watch.start()
        _, status, usage = os.wait4(process.pid, 0)
        elapsed = time.monotonic() - begin
        watch.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    result = Run(usage.ru_utime + usage.ru_stime, elapsed, usage.ru_maxrss * 1024)
    result.output = (folder / "stderr").read_text(errors="replace")
    if process.returncode == -9 and elapsed >= limit:
        result.failure = f"not within {limit:.0f} s"
    elif process.returncode not in (0, 5):  # 5: the curve ended at its number of points
        result.failure = f"exit code {process.returncode}: {result.output.strip()[-200:]}"
    return result


def run_at_once(command):
    """The same without a limit and without output; nothing of this process counts as time of the other,
    and no waiting for a processor that other work holds (Linux tells)."""
    words = [str(word) for word in command]
    silent = [(os.POSIX_SPAWN_OPEN, number, os.devnull, os.O_WRONLY, 0) for number in (1, 2)]
    begin = time.monotonic()
    child = os.posix_spawn(words[0], words, {**os.environ, "OMP_NUM_THREADS": "1"}, file_actions=silent)
    os.waitid(os.P_PID, child, os.WEXITED | os.WNOWAIT)
    elapsed = time.monotonic() - begin
    schedule = Path(f"/proc/{child}/schedstat")
    waited = int(schedule.read_text().split()[1]) * 1e-9 if schedule.exists() else 0
    _, status, usage = os.wait4(child, 0)
    result = Run(usage.ru_utime + usage.ru_stime, elapsed - waited, usage.ru_maxrss * 1024)
    if os.waitstatus_to_exitcode(status) != 0:
        result.failure = f"exit code {os.waitstatus_to_exitcode(status)}"
    return result


@dataclass
class Problem:
    """A curve from lambda = 0 to lambda = stop."""

    name: str  # as springfold_trace calls it
    stop: float
    auto_program: str
    auto_constants: str
    case: str


def orthoglide(case_folder, at=P, stop=0.1):
    angle = math.asin(at)
    command = at + math.cos(angle) + KV * angle / (math.cos(angle) - math.sin(angle))
    drive = at - command + math.cos(angle)
    u = [drive, angle, drive, angle, drive, -drive, -drive, drive, at, at]
    constants = "NDIM = 10, U = {%s}, PAR = {2: %r, 3: %r}, THL = {1: %r}, THU = {%s}" % (
        ", ".join(f"{i + 1}: {value!r}" for i, value in enumerate(u)), command, KV,
        FORCE_UNIT**-2, ", ".join(f"{i}: 0.0" for i in range(5, 9)))
    low, high = (0, stop) if stop > 0 else (stop, "inf")
    case = f"""include = "{case_folder}/mechanism.toml"
[parameters]
Kv = {KV!r}
step = 0.01
spacing = 0
points = 1000000
[[study]]
name = "push"
control = "load"
direction = [1, 1]
start = {{ pose = [{at!r}, {at!r}], solve = "actuators" }}
until = {{ lambda = [{low}, {high}] }}
trace = {{ initial_step = "step", maximum_step = "step", maximum_points = "points", spacing = "spacing" }}
"""
    return Problem("orthoglide" if at > 0 else "orthoglide-q1", stop, "orthoglide", constants, case)


def column(links, stop=4.0):
    joint = ('  { joint = "revolute", axis = "z", role = "preloaded", '
             'spring = { law = "linear", stiffness = "k" } }, { rigid = ["l", 0] },\n')
    case = f"""[parameters]
k = {links}
l = "1/{links}"
skew = {SKEW!r}
step = 0.01
spacing = 0
points = 1000000
[[body]]
name = "tip"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "column"
elements = [
{joint * links}]
[[study]]
name = "press"
control = "load"
direction = ["-cos(skew)", "-sin(skew)"]
until = {{ lambda = [0, {stop!r}] }}
trace = {{ initial_step = "step", maximum_step = "step", maximum_points = "points", spacing = "spacing" }}
"""
    return Problem(f"column:{links}", stop, "column", f"NDIM = {links}", case)


class Auto:
    """AUTO-07p as a compiled program, without its Python driver."""

    name = "AUTO-07p"

    def __init__(self, programs):
        self.programs = programs  # folder with orthoglide, orthoglide-no_line, ...

    def trace(self, problem, folder, step, points, setting, limit=60.0, tolerance=TOLERANCE):
        """setting: line (one per point), short (cut to three numbers), nothing (labelled points only),
        default (diagnostics too)"""
        diagnostics = "" if setting == "default" else ", IID = 0"
        (folder / "fort.2").write_text(
            f"{problem.auto_constants}\n"
            f"IPS = 0, IRS = 0, ILP = 1, ISP = 1, ISW = 1, MXBF = 0, JAC = 1{diagnostics}\n"
            f"ICP = [1], NMX = {points}, NPR = 1000000000\n"
            f"EPSL = {tolerance!r}, EPSU = {tolerance!r}, EPSS = {max(1e-8, 1000 * tolerance)!r}\n"
            f"DS = {step!r}, DSMIN = 1e-9, DSMAX = {step!r}, IADS = 1, ITNW = 8\n"
            f"UZSTOP = {{1: {problem.stop!r}}}\n")
        (folder / "fort.3").write_text("")
        program = problem.auto_program + {"nothing": "-no_line", "short": "-short_line"}.get(setting, "")
        result = run([self.programs / program], folder, limit=limit)
        if not result.failure and " MX " in (folder / "fort.7").read_text(errors="replace"):
            result.failure = "no convergence"
        return result

    def curve(self, problem, folder):
        """After a run with lines."""
        labels = {1: "BP", 2: "LP", -4: "END", -9: "MX"}
        found = Curve()
        for line in (folder / "fort.7").read_text().splitlines():
            words = line.split()
            if len(words) < 5 or words[0] == "0":
                continue
            found.points += 1
            if int(words[2]) in labels:
                found.special.append((labels[int(words[2])], float(words[4].replace("D", "E"))))
        if problem.auto_program == "column":
            found.end = self._tip(folder)
        return found

    @staticmethod
    def _tip(folder):
        """Distance of the tip from the base at the last labelled point of fort.8."""
        lines = (folder / "fort.8").read_text().splitlines()
        first = 0
        while first < len(lines):  # to the last labelled point
            header = [int(word) for word in lines[first].split()]
            following = first + 1 + header[8]
            if following >= len(lines):
                break
            first = following
        entries = " ".join(lines[first + 1:]).split()
        angles = [float(x) for x in entries[1:header[7]]]
        return math.hypot(sum(map(math.cos, angles)), sum(map(math.sin, angles))) / len(angles)


class Tracer:
    """springfold's library behind a minimal program: lines of three numbers, or nothing."""

    name = "springfold"

    def __init__(self, program):
        self.program = program

    def trace(self, problem, folder, step, points, setting, limit=60.0, spacing=0.0):
        return run([self.program, problem.name, repr(step), repr(spacing), points,
                    repr(problem.stop), setting], folder, folder / "lines", limit)

    @staticmethod
    def curve(result):
        found = Curve()
        for line in result.output.splitlines():
            words = line.replace(",", "").split()
            if words and words[0] in ("LP", "BP", "END", "UR"):
                found.special.append((words[0], float(words[1])))
                found.end = float(words[2])
            elif words and words[0] == "points":
                found.points, found.length = int(words[1]), float(words[3])
        return found


class Program:
    """`springfold run` on a case file: all columns, all result files, no figures."""

    name = "springfold run"

    def __init__(self, program):
        self.program = program

    def trace(self, problem, folder, step, points, setting="default", limit=60.0, spacing=0.0):
        return run(self.command(problem, folder, step, points, spacing), folder, limit=limit)

    def command(self, problem, folder, step, points, spacing=0.0):
        case = folder / "case.toml"
        if not case.exists():
            case.write_text(problem.case)
        return [self.program, "run", case, "--no-plots", "--out", folder / "results",
                "--set", f"step={step!r}", "--set", f"spacing={spacing!r}", "--set", f"points={points}"]

    @staticmethod
    def curve(folder):
        found = Curve()
        with open(folder / "results" / "events.csv", newline="") as file:
            for row in csv.DictReader(file):
                found.special.append((row["code"], float(row["lambda"])))
        table = next((folder / "results" / "branches").glob("*.csv"))
        lines = table.read_text().splitlines()
        row = dict(zip(lines[0].split(","), lines[-1].split(",")))
        found.points, found.length = len(lines) - 1, float(row["s"])
        if "tip.x" in row:
            found.end = math.hypot(float(row["tip.x"]), float(row["tip.y"]))
        return found

    @staticmethod
    def traced_seconds(folder):
        """CPU seconds that the program itself counts for its study."""
        return json.loads((folder / "results" / "timings.json").read_text())["cpu_seconds"]


def median(runs, what="cpu"):
    return statistics.median(getattr(r, what) for r in runs)

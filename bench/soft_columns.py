#!/usr/bin/env python3
"""Straight columns whose hinges are of very different stiffness: every critical load against exact arithmetic.

    bench/soft_columns.py PROGRAM [COUNT] [SEED] [--decades D] [--askew] [--keep DIR]

A column of 2 to 4 links L_i stands on its foot; hinge i has a linear spring K_i, drawn over D orders of magnitude, and
the top is pressed down by lambda. In the angles theta_i of the links the energy is

    1/2 sum K_i (theta_i - theta_(i-1))^2 - lambda sum L_i (1 - cos theta_i),     theta_0 = 0,

so that the straight state is critical where det(K - lambda diag(L)) = 0, K tridiagonal. Roots are counted by the signs of the
pivots in fractions, so the truth has no rounding. Judged: the branch points within the range of lambda, nothing else on the
straight branch, the number of unstable modes in every row, and that nothing is left open.

--askew presses the top under an angle of 1e-9 to 0.1 instead: the straight state is no equilibrium then. The path from the start
bends beside the first critical load and stays stable: no event, index 0 in every row, up to the limits.
"""
import argparse, csv, math, pathlib, random, subprocess, sys, tempfile
from fractions import Fraction

HINGE = """  {{ joint = "revolute", axis = "z", name = "q{i}", role = "preloaded", spring = {{ law = "linear", stiffness = {k!r} }} }},
  {{ rigid = [0, {length!r}] }},
"""
CASE = """[[body]]
name = "top"
task_space = "xy"
pose = [0, {height!r}]
[[chain]]
name = "a"
elements = [
{hinges}]
[[study]]
name = "press"
control = "load"
direction = [{askew!r}, -1]
until = {{ lambda = [{low!r}, {high!r}], top.x = [-{height!r}, {height!r}], {knees} }}
branches = {{ depth = {depth} }}
"""
WITHIN = 1e-9  # of the load itself
NOT_JUDGED = ("ST", "EP", "UR")  # ends; what is unresolved counts as such


def below(load, stiffness, lengths):
    """How many critical loads lie below this one: negative pivots of K - load diag(L), exactly."""
    n, count, pivot = len(lengths), 0, None
    for i in range(n):
        entry = stiffness[i] + (stiffness[i + 1] if i + 1 < n else 0) - load * lengths[i]
        pivot = entry - (stiffness[i] ** 2 / pivot if pivot is not None else 0)
        if pivot == 0:
            return None
        count += pivot < 0
    return count


def root(number, stiffness, lengths):
    """The critical load of this number, by bisection of its logarithm: to the last digit of a double."""
    low, high = -400.0, math.log10(float(max(stiffness)) * 8 * len(lengths) / float(min(lengths)))
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (low, middle) if below(Fraction(10**middle), stiffness, lengths) > number else (middle, high)
    low, high = 10.0**low, 10.0**high
    low, high = low * (1 - 1e-12), high * (1 + 1e-12)
    for _ in range(80):
        middle = (low + high) / 2
        if below(Fraction(middle), stiffness, lengths) > number:
            high = middle
        else:
            low = middle
    return high


def draw(random_numbers, decades):
    n = random_numbers.randint(2, 4)
    lengths = [float(f"{random_numbers.uniform(0.3, 2):.3g}") for _ in range(n)]
    springs = [float(f"{10 ** -random_numbers.uniform(0, decades):.4g}") for _ in range(n)]
    exact = [Fraction(k) for k in springs], [Fraction(length) for length in lengths]
    loads = [root(i, *exact) for i in range(n)]
    reached = random_numbers.randrange(n)
    return dict(lengths=lengths, springs=springs, exact=exact, loads=loads, high=1.3 * loads[reached],
                low=-0.1 * loads[reached], depth=random_numbers.randint(0, 1), askew=10 ** random_numbers.uniform(-9, -1))


def case_of(column, askew):
    hinges = "".join(HINGE.format(i=i + 1, k=k, length=length)
                     for i, (k, length) in enumerate(zip(column["springs"], column["lengths"])))
    knees = ", ".join(f"a.q{i + 1} = [-2, 2]" for i in range(len(column["springs"])))
    return CASE.format(height=sum(column["lengths"]), hinges=hinges, knees=knees, low=column["low"], high=column["high"],
                       askew=column["askew"] if askew else 0, depth=0 if askew else column["depth"])


def judge(column, folder, askew):
    """What is wrong, in words; nothing if all is right."""
    events = [e for e in csv.DictReader(open(folder / "events.csv")) if e["branch"] == "1"]
    rows = list(csv.DictReader(open(next((folder / "branches").glob("press-1.csv")))))
    if askew:
        if any(row["index"] != "0" for row in rows):
            return "an unstable row"
        found = [e["code"] for e in events if e["code"] not in NOT_JUDGED]
        return f"events {found}" if found else None
    expected = [load for load in column["loads"] if load < column["high"]]
    found = sorted(float(e["lambda"]) for e in events if e["code"] == "BP")
    other = [e["code"] for e in events if e["code"] not in (*NOT_JUDGED, "BP")]
    if other:
        return f"events {other}"
    if not any(e["code"] == "UR" for e in events) and len(found) != len(expected):
        return f"{len(found)} of {len(expected)} critical loads"
    for load in found:
        if min(abs(load / other - 1) for other in expected) > WITHIN:
            return f"a branch point at {load}"
    for row in rows:
        load = float(row["lambda"])
        if any(abs(load / other - 1) < WITHIN for other in column["loads"]) or row["index"] == "":
            continue
        if int(row["index"]) != below(Fraction(load), *column["exact"]):
            return f"index {row['index']} at lambda = {load}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("count", nargs="?", type=int, default=100)
    parser.add_argument("seed", nargs="?", type=int, default=1)
    parser.add_argument("--decades", type=float, default=12)
    parser.add_argument("--askew", action="store_true")
    parser.add_argument("--keep", help="cases and results stay there")
    options = parser.parse_args()
    base = pathlib.Path(options.keep or tempfile.mkdtemp())
    base.mkdir(parents=True, exist_ok=True)
    random_numbers = random.Random(options.seed)
    right = unresolved = wrong = 0
    for number in range(options.count):
        column = draw(random_numbers, options.decades)
        case, folder = base / f"{number}.toml", base / str(number)
        case.write_text(case_of(column, options.askew))
        done = subprocess.run([options.program, "run", str(case), "--out", str(folder), "--no-plots"],
                              capture_output=True, text=True)
        trouble = judge(column, folder, options.askew) if done.returncode in (0, 5) else "no result"
        if trouble:
            wrong += 1
            print(f"draw {number}: exit code {done.returncode}: {trouble}")
        elif done.returncode == 5:
            unresolved += 1
            print(f"draw {number}: unresolved")
        else:
            right += 1
    print(f"{right} right, {unresolved} unresolved, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

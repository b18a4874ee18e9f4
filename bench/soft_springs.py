#!/usr/bin/env python3
"""The planar Orthoglide with springs in its passive joints from 0 to 1e3 K L^2: every special point against its closed form.

    bench/soft_springs.py PROGRAM [--folder DIR]

Two legs of length L = 1 on drives of stiffness K = 1 hold the point (x, y); sin a = y, sin b = x are the angles of the
knees with springs Kv. With the commands rho that balance the springs at the start,

    F_x = e1 + (Kv b - e2 sin b) / cos b,    e1 = x - rho + cos a,    e2 = y - rho + cos b,

and F_y with x, y and a, b and e1, e2 exchanged. On the diagonal the force along it is sqrt(2) F_x. Its limit points are
the zeros of k_along = dF_x/dx + dF_x/dy, its branch points those of k_across = dF_x/dx - dF_x/dy. They are looked for here
by signs on a fine grid and bisection, and compared with what the program finds under load, mixed and pose control.
"""
import argparse, csv, math, pathlib, subprocess, sys, tempfile

P = 0.454
STIFFNESSES = [0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.05, 0.1, 1, 1e3]
KNEE = math.radians(80)

CASE = """title = "soft springs"
[parameters]
Kv = {kv!r}
[[body]]
name = "tool"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "leg_x"
elements = [
  {{ joint = "prismatic", axis = "x", name = "drive", role = "actuated", value = 1, stiffness = 1 }},
  {{ joint = "revolute", axis = "-z", name = "knee", role = "preloaded", spring = {{ law = "linear", stiffness = "Kv" }} }},
  {{ rigid = [-1, 0] }},
]
[[chain]]
name = "leg_y"
elements = [
  {{ joint = "prismatic", axis = "y", name = "drive", role = "actuated", value = 1, stiffness = 1 }},
  {{ joint = "revolute", axis = "z", name = "knee", role = "preloaded", spring = {{ law = "linear", stiffness = "Kv" }} }},
  {{ rigid = [0, -1] }},
]
"""
STUDY = """[[study]]
name = "{place} {control}"
control = "{control}"
direction = [1, 1]
start = {{ pose = [{s}, {s}], solve = "actuators" }}
until = {{ "leg_x.knee" = ["-80*deg", "80*deg"], "leg_y.knee" = ["-80*deg", "80*deg"] }}
"""


def command(kv, s):
    """rho for which F_x(s, s) = 0: e (1 - tan a) + Kv a / cos a = 0."""
    a = math.asin(s)
    e = -kv * a / math.cos(a) / (1 - math.tan(a))
    return s + math.cos(a) - e


def force(kv, rho, s):
    a = math.asin(s)
    e = s - rho + math.cos(a)
    return math.sqrt(2) * (e + (kv * a - e * math.sin(a)) / math.cos(a))


def stiffnesses(kv, rho, s):
    """k_along and k_across on the diagonal, with x = y = s, a = b."""
    a = math.asin(s)
    c, t = math.cos(a), math.tan(a)
    e = s - rho + c
    n = kv * a - e * math.sin(a)                # F_x = e1 + n / cos b
    n_b = kv + math.sin(a) ** 2 - e * c         # dn/db: e2 = y - rho + cos b
    by_x = 1 + (n_b / c + n * math.sin(a) / c**2) / c
    by_y = -t - t                               # e1 through a, e2 through y
    return by_x + by_y, by_x - by_y


def zeros(f, low, high, cells=200000):
    found, before = [], (low, f(low))
    for i in range(1, cells + 1):
        here = low + (high - low) * i / cells
        value = f(here)
        if (value > 0) != (before[1] > 0):
            a, b = before[0], here
            for _ in range(200):
                m = 0.5 * (a + b)
                if m in (a, b):
                    break
                a, b = (m, b) if (f(m) > 0) == (before[1] > 0) else (a, m)
            found.append(0.5 * (a + b))
        before = (here, value)
    return found


def number(text):
    return float(text) if text else math.nan


def check(kv, place, s, control, folder):
    """@returns found and missed points, false ones, largest errors of place and force, rows, stop"""
    rho = command(kv, s)
    end = math.sin(KNEE)
    along = zeros(lambda p: stiffnesses(kv, rho, p)[0], -end, end, CELLS)
    across = zeros(lambda p: stiffnesses(kv, rho, p)[1], -end, end, CELLS)
    truth = [("LP", p) for p in along] + [("SC" if control == "pose" else "BP", p) for p in across]
    stem = f"{place}_{control}"
    rows = list(csv.DictReader(open(next((folder / "branches").glob(stem + "-1.csv")))))
    events = [e for e in csv.DictReader(open(folder / "events.csv")) if e["study"] == f"{place} {control}"]
    found = [(e["code"], number(e["tool.x"]), number(e["force"])) for e in events if e["code"] not in ("ST", "EN")]
    unit = max(1.0, kv)
    worst_place = worst_force = 0.0
    missed = 0
    for code, p in truth:
        near = [f for f in found if f[0] == code and abs(f[1] - p) < 1e-6]
        if not near:
            missed += 1
            continue
        worst_place = max(worst_place, abs(near[0][1] - p))
        worst_force = max(worst_force, abs(near[0][2] - force(kv, rho, p)) / unit)
    false = sum(1 for f in found if f[0] in ("LP", "BP", "SC", "UR", "TP") and not any(abs(f[1] - p) < 1e-6 for _, p in truth))
    # The count of unstable modes under dead load, row by row.
    wrong = 0
    for row in rows:
        p = number(row["tool.x"])
        if not row["index_force"] or any(abs(p - q) < 1e-7 for _, q in truth):
            continue
        k = stiffnesses(kv, rho, p)
        wrong += int(row["index_force"]) != (k[0] < 0) + (k[1] < 0)
    reached = [number(rows[0]["leg_x.knee"]), number(rows[-1]["leg_x.knee"])]
    whole = abs(min(reached) + KNEE) < 1e-9 and abs(max(reached) - KNEE) < 1e-9
    return dict(truth=len(truth), missed=missed, false=false, wrong=wrong, place=worst_place, force=worst_force,
                rows=len(rows), whole=whole)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--folder", help="keep the cases and results there")
    parser.add_argument("--stiffness", type=float, action="append", help="only these")
    parser.add_argument("--cells", type=int, default=4000, help="of the grid on which signs are looked for")
    options = parser.parse_args()
    global CELLS
    CELLS = options.cells
    base = pathlib.Path(options.folder or tempfile.mkdtemp())
    base.mkdir(parents=True, exist_ok=True)
    bad = 0
    print(f"{'Kv':>8} {'start':5} {'control':8} {'points':>6} {'missed':>6} {'false':>5} {'index':>5} "
          f"{'place':>8} {'force':>8} {'rows':>5}")
    for kv in options.stiffness or STIFFNESSES:
        case = base / f"kv{kv:g}.toml"
        runs = [(n, s, c) for n, s in (("Q0", 0.0), ("Q1", -P), ("Q2", P)) for c in ("load", "mixed", "pose")]
        case.write_text(CASE.format(kv=kv) + "".join(STUDY.format(place=n, s=s, control=c) for n, s, c in runs))
        folder = base / f"kv{kv:g}"
        done = subprocess.run([options.program, "run", str(case), "--out", str(folder), "--no-plots"],
                              capture_output=True, text=True)
        for name, s, control in runs:
            try:
                r = check(kv, name, s, control, folder)
            except (StopIteration, FileNotFoundError, KeyError) as error:
                print(f"{kv:8g} {name:5} {control:8} failed: {error!r} (exit code {done.returncode})")
                bad += 1
                continue
            right = (r["missed"] == r["false"] == r["wrong"] == 0 and r["place"] <= 1e-9 and r["force"] <= 1e-9
                     and r["rows"] <= 400 and r["whole"])
            bad += not right
            print(f"{kv:8g} {name:5} {control:8} {r['truth']:6} {r['missed']:6} {r['false']:5} {r['wrong']:5} "
                  f"{r['place']:8.1e} {r['force']:8.1e} {r['rows']:5}" + ("" if right else "   <--")
                  + ("" if r["whole"] else " not whole"))
    print("all right" if bad == 0 else f"{bad} curves are not right")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())

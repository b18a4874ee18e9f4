#!/usr/bin/env python3
"""What callgrind counted, per accepted point: profile.py FILE POINTS. Called by scripts/profile-point.sh.

Inclusive shares of named parts of the program, and calls per point of what is called most.
"""

import re
import sys
from collections import Counter

PARTS = (  # in words, function, depth in the table
    ("tracing and rows", "analysis::run_study(", 0),
    ("steps of the engine", "continuation::trace_in_own_units(", 1),
    ("step: predict, correct, tangent, count", "continuation::try_step(", 2),
    ("examination of the step", "continuation::examine(", 2),
    ("special points and events", "::passage_events(", 2),
    ("rows of named quantities", "analysis::Evaluator::values(", 1),
    ("result files", "io::write_results(", 0),
)
WORK = (
    ("equations and matrices of the path", "analysis::PathProblem::equations("),
    ("equations alone", "analysis::PathProblem::residual("),
    ("matrices of the statics", "statics::equilibrium_matrix("),
    ("residuals of the statics", "statics::equilibrium_residual("),
    ("closures of chains", "model::evaluate_closure<double>("),
    ("factorisations", "SmallSymmetric::factorise("),
    ("of what they leave over", "SmallLu::factorise("),
    ("eigenvalues", "symmetric_eigenvalues<"),
    ("malloc", "malloc"),
    ("calloc", "calloc"),
    ("free", "free"),
    ("digits of numbers", "std::to_chars("),
)


def read(path):
    """Instructions with and without callees, and calls, of every function."""
    names, calls, inclusive, own = {}, Counter(), Counter(), Counter()

    def name_of(text):
        number, name = re.match(r"\((\d+)\)(?: (.*))?", text).groups()
        if name:
            names[number] = name
        return names[number]

    function = callee = None
    in_call = False
    with open(path) as file:
        for line in file:
            if line.startswith("fn="):
                function = name_of(line[3:])
            elif line.startswith("cfn="):
                callee = name_of(line[4:])
            elif line.startswith("calls="):
                calls[callee] += int(line[6:].split()[0])
                in_call = True
            elif line[:1] in "+-*" or line[:1].isdigit():
                words = line.split()
                cost = int(words[-1]) if len(words) > 1 else 0
                if in_call and callee != function:
                    inclusive[callee] += cost
                elif not in_call:
                    own[function] += cost
                in_call = False
    for function, cost in own.items():
        inclusive[function] += cost
    return calls, inclusive, sum(own.values())


def matching(names, wanted):
    exact = wanted.isalpha()
    return [n for n in names if (n == wanted if exact else wanted in n and "{lambda" not in n)]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    calls, inclusive, total = read(sys.argv[1])
    points = int(sys.argv[2])
    print(f"{total / points:.0f} instructions per accepted point, {points} points\n")
    print("share    part")
    for words, function, depth in PARTS:
        cost = sum(inclusive[n] for n in matching(inclusive, function))
        print(f"{100 * cost / total:5.1f} %  {'  ' * depth}{words}")
    print("\nshare    calls per point   work, across these parts")
    for words, function in WORK:
        found = matching(inclusive, function)
        cost, count = sum(inclusive[n] for n in found), sum(calls[n] for n in found)
        print(f"{100 * cost / total:5.1f} % {count / points:9.2f}          {words}")


if __name__ == "__main__":
    main()

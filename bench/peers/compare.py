#!/usr/bin/env python3
"""springfold beside AUTO-07p: the same curves in alternation, medians, ratios, and whether they hold.

Called by scripts/bench-peers.sh, which builds the programs. Exit code 0: every ratio holds and both
find the same special points; 1: something does not hold (the last table says what); 2: wrong usage.
"""

import argparse
import sys

from columns import compare_columns
from comparison import Comparison
from folds import compare_folds
from orthoglide import compare_orthoglides, compare_with_floor


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
    compare_orthoglides(comparison)
    compare_with_floor(comparison)
    compare_columns(comparison)
    compare_folds(comparison)
    sys.exit(0 if comparison.verdicts.report() else 1)


if __name__ == "__main__":
    main()

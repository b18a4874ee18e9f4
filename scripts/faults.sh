#!/bin/bash
# Faults put into the program: scripts/faults.sh [--quick] [calls|signals|allocations ...]
# The k-th system call fails, the k-th allocation fails (alone, or all behind it too), a signal comes at the k-th system
# call: for a diagram, a map, a search and a control study (bench/faults), for all k behind the loader, or for some of
# them where there are too many or with --quick. Every run is done again without a fault in the same folder. Exit code 1
# if an exit code is not documented, a manifest is not true, or the next run leaves anything behind: build/faults/findings.txt.
# Needs strace and python3 (scripts/packages-ci.txt).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

bounds=() kinds=()
while (($#)); do
  case $1 in
    --quick) bounds=(--most 4 --allocations 40) ;;
    calls | signals | allocations) kinds+=("$1") ;;
    *)
      echo "usage: scripts/faults.sh [--quick] [calls|signals|allocations ...]" >&2
      exit 2
      ;;
  esac
  shift
done
((${#kinds[@]})) || kinds=(calls signals allocations)

configure_release
cmake --build --preset release --target springfold_program
work=build/faults
mkdir -p "$work"
cc -O2 -shared -fPIC -o "$work/failing_allocation.so" bench/faults/failing_allocation.c
nice -n 10 python3 bench/faults/faults.py --program "$PWD/build/release/springfold" \
  --shim "$PWD/$work/failing_allocation.so" --work "$work" --kinds "${kinds[@]}" "${bounds[@]}" -- bench/faults/*.toml

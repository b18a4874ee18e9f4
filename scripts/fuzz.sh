#!/bin/bash
# Fuzzing of the whole program with sanitizers: scripts/fuzz.sh [--seconds N] [--seed S] [check|run|uncapped ...]
# Mutants of all case files of cases/ and docs/examples/ are given to `check` (100,000 of them), to `run` with a stop after
# 0.2 s (100,000) and to `run` without one (2,000). Builds what it needs with clang (preset sanitize) and goes on where
# the last call ended; with --seconds it stops after so many, shared among the kinds. Exit code 1 if anything was
# found: findings and how far it has come lie in build/fuzz. Takes hours if it is not told to stop.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

seconds=1000000000 seed=1 kinds=()
while (($#)); do
  case $1 in
    --seconds) seconds=${2:?--seconds needs a number} && shift ;;
    --seed) seed=${2:?--seed needs a number} && shift ;;
    check | run | uncapped) kinds+=("$1") ;;
    *)
      echo "usage: scripts/fuzz.sh [--seconds N] [--seed S] [check|run|uncapped ...]" >&2
      exit 2
      ;;
  esac
  shift
done
((${#kinds[@]})) || kinds=(check run uncapped)
declare -A count=([check]=100000 [run]=100000 [uncapped]=2000)

cmake --preset sanitize --log-level=NOTICE >/dev/null
cmake --build --preset sanitize --target springfold_fuzz

work=build/fuzz
mkdir -p "$work"
rm -rf "$work/corpus"
mkdir "$work/corpus"
cp -r cases docs/examples "$work/corpus/"

export ASAN_OPTIONS=abort_on_error=1:detect_leaks=0:allocator_may_return_null=0:max_allocation_size_mb=4000:$sanitizer_options
code=0
for kind in "${kinds[@]}"; do
  nice -n 10 build/sanitize/springfold_fuzz "$kind" --corpus "$work/corpus" --work "$work" --seed "$seed" \
    --count "${count[$kind]}" --seconds $((seconds / ${#kinds[@]})) --jobs "$(nproc)" || code=1
done
if ((code)); then
  echo "found: see $work/findings; build/sanitize/springfold_fuzz KIND --corpus $work/corpus --work $work --seed $seed --only N repeats one" >&2
fi
exit $code

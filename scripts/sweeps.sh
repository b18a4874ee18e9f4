#!/bin/bash
# A sweep of many Orthoglide curves gives the same bytes whichever way it is computed: scripts/sweeps.sh [RUNS]. All cores
# of one process; four processes of mpirun; killed half-way and resumed, by one process and by four. RUNS: 10,000 by
# default. Without mpirun, or without MPI in the build, the ways with several processes are left out and it says so.
# Exit code 1 if any two differ.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

runs=${1:-10000}
configure_release
cmake --build --preset release --target springfold_program >/dev/null
program=$PWD/build/release/springfold
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cp cases/orthoglide-planar/mechanism.toml "$work"
cat >"$work/case.toml" <<CASE
title = "Planar Orthoglide: tolerances"
include = "mechanism.toml"

[[study]]
name = "tolerances"
control = "load"
direction = [1, 1]
start = { pose = ["p", "p"], solve = "actuators" }
until = { leg_x.knee = ["-80*deg", "80*deg"] }
[study.vary]
sample = { Kv = [0.008, 0.012], p = [0.45, 0.458], L = [0.99, 1.01], K = [0.9, 1.1] }
points = $runs
table = [{ name = "F_cr", at = "LP1", quantity = "lambda" }, { quantity = "count.LP" }]
curves = false
CASE
cd "$work"

# Several processes on one machine, also for root in a container.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_mpi_yield_when_idle=1
several=()
grep -qs "^MPI_CXX_LIBRARIES\|^MPI_CXX_LIB_NAMES" "$OLDPWD/build/release/CMakeCache.txt" &&
  mpirun -n 2 true >/dev/null 2>&1 && several=(mpirun -n 4)

resume=()
compute() { # FOLDER WORD...
  local folder=$1
  shift
  "$@" run case.toml --no-plots --out "$folder" "${resume[@]}" >"$folder.txt" 2>"$folder.err"
}

timed() { # TEXT FOLDER WORD...
  local text=$1 began=$EPOCHREALTIME
  shift
  compute "$@"
  printf '%-46s %8.1f s\n' "$text" "$(awk -v a="$began" -v b="$EPOCHREALTIME" "BEGIN { print b - a }")"
}

# kill_half_way FOLDER WORD...: once half of the runs are in the checkpoint.
kill_half_way() {
  local folder=$1 rows=0
  compute "$@" &
  local job=$!
  while ((rows < runs / 2)) && kill -0 $job 2>/dev/null; do
    sleep 0.05
    rows=$(wc -l 2>/dev/null <"$folder/.checkpoint-tolerances-rows" || echo 0)
  done
  # The processes of mpirun are its children; without it the program is the only one.
  local program_id children
  program_id=$(cat "/proc/$job/task/$job/children")
  children=$(cat "/proc/${program_id%% *}/task/${program_id%% *}/children" 2>/dev/null || true)
  # shellcheck disable=SC2086  # several numbers
  kill -KILL ${children:-$program_id} 2>/dev/null || true
  wait $job 2>/dev/null || true
  echo "killed with $rows lines in the checkpoint"
}

code=0
same() { # TEXT FOLDER
  if diff -rq --exclude=timings.json whole "$2" >/dev/null; then
    echo "  the same bytes: $1"
  else
    echo "  DIFFERENT: $1"
    code=1
  fi
}

timed "$runs curves, one process, $(nproc) threads" whole "$program"
kill_half_way part "$program"
resume=(--resume)
timed "resumed" part "$program"
resume=()
same "killed half-way and resumed" part
if ((${#several[@]})); then
  timed "$runs curves, four processes" four "${several[@]}" "$program"
  same "four processes" four
  kill_half_way parts "${several[@]}" "$program"
  resume=(--resume)
  timed "resumed, four processes" parts "${several[@]}" "$program"
  same "four processes killed half-way and resumed" parts
else
  echo "no MPI in this build, or no mpirun that starts processes: several processes are not tried"
fi
exit $code

#!/bin/bash
# What an accepted point costs, and where: scripts/profile-point.sh [points]. Runs `springfold run` on
# the planar Orthoglide of docs/performance.md under callgrind (Debian package valgrind) and prints
# instructions, shares and calls per point. 10,000 points, about half a minute, if nothing is said.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
if ! command -v valgrind >/dev/null || ! command -v python3 >/dev/null; then
  echo "profile-point.sh: needs valgrind and python3: apt-get install valgrind python3" >&2
  exit 2
fi

configure_release
cmake --build --preset release --target springfold

points=${1:-10000}
folder=build/release/profile
rm -rf "$folder"
mkdir -p "$folder"
cat >"$folder/case.toml" <<END
include = "$PWD/cases/orthoglide-planar/mechanism.toml"
[parameters]
Kv = 0.01
[[study]]
name = "push"
control = "load"
direction = [1, 1]
start = { pose = ["p", "p"], solve = "actuators" }
until = { lambda = [0, 0.1] }
trace = { initial_step = "9.948843878/$points", maximum_step = "9.948843878/$points", maximum_points = 1000000 }
END
valgrind --tool=callgrind --callgrind-out-file="$folder/callgrind.out" build/release/springfold run \
  "$folder/case.toml" --no-plots --out "$folder/results" >"$folder/log" 2>&1 || {
  cat "$folder/log" >&2
  exit 1
}
python3 bench/profile.py "$folder/callgrind.out" "$(($(wc -l <"$folder"/results/branches/*.csv) - 1))"

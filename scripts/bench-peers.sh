#!/bin/bash
# springfold beside AUTO-07p: scripts/bench-peers.sh [--quick]. Installs AUTO-07p and gfortran if they
# are missing (Debian packages, root or sudo), compiles our equation files, runs both programs on the
# same curves in alternation and prints medians, ratios and which of the wanted ones hold. Exit code 0
# only if all hold. A few minutes; --quick one or two, with fewer repetitions and columns. docs/performance.md says what is measured.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

case "$*" in
  "" | --quick) ;;
  *)
    echo "usage: scripts/bench-peers.sh [--quick]" >&2
    exit 2
    ;;
esac

missing=()
for package in auto-07p gfortran gcc python3; do
  dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -q '^installed$' ||
    missing+=("$package")
done
if ((${#missing[@]})); then
  as_root=(env)
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "bench-peers.sh: only root can install: apt-get install ${missing[*]}" >&2
      exit 2
    fi
    as_root=(sudo env)
  fi
  echo "bench-peers.sh: installing ${missing[*]}"
  apt=("${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300)
  "${apt[@]}" update
  "${apt[@]}" install --yes --no-install-recommends "${missing[@]}" >/dev/null
fi

configure_release
targets=(springfold springfold_trace)
cmake --build --preset release --target help | grep -q '^springfold_bench:' && targets+=(springfold_bench)
cmake --build --preset release --target "${targets[@]}"

# One program per equation file and setting, as AUTO's own scripts link them, but once and for all.
library=/usr/lib/auto-07p/lib
auto=$PWD/build/release/bench-peers/auto
rm -rf "$auto"
mkdir -p "$auto"
gcc -O2 -c bench/peers/replace_lines.c -o "$auto/replace_lines.o"
for source in orthoglide column no_line short_line; do
  gfortran -O2 -c "bench/peers/$source.f90" -o "$auto/$source.o"
done
for problem in orthoglide column; do
  gfortran -fopenmp "$auto/$problem.o" "$library"/*.o -o "$auto/$problem"
  for lines in no_line short_line; do
    gfortran -fopenmp "$auto/$problem.o" "$auto/replace_lines.o" "$auto/$lines.o" \
      -Wl,--wrap=__io_MOD_wrline "$library"/*.o -o "$auto/$problem-$lines"
  done
done

echo "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(nproc) processors;" \
  "AUTO-07p $(dpkg-query -W -f='${Version}' auto-07p);" \
  "gfortran $(gfortran -dumpfullversion), g++ $(g++ -dumpfullversion)"
echo
exec python3 -B bench/peers/compare.py --auto "$auto" --cases cases \
  --tracer build/release/bench/springfold_trace --springfold build/release/springfold \
  --kernels build/release/bench/springfold_bench --work build/release/bench-peers/runs "$@"

#!/bin/bash
# Builds everything with Clang and the address and undefined-behaviour sanitizers, then runs the tests:
#     scripts/sanitize.sh [--quick] [--third N] [--build | --test]
# --quick leaves to the release build what repeats the same lines for long (tests/long_with_sanitizers.txt); --third runs a
# third of the tests, that of the number N, whatever its size. Both are CI's way, which takes N from the commit. All tests
# take half an hour on two processors. With Clang, so that the second compiler is heard too.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

quick=no build=no test=no third=""
while (($#)); do
  case $1 in
    --quick) quick=yes ;;
    --build) build=yes ;;
    --test) test=yes ;;
    --third) third=${2:?--third needs a number} && shift ;;
    *) echo "sanitize.sh: unknown option $1" >&2; exit 2 ;;
  esac
  shift
done

if [[ $build$test == nono ]]; then
  build=yes test=yes
fi

build() {
  cmake --preset sanitize --log-level=NOTICE -DSPRINGFOLD_WARNINGS_AS_ERRORS=ON >/dev/null
  cmake --build --preset sanitize
}

# A list that names no test any more would hide that the test was renamed.
must_exist() {
  local name
  for name in ${1//:/ }; do
    grep -rqE "^TEST(_F|_P)?\\(${name%%.*}, ${name##*.}\\)" tests --include='*.cpp' || {
      echo "sanitize.sh: tests/long_with_sanitizers.txt: no test is called $name" >&2
      exit 1
    }
  done
}

# Many tests in one process, some processes beside each other: with sanitizers every process takes some seconds for its
# start and its search for leaks. A process that hangs ends after an hour. No debug information, which costs a fifth of
# the build: reports name functions. Lines: cmake --preset sanitize -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1". Undefined behaviour
# is told as an illegal instruction (ILL); preset debug says which.
run_tests() {
  local shards=3 left_out="" first=0 last=2
  if [[ -n $third ]]; then
    first=$((third % shards)) last=$first
    echo "part $((first + 1)) of $shards of the tests"
  fi
  if [[ $quick == yes ]]; then
    left_out=$(grep -v -e '^#' -e '^$' tests/long_with_sanitizers.txt | paste -sd:)
    must_exist "$left_out"
  fi
  local -x GTEST_FILTER="-$left_out"
  local -x ASAN_OPTIONS="${ASAN_OPTIONS:-$sanitizer_options}"
  export LSAN_OPTIONS="suppressions=$PWD/tests/leaks_of_libraries.txt:print_suppressions=0"
  find build/sanitize/tests -maxdepth 1 -name 'springfold_*_tests' | sort |
    while read -r program; do
      for ((shard = first; shard <= last; ++shard)); do printf '%s %s\n' "$program" "$shard"; done
    done | xargs -P "$(nproc)" -L 1 bash -c \
    'GTEST_TOTAL_SHARDS=$0 GTEST_SHARD_INDEX=$2 timeout 3600 "$1" --gtest_brief=1 || { echo "FAILED: $1, shard $2"; exit 1; }' "$shards"
}

[[ $build == no ]] || build
[[ $test == no ]] || run_tests

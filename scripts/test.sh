#!/bin/bash
# From a bare Debian 12 to all tests: installs what is missing, builds, runs every test, every case of the library
# against its published and closed-form values, and the engine against problems with known answers. The last line
# says what passed; anything that does not ends the script there, with an exit code that is not zero.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

scripts/setup.sh
configure_release
cmake --build --preset release
log=build/release/test-logs
mkdir -p "$log"

ctest --preset release --parallel "$(nproc)" --no-label-summary | tee "$log/tests.txt"
scripts/verify-cases.sh | tee "$log/cases.txt"
# scripts/known-answers.sh runs more of them.
draws=1000
build/release/bench/known_answers "$draws" 1 --named bench/known_answers/draws.txt --check | tee "$log/known-answers.txt"
build/release/bench/guyed --named bench/guyed/draws.txt --threads "$(nproc)" --check | tee "$log/guyed.txt"

tests=$(sed -n 's/^100% tests passed, 0 tests failed out of \([0-9]*\)$/\1/p' "$log/tests.txt")
cases=$(sed -n 's/^\([0-9]*\) of \1 cases hold, .*/\1/p' "$log/cases.txt")
: "${tests:?the number of tests is not in $log/tests.txt}" "${cases:?the number of cases is not in $log/cases.txt}"
echo
echo "ALL PASSED: $(with_commas "$tests") tests, $(with_commas "$cases") cases, $(with_commas "$draws") known answers"

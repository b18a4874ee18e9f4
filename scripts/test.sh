#!/usr/bin/env bash
# From a bare Debian 12 to all tests: installs what is missing, builds with warnings as errors, runs
# every test and every case of the library.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh
cmake --preset release --log-level=NOTICE -DSPRINGFOLD_WARNINGS_AS_ERRORS=ON
cmake --build --preset release
ctest --preset release --parallel "$(nproc)" --no-label-summary

# All cases against their published and closed-form values.
scripts/verify-cases.sh

# The engine against problems with known answers; scripts/known-answers.sh runs more of them.
build/release/bench/known_answers 1000 1 --check

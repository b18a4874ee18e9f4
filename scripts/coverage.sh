#!/bin/bash
# Which lines of the library the tests reach: scripts/coverage.sh. A table, and build/coverage/html for reading.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
if ! command -v gcovr >/dev/null; then
  echo "coverage.sh: needs gcovr: scripts/setup.sh --ci" >&2
  exit 2
fi

cmake --preset coverage --log-level=NOTICE >/dev/null
cmake --build --preset coverage
find build/coverage -name '*.gcda' -delete
ctest --preset coverage --parallel "$(nproc)" --no-label-summary -LE package
mkdir -p build/coverage/html
gcovr --root . --filter src/ --filter include/ --exclude-throw-branches --exclude-unreachable-branches \
  --html-details build/coverage/html/index.html --print-summary build/coverage

#!/bin/bash
# Fails if clang-format would change a C++ file. To mend: scripts/check-format.sh -i
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

mode=(--dry-run -Werror)
if [[ ${1:-} == -i ]]; then
  mode=(-i)
fi
find include src tests bench \( -name '*.hpp' -o -name '*.cpp' \) -print0 |
  xargs -0 clang-format "${mode[@]}"
echo "format: all C++ files are as .clang-format wants them"

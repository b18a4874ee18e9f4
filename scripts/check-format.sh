#!/bin/bash
# Fails if clang-format would change a C++ file, or a line of a comment is longer than 120 characters. To mend:
# scripts/check-format.sh -i
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

mode=(--dry-run -Werror)
comments=(--check)
if [[ ${1:-} == -i ]]; then
  mode=(-i)
  comments=()
fi
find include src tests bench \( -name '*.hpp' -o -name '*.cpp' \) -print0 |
  xargs -0 clang-format "${mode[@]}"
python3 scripts/wrap-comments.py "${comments[@]}"
echo "format: all C++ files are as .clang-format wants them"

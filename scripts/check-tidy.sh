#!/bin/bash
# clang-tidy with .clang-tidy over all sources, or those named: scripts/check-tidy.sh [file.cpp ...]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

cmake --preset sanitize --log-level=NOTICE -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
files=("$@")
((${#files[@]})) || mapfile -t files < <(find src -name '*.cpp' | sort)
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy --quiet -p build/sanitize
echo "clang-tidy: nothing to say about ${#files[@]} files"

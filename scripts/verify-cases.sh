#!/bin/bash
# All cases of cases/ against their expected values: scripts/verify-cases.sh [--csv | --json] [--jobs N].
# One table: case, quantity, ours, reference, difference, tolerance, source. Exit code 0 only if all hold.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if [ ! -x build/release/springfold ]; then
  configure_release
  cmake --build --preset release --target springfold_program >&2
fi
build/release/springfold verify cases "$@"

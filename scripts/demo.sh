#!/bin/bash
# From a bare Debian 12 to the force-deflection curves of the planar Orthoglide: installs what is
# missing, builds the program, runs the case.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

scripts/setup.sh
configure_release
cmake --build --preset release --target springfold_program

case=cases/orthoglide-planar/case.toml
out=results/orthoglide-planar
build/release/springfold run "$case" --out "$out"

echo
echo "Case file:        $PWD/$case"
echo "Curves (.csv):    $PWD/$out"
find "$out" -name '*.png' -o -name '*.svg' | sort | sed "s|^|Figure:           $PWD/|"

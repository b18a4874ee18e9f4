#!/bin/sh
# The HTML page of run --report: types of its script, then pages in a headless Chromium, driven like by a hand.
# Needs node, tsc and chromium (scripts/packages-ci.txt).
#   scripts/browser-test.sh [PROGRAM] [FOLDER FOR SCREENSHOTS] [--renew: keep them as what later runs are compared with]
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
program=${1:-$here/build/release/springfold}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
tsc --project "$here/report"
page() {  # NAME CASE
  "$program" run "$2" --no-plots --report --out "$folder/$1" > "$folder/tables" 2> "$folder/messages" ||
    { cat "$folder/messages"; exit 1; }
}
toggle=$here/cases/snap-through/case-toggle.toml
# With a title that would be a script if it were not escaped.
sed '/^expected/d; s|^title = .*|title = "</title><script>window.injected = 1</script>"|' "$toggle" > "$folder/toggle.toml"
# With so many rows that 100,000 are exceeded.
sed '/^expected/d; s/^kind = "snap_through"$/trace = { spacing = 2.5e-5 }/; /^\[\[picture/,$d' "$toggle" > "$folder/long.toml"
page toggle "$folder/toggle.toml"
page long "$folder/long.toml"
page figure "$here/cases/orthoglide-planar/case-figure-5.toml"
page platform "$here/cases/rpr-platform/case.toml"
page dome "$here/cases/n-bar-dome/case.toml"
page truss "$here/tests/browser/steep-truss.toml"
page follower "$here/cases/ziegler-column/case.toml"
timeout -s KILL 150 node "$here/tests/browser/page_test.mjs" chromium "$folder" ${2:+"$2"} ${3:+"$3"}

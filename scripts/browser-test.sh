#!/bin/sh
# The HTML page of run --report: types of its script, then the page in a headless Chromium, driven like by a hand.
# Needs node, tsc and chromium (scripts/packages-ci.txt).  scripts/browser-test.sh [PROGRAM] [SCREENSHOT.png]
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
program=${1:-$here/build/release/springfold}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
tsc --project "$here/report"
# With a title that would be a script if it were not escaped.
sed '/^expected/d; s|^title = .*|title = "</title><script>window.injected = 1</script>"|' \
  "$here/cases/snap-through/case-toggle.toml" > "$folder/case.toml"
"$program" run "$folder/case.toml" --no-plots --report --out "$folder/results" > "$folder/tables" 2> "$folder/messages" ||
  { cat "$folder/messages"; exit 1; }
timeout -s KILL 90 node "$here/tests/browser/page_test.mjs" chromium "$folder/results" ${2:-}

#!/bin/bash
# Draws every case of the library with `springfold draw` and puts the pictures on one sheet,
# docs/images/gallery.png, as docs/gallery.md shows it. Needs the built program and rsvg-convert.
# Usage: scripts/gallery.sh [SHEET.png]
set -euo pipefail
sheet=$(realpath -m "${1:-$(dirname "${BASH_SOURCE[0]}")/../docs/images/gallery.png}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export LC_ALL=C  # the same order everywhere
program=build/release/springfold
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Postures that say more than the first equilibrium does.
posture_of() {
  case "$1" in
    bar-roller-spring) echo straight/UZ1 ;;
    bar-spring) echo "snap back/LP2" ;;
    bar-torsion-spring) echo straight/UZ2 ;;
    bend-45) echo lift/EP2 ;;
    "bistable-chain, series") echo pull/LP1 ;;
    "cantilever-elastica, buckled-20") echo press/UZ4 ;;
    "cantilever-elastica, roll"*) echo roll/UZ2 ;;
    cantilever-elastica*) echo bend/EP2 ;;
    column-with-stop) echo press/EP4 ;;
    dual-triangle-joint) echo turn/LP1 ;;
    curved-beam) echo press/BP4 ;;
    "free-laws, contact") echo press/UZ1 ;;
    "free-laws, hysteron") echo bar/LP1 ;;
    "free-laws, series") echo pull/UZ1 ;;
    "free-laws, table") echo pull/UZ1 ;;
    "free-laws, switch") echo push/UZ1 ;;
    free-laws*) echo press/LP1 ;;
    gough-stewart) echo tilt/EP3 ;;
    gravity-balancer) echo turned/UZ2 ;;
    guyed-bar) echo straight/UZ2 ;;
    "hencky-column, clamped-2") echo press/EP4 ;;
    "hencky-column, pinned-2") echo press/EP3 ;;
    lee-frame*) echo press/LP2 ;;
    miura-unit) echo pull/EP2 ;;
    "nodes-and-bars, laws") echo cubic/LP1 ;;
    nodes-and-bars | "short-files, platform") echo press/LP1 ;;
    preload-then-push) echo push/LP1 ;;
    "short-files, column") echo press/BP1 ;;
    link-column) echo press/EP5 ;;
    "load-cycle, column") echo press/EP3 ;;
    "load-cycle, orthoglide") echo Q2/LP1 ;;
    load-cycle*) echo press/LP1 ;;
    "orthoglide-planar, one-sided") echo "Q2 one-sided/SA1" ;;
    "orthoglide-planar, soft-springs") echo load/LP1 ;;
    orthoglide-planar) echo Q2/LP1 ;;
    preloaded-rest) echo press/LP2 ;;
    quasi-zero-stiffness) echo switch/LP1 ;;
    "rigid-loops, cranks") echo through/UZ2 ;;
    "rigid-loops, sarrus") echo press/UZ3 ;;
    rigid-loops) echo press/EP3 ;;
    rpr-platform) echo swell/EP3 ;;
    "rrr-platform, flexures") echo load/LP1 ;;
    rrr-platform) echo torque/LP1 ;;
    serial-2r) echo straight/EP3 ;;
    serial-3r) echo moment/EP2 ;;
    "shape-springs, ball") echo push/UZ1 ;;
    "shape-springs, kresling") echo press/LP2 ;;
    "shape-springs, wall") echo press/UZ1 ;;
    string-toy) echo aside/LP1 ;;
    "snap-through, column") echo press/EP3 ;;
    "snap-through, masses") echo equal/LP1 ;;
    "snap-through, orthoglide") echo Q2/LP1 ;;
    "snap-through, strut") echo press/LP1 ;;
    "snap-through, switch") echo push/LP1 ;;
    "snap-through"*) echo press/LP1 ;;
    "three-link-chain, bent") echo press/EP3 ;;
    three-link-chain) echo press/UZ5 ;;
    toggle) echo press/LP2 ;;
    universal-joint-bar) echo press/EP3 ;;
    vm9-springs) echo ramp/EP2 ;;
    von-mises-truss) echo press/EP3 ;;
    "von-mises-truss, onsas") echo press/LP1 ;;
    ziegler-column) echo dead/EP3 ;;
  esac
}

columns=8 cell_width=200 cell_height=176
number=0
body=$work/body.svg
for file in cases/*/case*.toml; do
  name=${file#cases/}
  name=${name%.toml}
  name=${name%/case}
  name=${name/\/case-/, }
  posture=$(posture_of "$name")
  choice=()
  [[ -z $posture ]] || choice=(--at "$posture")
  "$program" draw "$file" "${choice[@]}" --output "$work/one.svg" 2> "$work/messages" ||
    { cat "$work/messages" >&2; echo "no picture of $file" >&2; exit 1; }
  x=$((number % columns * cell_width)) y=$((number / columns * cell_height))
  number=$((number + 1))
  # The mechanism stands in 720 x 520 pixels above the legend. Words would be too small to be read,
  # lines too thin to be seen.
  bottom=$(grep -n -m1 'font-size="11" fill="#333333"' "$work/one.svg" | cut -d: -f1)
  top=$(grep -o '<text [^>]*font-size="11" fill="#333333"' "$work/one.svg" | head -1 | sed 's/.* y="\([0-9]*\).*/\1/')
  {
    echo "<svg x=\"$x\" y=\"$y\" width=\"$cell_width\" height=\"$((cell_height - 24))\" viewBox=\"30 $((top - 540)) 660 528\">"
    sed -n "1,$((bottom - 2))p" "$work/one.svg" | sed '/^<?xml/d; /^<svg/d; /^<title/d; /^<rect/d; /^<text/d; /^<\/svg/d; s/stroke-width="\(1[.0-9]*\)"/stroke-width="2.5"/; /#a3286a/! s/stroke-width="[23][.0-9]*"/stroke-width="5"/'
    echo "</svg>"
    echo "<text x=\"$((x + cell_width / 2))\" y=\"$((y + cell_height - 10))\" font-size=\"11\" text-anchor=\"middle\">$number  $name</text>"
  } >> "$body"
done
rows=$(((number + columns - 1) / columns))
{
  echo "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"$((columns * cell_width))\" height=\"$((rows * cell_height))\" font-family=\"DejaVu Sans, sans-serif\">"
  echo '<rect width="100%" height="100%" fill="#ffffff"/>'
  cat "$body"
  echo '</svg>'
} > "$work/sheet.svg"
rsvg-convert --output "$sheet" "$work/sheet.svg"
echo "$number cases on $sheet"

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The procedural scenes in one picture: the one in docs/SCENES.md.
set -euo pipefail
export LC_ALL=C

usage() {
  cat <<'TEXT'
usage: bench/scenes_sheet.sh [OUT.png]

Makes every procedural scene, of at most a million triangles, renders it from its camera "main", and tiles the pictures, five
a row in the order of `izb scene --help`, into OUT.png (default out/scenes_sheet.png). Needs oiiotool. Takes some minutes.
TEXT
}

# shellcheck source=bench/picture.sh
source "$(dirname "${BASH_SOURCE[0]}")/picture.sh"
izb=$PWD/build/release/izb
frames=$(mktemp -d)
trap 'rm -rf "$frames"' EXIT
cd "$frames"

pictures=()
while read -r name triangles; do
  echo "scenes_sheet.sh: $name" >&2
  [ "$triangles" -gt 1000000 ] && triangles=1000000
  time=()
  case $name in  # what deforms, in motion
    tentacles) time=(--animation writhe --time 3.3) ;;
    character) time=(--animation wave --time 2.4) ;;
  esac
  "$izb" scene "$name" --triangles "$triangles" -o scene.glb >/dev/null
  "$izb" render scene.glb --camera main --size 384x216 --spp 32 "${time[@]}" -o scene.exr --preview "$name.png" >/dev/null 2>&1
  oiiotool "$name.png" --resize 192x108 -o "$name.png"
  pictures+=("$name.png")
done < <("$izb" scene --help | awk '$3 == "triangles" && $1 != "garden" { print $1, $2 }')
oiiotool "${pictures[@]}" --mosaic:pad=2 5x2 -o "$picture"

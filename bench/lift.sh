#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A curtain three times, side by side: the picture of lifted micro-quads in docs/PAPER.md.
set -euo pipefail
export LC_ALL=C

usage() {
  cat <<'TEXT'
usage: bench/lift.sh [OUT.png]

Renders the shipped scene by izb on tangent planes (the paper's) and on lifted ones, and by rays 4 times as large in each
direction with 32 each, box-filtered in linear light. Writes the same pixels of the three, magnified and side by side, to
OUT.png (default out/lift.png), and prints how many bits of the masks differ. Takes a minute.
TEXT
}

# shellcheck source=bench/picture.sh
source "$(dirname "${BASH_SOURCE[0]}")/picture.sh"
cmake --build build/release --target izb_garden izb_crops >&2
frames=$(mktemp -d)
trap 'rm -rf "$frames"' EXIT

# frame NAME SIZE OPTION...
frame() {
  local name=$1 size=$2
  shift 2
  echo "lift.sh: $name" >&2
  build/release/izb render build/release/assets/garden.glb --camera main --size "$size" "$@" -o "$frames/$name.exr" >/dev/null
}
frame tangent 960x540 --micro-quad tangent
frame lifted 960x540
frame supersampled 3840x2160 --technique ray_traced

crops=$PWD/build/release/bench/izb_crops
cd "$frames"
"$crops" tangent.exr lifted.exr supersampled.exr --crop 180,180,120,90 --magnify 3 -o "$picture"

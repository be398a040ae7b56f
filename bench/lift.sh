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

# shellcheck source=bench/garden_frames.sh
source "$(dirname "${BASH_SOURCE[0]}")/garden_frames.sh"
frame tangent 960x540 --camera main --micro-quad tangent
frame lifted 960x540 --camera main
frame supersampled 3840x2160 --camera main --technique ray_traced

cd "$frames"
"$crops" tangent.exr lifted.exr supersampled.exr --crop 180,180,120,90 --magnify 3 -o "$picture"

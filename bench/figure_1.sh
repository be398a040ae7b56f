#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The paper's figure 1 with this project's own town: 32 samples of izb beside a filtered shadow map of 8192 x 8192.
set -euo pipefail
export LC_ALL=C

usage() {
  cat <<'TEXT'
usage: bench/figure_1.sh [OUT.png [SCALE]]

Renders the procedural scene `town` (after the Citadel of the paper's figure 1) at 640 x 360 times SCALE (1, 2 or 3; default
1; 3 is the paper's 1920 x 1080) in five ways:
  1. izb, 32 samples a pixel
  2. shadow_map, 8192 x 8192 texels, a disc of 32 points
  3. the same number of texels in four cascades of 4096 x 4096
  4. rays, 32 at the same points as izb's
  5. the truth: rays for a picture larger in each direction (4 times, with SCALE 2 and 3 twice), box-filtered in linear light
Writes the same pixels of the five, magnified and side by side, to OUT.png (default out/figure_1.png), and prints by how much
shadow each differs from the rays there. Takes a minute on two cores; the map takes 268 MB.
TEXT
}

scale=${2:-1}
if [[ ! $scale =~ ^[123]$ ]]; then
  usage >&2
  exit 2
fi
most_arguments=2
# shellcheck source=bench/picture.sh
source "$(dirname "${BASH_SOURCE[0]}")/picture.sh"
cmake --build build/release --target izb_crops >&2
frames=$(mktemp -d)
trap 'rm -rf "$frames"' EXIT

izb=$PWD/build/release/izb
crops=$PWD/build/release/bench/izb_crops
cd "$frames"
"$izb" scene town -o town.glb >&2

# frame NAME LARGER OPTION...
frame() {
  local name=$1 size=$((640 * scale * $2))x$((360 * scale * $2))
  shift 2
  echo "figure_1.sh: $name, $size" >&2
  "$izb" render town.glb --camera main --size "$size" "$@" -o "$name.exr" >/dev/null
}
frame izb_32 1 --technique izb --spp 32
frame shadow_map_8192 1 --technique shadow_map --resolution 8192 --filter disc32
frame shadow_map_4_x_4096 1 --technique shadow_map --resolution 4096 --cascades 4 --filter disc32
frame ray_traced_32 1 --technique ray_traced --spp 32
frame supersampled $((scale > 1 ? 2 : 4)) --technique ray_traced --spp 32

part=$((280 * scale)),$((120 * scale)),$((140 * scale)),$((95 * scale))
for name in izb_32 shadow_map_8192 shadow_map_4_x_4096; do
  "$crops" $name.exr ray_traced_32.exr --crop $part
done
"$crops" izb_32.exr shadow_map_8192.exr shadow_map_4_x_4096.exr ray_traced_32.exr supersampled.exr --crop $part \
  --magnify $((4 - scale)) -o "$picture" | tail -1

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# One crop of thin shadows four times, side by side: the picture in README.md.
set -euo pipefail
export LC_ALL=C

usage() {
  cat <<'TEXT'
usage: bench/crops.sh [OUT.png]

Renders the view garden.crops of bench/views.json by izb with 1 and with 32 samples a pixel, by rays with 32, and by rays
8 times as large in each direction with 32 each, box-filtered in linear light: 64 camera rays and 2048 shadow rays a pixel.
Writes the same pixels of the four, magnified and side by side, to OUT.png (default out/crops.png), and prints how many bits
of the masks differ, also between izb with --preset exact and the rays. Takes a minute or two.
TEXT
}

# shellcheck source=bench/garden_frames.sh
source "$(dirname "${BASH_SOURCE[0]}")/garden_frames.sh"
frame izb_1 320x180 --viewpoint garden.crops --technique izb --spp 1
frame izb_32 320x180 --viewpoint garden.crops --technique izb --spp 32
frame ray_traced_32 320x180 --viewpoint garden.crops --technique ray_traced --spp 32
frame izb_exact_32 320x180 --viewpoint garden.crops --technique izb --preset exact --spp 32
frame supersampled 2560x1440 --viewpoint garden.crops --technique ray_traced --spp 32

cd "$frames"
"$crops" izb_exact_32.exr ray_traced_32.exr --crop 116,48,96,76
"$crops" izb_1.exr izb_32.exr ray_traced_32.exr supersampled.exr --crop 116,48,96,76 --magnify 4 -o "$picture"

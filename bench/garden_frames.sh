# SPDX-License-Identifier: MIT
# For scripts that draw crops of the shipped scene, sourced after `usage` is defined: builds it, and izb_crops as `crops`.
# shellcheck source=bench/picture.sh
source "$(dirname "${BASH_SOURCE[0]}")/picture.sh"
cmake --build build/release --target izb_garden izb_crops >&2
crops=$PWD/build/release/bench/izb_crops
frames=$(mktemp -d)
trap 'rm -rf "$frames"' EXIT

# frame NAME SIZE OPTION...: renders $frames/NAME.exr
frame() {
  local name=$1 size=$2
  shift 2
  echo "$script: $name" >&2
  build/release/izb render build/release/assets/garden.glb --size "$size" "$@" -o "$frames/$name.exr" >/dev/null
}

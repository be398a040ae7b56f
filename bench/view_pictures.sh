#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The viewer's pictures: those in docs/VIEW.md and the README.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: bench/view_pictures.sh [FOLDER]

Opens the viewer on the shipped scene in a display of its own (Xvfb), drives it by synthetic input, and writes view_compare.png,
view_stages.png and view_light_space.png into FOLDER (default out). Takes some minutes without a GPU.
TEXT
}

# shellcheck source=bench/arguments.sh
source "$(dirname "${BASH_SOURCE[0]}")/arguments.sh"
folder=$(realpath -m "${1:-$(dirname "${BASH_SOURCE[0]}")/../out}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mkdir -p "$folder"
./run build
cmake --build build/release --target view_pictures >&2
build/release/tests/view/view_pictures "$folder"

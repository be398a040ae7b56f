# SPDX-License-Identifier: MIT
# For scripts that measure real scenes, sourced after `usage` is defined: source bench/scenes.sh NAME...
# Fills `scenes` with the files of $IZB_SCENES, or with those of the names given, goes to the project's root, makes the folder
# `out` ($OUT, or out/ and the script's name) and builds the program.
if [ "${1:-}" = --help ] || [ "${1:-}" = -h ]; then
  usage
  exit 0
fi
if [ ! -d "${IZB_SCENES:-}" ]; then
  usage >&2
  exit 2
fi

folder=$(cd "$IZB_SCENES" && pwd)
script=$(basename "$0")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=${OUT:-out/${script%.sh}}
mkdir -p "$out"
./run build
scenes=()
if [ $# -gt 0 ]; then
  for name in "$@"; do
    found=false
    for file in "$folder/$name".glb "$folder/$name".gltf; do
      if [ -f "$file" ]; then
        scenes+=("$file")
        found=true
      fi
    done
    if ! $found; then
      echo "$script: no $name.glb or $name.gltf in $folder" >&2
      exit 1
    fi
  done
else
  for file in "$folder"/*.glb "$folder"/*.gltf; do
    if [ -f "$file" ]; then
      scenes+=("$file")
    fi
  done
fi

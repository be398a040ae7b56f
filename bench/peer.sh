#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Our stages against Embree on the same frames: a table over the scenes of a folder, as Markdown.
set -euo pipefail
export LC_ALL=C

usage() {
  cat <<'TEXT'
usage: IZB_SCENES=FOLDER bench/peer.sh [NAME...]

Renders each scene of the folder (or those named, without .glb or .gltf) at 1920x1080 from the viewpoint of its name in
bench/views.json and prints the times of bounds, build, zcull and visibility, Embree's fastest rebuild plus one ray a
sample, and the ratio; at the end the median over the scenes between 100,000 and 1,000,000 triangles.

  SPP=N     samples a pixel, 1 or 32 (default 32)
  REPEAT=N  frames a scene (default 5)
  OUT=DIR   where the JSON of each scene stays (default out/peer)
TEXT
}

# shellcheck source=bench/scenes.sh
source "$(dirname "${BASH_SOURCE[0]}")/scenes.sh"

# row JSON NAME: one line of the table; the ratio of a scene of 100 k to 1 M triangles is also added to $ratios.
row() {
  awk -v scene="$2" -v ratios="$ratios" '
    function number(line) { sub(/^[^:]*: */, "", line); sub(/,$/, "", line); return line + 0 }
    /"gpu_ms":/ { ms = number($0) }
    /"name": "(bounds|build|zcull|visibility)"/ { split($0, part, "\""); stage[part[4]] = ms; sum += ms }
    /"triangles":/ { triangles = number($0) }
    /"fastest_rebuild_plus_trace_ms":/ { peer = number($0) }
    END {
      if (peer <= 0) exit 1
      printf "| %s | %d | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.2f |\n", scene, triangles, stage["bounds"],
             stage["build"], stage["zcull"], stage["visibility"], sum, peer, sum / peer
      if (triangles >= 100000 && triangles <= 1000000) print sum / peer >> ratios
    }' "$1"
}

ratios=$(mktemp)
trap 'rm -f "$ratios"' EXIT
status=0
echo "| scene | triangles | bounds | build | zcull | visibility | sum | Embree | ratio |"
echo "|---|---|---|---|---|---|---|---|---|"
for file in "${scenes[@]}"; do
  name=$(basename "${file%.*}")
  json=$out/$name.json
  if build/release/izb render "$file" --viewpoint "$name" --size 1920x1080 --spp "${SPP:-32}" \
    --repeat "${REPEAT:-5}" --peer on --json "$json" >"$out/$name.log"; then
    row "$json" "$name"
  else
    echo "peer.sh: $name failed" >&2
    status=1
  fi
done
sort -g "$ratios" | awk '
  { ratio[NR] = $1 }
  END {
    if (NR == 0) exit
    half = int((NR + 1) / 2)
    median = NR % 2 ? ratio[half] : (ratio[half] + ratio[half + 1]) / 2
    printf "| median of %d scenes | | | | | | | | %.2f |\n", NR, median
  }'
exit $status

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What each option of the paper's sections 5.4, 6 and 7 costs or saves at 32 samples: one table, as Markdown.
set -euo pipefail
export LC_ALL=C

usage() {
  cat <<'TEXT'
usage: IZB_SCENES=FOLDER bench/claims.sh [NAME...]

Renders each scene of the folder (or those named, without .glb or .gltf) at 1920x1080 from the viewpoint of its name in
bench/views.json, by default and with one option changed, and prints for each option the change in the time of bounds,
build, zcull and visibility, in fragments, in tests, and in nodes: medians over the scenes and, of the time, the extremes.
The defaults run before the changes, amid them and after them; changed runs are compared with the median of the three.

  REPEAT=N  frames a run (default 3)
  OUT=DIR   where the numbers of each run stay (default out/claims)
TEXT
}

# shellcheck source=bench/scenes.sh
source "$(dirname "${BASH_SOURCE[0]}")/scenes.sh"

changes=("--zcull off" "--zcull-pyramid off" "--nl-cull off" "--removal off" "--unchanged-skip off" "--pipelining on"
  "--dilation 0.5" "--nodes 2" "--cascades 4" "--cascades 4 --cascade-pass multiple" "--lut 32" "--lut 128"
  "--coverage exact" "--insertion exact" "--preset paper" "--spp 1")

# measure FILE OPTION...: shadow ms, fragments, tests and nodes on one line.
measure() {
  local file=$1 json=$out/run.json
  shift
  build/release/izb render "$file" --viewpoint "$(basename "${file%.*}")" --size 1920x1080 --repeat "${REPEAT:-3}" --json "$json" "$@" \
    >"$out/run.log" 2>&1 || { cat "$out/run.log" >&2; return 1; }
  awk '
    function number(line) { sub(/^[^:]*: */, "", line); sub(/,$/, "", line); return line + 0 }
    /"gpu_ms":/ { ms = number($0) }
    /"name": "(bounds|build|zcull|visibility)"/ { sum += ms }
    /"fragments_after_zcull":/ { fragments = number($0) }
    /"visibility_tests":/ { tests = number($0) }
    /"nodes":/ { if (!nodes) nodes = number($0) }
    END { if (!sum) exit 1; print sum, fragments, tests, nodes }' "$json"
}

: >"$out/runs.txt"
for file in "${scenes[@]}"; do
  name=$(basename "${file%.*}")
  defaults=$(measure "$file")
  : >"$out/changed.txt"
  for i in "${!changes[@]}"; do
    [ "$i" -ne $((${#changes[@]} / 2)) ] || defaults+=$'\n'$(measure "$file")
    # shellcheck disable=SC2086  # a change is several words
    if changed=$(measure "$file" ${changes[i]}); then
      echo "${changes[i]}|$changed" >>"$out/changed.txt"
    else
      echo "claims.sh: $name with ${changes[i]} failed" >&2
    fi
  done
  defaults+=$'\n'$(measure "$file")
  middle=$(echo "$defaults" | sort -g | sed -n 2p)
  sed "s/|/|$name $middle /" "$out/changed.txt" >>"$out/runs.txt"
done

echo "| option | scenes | time | from | to | fragments | tests | nodes |"
echo "|---|---|---|---|---|---|---|---|"
for change in "${changes[@]}"; do
  grep -F -- "$change|" "$out/runs.txt" | awk -F'|' -v change="$change" '$1 == change { print $2 }' | awk -v change="$change" '
    { n++; time[n] = $6 / $2; fragments[n] = $7 / $3; tests[n] = $8 / $4; nodes[n] = $9 / $5 }
    function median(a, n,   i, k, v) {
      for (i = 2; i <= n; ++i) { v = a[i]; for (k = i - 1; k > 0 && a[k] > v; --k) a[k + 1] = a[k]; a[k + 1] = v }
      return (a[int((n + 1) / 2)] + a[int((n + 2) / 2)]) / 2
    }
    function percent(x) { return sprintf("%+.1f %%", 100 * (x - 1)) }
    END {
      if (!n) exit
      m = median(time, n)
      printf "| `%s` | %d | %s | %s | %s | %s | %s | %s |\n", change, n, percent(m), percent(time[1]), percent(time[n]),
             percent(median(fragments, n)), percent(median(tests, n)), percent(median(nodes, n))
    }' || true
done

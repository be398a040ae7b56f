# SPDX-License-Identifier: MIT
# For scripts that draw one picture, sourced after `usage` is defined. `picture` becomes the path that the first argument
# names, or out/ and the script's name; goes to the project's root and builds the program.
# shellcheck source=bench/arguments.sh
source "$(dirname "${BASH_SOURCE[0]}")/arguments.sh"
script=$(basename "$0")
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
picture=$(realpath -m "${1:-$root/out/${script%.sh}.png}")
cd "$root"
mkdir -p out
if [ ! -d "$(dirname "$picture")" ]; then
  echo "$script: no folder '$(dirname "$picture")'" >&2
  exit 1
fi
./run build

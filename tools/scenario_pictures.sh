#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes the images of docs/images/scenarios and docs/images/routes from the folders of finished
# runs: three cameras at one instant, after a fifth of the run or at the given frame, and the plot.
# Needs ImageMagick and librsvg's rsvg-convert.
# Usage: tools/scenario_pictures.sh RUN[@FRAME]...
set -euo pipefail
cd "$(dirname "$0")/.."
[[ $# -gt 0 ]] || { echo "scenario_pictures: expected folders of runs" >&2; exit 2; }
for tool in montage rsvg-convert; do
  command -v $tool >/dev/null || { echo "scenario_pictures: expected $tool" >&2; exit 2; }
done
mkdir -p docs/images/scenarios docs/images/routes
for argument in "$@"; do
  run=${argument%@*}
  name=$(sed -nE 's/^name: "?([^"]*)"?$/\1/p' "$run/scenario.resolved.yaml" | head -1)
  if [[ $argument == *@* ]]; then
    frame=$run/frames/$(printf '%06d' "$((10#${argument##*@}))")
  else # in the first aisle
    mapfile -t lefts < <(ls "$run"/frames/*_front_left.png)
    frame=${lefts[$((${#lefts[@]} / 5))]%_front_left.png}
  fi
  tiles=()
  for camera in front_left back_left side; do
    [[ -f ${frame}_$camera.png ]] && tiles+=("${frame}_$camera.png")
  done
  [[ ${#tiles[@]} -gt 0 ]] || { echo "scenario_pictures: no pictures ${frame}_*.png" >&2; exit 2; }
  montage "${tiles[@]}" -tile 3x1 -geometry x150+2+2 -quality 82 -strip \
    "docs/images/scenarios/$name.jpg"
  rsvg-convert -w 700 "$run/plot.svg" | convert - -background white -flatten -quality 85 -strip \
    "docs/images/routes/$name.jpg"
done

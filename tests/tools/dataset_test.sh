#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# A small data set in every format, recorded, checked, and read by standard Python readers. Exits
# with 77 (skipped) if they are not installed. Usage: dataset_test.sh VINEBENCH ROOT
set -euo pipefail
vinebench=$1 root=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export VINEBENCH_CACHE=$(dirname "$vinebench")/test-plants

cat >"$work/rig.yaml" <<'YAML'
name: small
rate_hz: 15
cameras:
  - {name: left, width: 96, height: 64, fx: 60, fy: 60, position: [0.15, 0.06, 0.5], rpy_deg: [0, 0, 90]}
  - {name: right, width: 96, height: 64, fx: 60, fy: 60, position: [0.27, 0.06, 0.5], rpy_deg: [0, 0, 90]}
stereo_pairs: [{name: front, left: left, right: right}]
YAML
cat >"$work/small.yaml" <<YAML
name: small
world: {rows: [{start: [-0.5, 1.2], end: [2.5, 1.2]}], vines: {templates: 1}}
rover: {model: $root/models/csl-rover/rover.xml, rig: rig.yaml}
route: {acceleration: 2, waypoints: [{position: [0, 0]}, {position: [1, 0]}]}
duration: 0.2
YAML

formats=euroc,kitti,tum,dcvslam,rgb,depth,depth32,disparity,flow,flo,normals,semantic,instances,coco,mcap
"$vinebench" record "$work/small.yaml" --format "$formats" --out "$work/data" 2>"$work/log" ||
  { cat "$work/log"; exit 1; }
"$vinebench" check "$work/data"

# Invalid requests: each ends with one message and does not change existing data.
expect() {
  local code=$1 words=$2 got=0
  shift 2
  "$@" >"$work/said" 2>&1 || got=$?
  if [[ $got -ne $code ]] || ! grep -qF -- "$words" "$work/said"; then
    echo "expected exit code $code and '$words', got $got:" && cat "$work/said" && exit 1
  fi
}
record=("$vinebench" record "$work/small.yaml")
expect 2 "is not empty" "${record[@]}" --format rgb --out "$work/data"
expect 2 "unknown format 'eroc', expected some of euroc" "${record[@]}" --format eroc --out "$work/b"
expect 2 "no camera named 'front'" "${record[@]}" --format rgb --cameras front --out "$work/c"
expect 2 "--seeds 5..1: expected A..B" "${record[@]}" --format rgb --seeds 5..1 --out "$work/d"
expect 2 "unknown category 'grape'" "${record[@]}" --format coco --labels grape --out "$work/e"
expect 2 "none.yaml" "${record[@]}" --format rgb --randomise "$work/none.yaml" --out "$work/f"
expect 2 "--out" "${record[@]}" --format rgb
touch "$work/file"
expect 2 "Not a directory" "${record[@]}" --format rgb --out "$work/file/g"
expect 2 "is no data set of ours" "$vinebench" check "$work"
[[ ! -e $work/b && ! -e $work/d ]]
# A disk with space for a few images only.
(ulimit -f 4 && trap '' XFSZ && expect 2 "cannot be written: File too large" \
  "${record[@]}" --format depth32 --out "$work/full")
"$vinebench" check "$work/data" >/dev/null
cp -r "$work/data" "$work/good"
printf x >>"$work/data/rgb/left/000001.png"
expect 1 "rgb/left/000001.png: is damaged" "$vinebench" check "$work/data"

for python in python3 /usr/bin/python3; do
  if "$python" -c 'import cv2, numpy, PIL, yaml' 2>/dev/null; then
    "$python" "$root/tests/tools/read_dataset.py" "$work/good"
    exit
  fi
done
echo "Python has no cv2, numpy, PIL and yaml: its readers were skipped"
exit 77

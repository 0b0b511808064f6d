#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# ROS bags: recorded, interrupted, killed, on a full disk, and read by ROS's Python library. Exits
# with 77 (skipped) if it is not installed or the program was built without rosbag. Usage:
# ros_test.sh VINEBENCH ROOT
set -euo pipefail
vinebench=$1 root=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export VINEBENCH_CACHE=$work/cache

cat >"$work/rig.yaml" <<'YAML'
name: small
rate_hz: 15
cameras:
  - {name: left, width: 96, height: 64, fx: 60, fy: 60, position: [0.15, 0.06, 0.5], rpy_deg: [0, 0, 90]}
  - {name: right, width: 96, height: 64, fx: 60, fy: 60, position: [0.27, 0.06, 0.5], rpy_deg: [0, 0, 90]}
  - {name: side, width: 160, height: 96, fx: 80, fy: 81, cx: 78, distortion: [-0.05, 0.01, 0.001, 0.002], position: [0, -0.15, 0.5], rpy_deg: [0, 0, -80]}
stereo_pairs: [{name: front, left: left, right: right}]
tag_cameras: [side]
YAML
cat >"$work/small.yaml" <<YAML
name: small
world:
  rows: [{start: [-0.5, 1.2], end: [2.5, 1.2]}]
  vines: {templates: 1}
  tags: [{family: tag36h11, id: 3, size: 0.3, position: [0.2, -0.9, 0.5], facing_deg: 90}]
rover: {model: $root/models/csl-rover/rover.xml, rig: rig.yaml}
route: {acceleration: 2, waypoints: [{position: [0, 0]}, {position: [1, 0]}]}
duration: 0.4
YAML
sed 's/duration: 0.4/duration: 60/; s/position: \[1, 0\]/position: [30, 0]/' "$work/small.yaml" >"$work/long.yaml"

expect() {
  local code=$1 words=$2 got=0
  shift 2
  "$@" >"$work/said" 2>&1 || got=$?
  if [[ $got -ne $code ]] || ! grep -qF -- "$words" "$work/said"; then
    echo "expected exit code $code and '$words', got $got:" && cat "$work/said" && exit 1
  fi
}

record=("$vinebench" record "$work/small.yaml" --out)
if ! "${record[@]}" "$work/data" --format ros,euroc,dcvslam --jobs 3 >"$work/log" 2>&1; then
  expect 2 "built without ROS's libraries" "${record[@]}" "$work/data" --format ros
  [[ -z $(ls "$work/data") ]]
  echo "the program was built without rosbag (tools/setup.sh --ros): skipped"
  exit 77
fi
"$vinebench" check "$work/data"
"${record[@]}" "$work/colour" --format ros,rgb --image jpg --colour >"$work/log" 2>&1
"${record[@]}" "$work/again" --format ros --jobs 1 >"$work/log" 2>&1
cmp "$work/data/ros/run.bag" "$work/again/ros/run.bag"
grep -q "  ros/run.bag$" "$work/data/files.xxh128"
expect 2 "webp: expected png or jpg" "${record[@]}" "$work/webp" --format ros --image webp

# A disk that is full after a few frames; ^C; an end without a warning.
(ulimit -f 500 && trap '' XFSZ && expect 2 "run.bag: cannot be written: File too large" \
  "$vinebench" record "$work/long.yaml" --format ros --out "$work/full")
begin() {
  "$vinebench" record "$work/long.yaml" --format ros --out "$work/$1" >"$work/log" 2>&1 &
  until [[ -f $work/$1/frames.csv && $(wc -l <"$work/$1/frames.csv") -gt 4 ]]; do
    kill -0 $! || { cat "$work/log"; exit 1; }
    sleep 0.02
  done
}
begin stopped
kill -INT $!
wait $! && exit 1
"$vinebench" check "$work/stopped"
begin killed
kill -KILL $!
wait $! 2>/dev/null && exit 1
[[ -f $work/killed/ros/run.bag.active && ! -e $work/killed/ros/run.bag ]]
"$vinebench" check "$work/killed"

for python in python3 /usr/bin/python3; do
  if "$python" -c 'import cv2, numpy, rosbag, yaml' 2>/dev/null; then
    "$python" "$root/tests/tools/read_ros_bag.py" "$work"
    exit
  fi
done
echo "Python has no cv2, numpy, rosbag and yaml: its reader was skipped"
exit 77

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
export VINEBENCH_CACHE=$(dirname "$vinebench")/test-plants

. "$root/tests/tools/ros_scenario.sh"

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
begin ros stopped
kill -INT $!
wait $! && exit 1
"$vinebench" check "$work/stopped"
begin ros killed
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

#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Bags of ROS 2: recorded, interrupted, killed, on a full disk, replayed, read by PyPI's mcap,
# mcap-ros2-support and rosbags, and replayed from what rosbags wrote. Exits with 77 (skipped) if these
# are not installed. Usage: ros2_test.sh VINEBENCH ROOT
set -euo pipefail
vinebench=$1 root=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export VINEBENCH_CACHE=$(dirname "$vinebench")/test-plants
. "$root/tests/tools/ros_scenario.sh"

record=("$vinebench" record "$work/small.yaml" --out)
"${record[@]}" "$work/data" --format mcap,euroc,dcvslam --jobs 3 >"$work/log" 2>&1 ||
  { cat "$work/log"; exit 1; }
"$vinebench" check "$work/data"
"${record[@]}" "$work/colour" --format mcap,rgb --image jpg --colour >"$work/log" 2>&1
"${record[@]}" "$work/again" --format mcap --jobs 1 >"$work/log" 2>&1
cmp "$work/data/mcap/run.mcap" "$work/again/mcap/run.mcap"
cmp "$work/data/mcap/metadata.yaml" "$work/again/mcap/metadata.yaml"
grep -q "  mcap/run.mcap$" "$work/data/files.xxh128"
expect 2 "webp: expected png or jpg" "${record[@]}" "$work/webp" --format mcap --image webp

# A disk that is full after a few frames; ^C; an end without a warning.
(ulimit -f 500 && trap '' XFSZ && expect 2 "run.mcap: cannot be written: File too large" \
  "$vinebench" record "$work/long.yaml" --format mcap --out "$work/full")
begin mcap stopped
kill -INT $!
wait $! && exit 1
"$vinebench" check "$work/stopped"
begin mcap killed
kill -KILL $!
wait $! 2>/dev/null && exit 1
[[ ! -e $work/killed/mcap/metadata.yaml ]]
"$vinebench" check "$work/killed"
for kind in stopped killed full; do
  "$vinebench" replay "$work/$kind" --out "$work/replayed" >"$work/log" 2>&1 ||
    { cat "$work/log"; exit 1; }
done

# Broken and foreign files.
head -c 100000 "$work/data/mcap/run.mcap" >"$work/cut.mcap"
"$vinebench" replay "$work/cut.mcap" --rig "$work/rig.yaml" --out "$work/cut" >"$work/log" 2>&1
grep -q '"event":"bag_cut_off"' "$work/cut/events.jsonl"
echo "no bag" >"$work/none.mcap"
expect 2 "none.mcap: expected an MCAP file" "$vinebench" replay "$work/none.mcap"
expect 2 "none.db3: SQLite: " "$vinebench" replay "$(cp "$work/none.mcap" "$work/none.db3" && echo "$work/none.db3")"
expect 2 "--topics: expected topics of images, found '/none'" \
  "$vinebench" replay "$work/data/mcap" --topics /none,/left/image_rect

# A replay of the bag is that of the EuRoC folder. The cameras are large enough to track.
sed -i 's/width: 96, height: 64, fx: 60, fy: 60/width: 480, height: 320, fx: 300, fy: 300/' "$work/rig.yaml"
"${record[@]}" "$work/loop" --format mcap,euroc >"$work/log" 2>&1
replay() {
  "$vinebench" replay "$1" --out "$work/replay-$2" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  [[ $(grep -vc '^#' "$work/replay-$2/estimate.tum") -eq 7 ]]
}
replay "$work/loop/euroc" euroc
replay "$work/loop/mcap" mcap
for file in estimate.tum groundtruth.tum events.jsonl slam.resolved.yaml; do
  cmp "$work/replay-euroc/$file" "$work/replay-mcap/$file"
done

for python in python3 /usr/bin/python3; do
  "$python" -c 'import cv2, mcap, mcap_ros2, numpy, rosbags, yaml' 2>/dev/null || continue
  "$python" "$root/tests/tools/read_ros2_bag.py" "$work"
  # Bags of rosbags have neither our calibration nor our stamps: all is a second later.
  mkdir "$work/bare"
  cp "$work/loop/mcap/run.mcap" "$work/bare/"
  replay "$work/bare/run.mcap" bare
  "$python" "$root/tests/tools/copy_ros2_bag.py" "$work/loop/mcap" "$work/copied"
  for kind in sqlite3 mcap; do
    replay "$work/copied/$kind" "$kind"
    for file in estimate.tum groundtruth.tum; do
      cmp <(grep -v '^#' "$work/replay-bare/$file" | cut -d ' ' -f 2-) \
        <(grep -v '^#' "$work/replay-$kind/$file" | cut -d ' ' -f 2-)
    done
  done
  grep -q "^1.000000000 " "$work/replay-sqlite3/estimate.tum"
  exit
done
echo "Python has no cv2, mcap, mcap_ros2, numpy, rosbags and yaml: their readers were skipped"
exit 77

# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# What ros_test.sh and ros2_test.sh record, in $work: small.yaml and the same for a minute, long.yaml.

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

# begin FORMAT NAME: records long.yaml in the background until some frames are listed.
begin() {
  "$vinebench" record "$work/long.yaml" --format "$1" --out "$work/$2" >"$work/log" 2>&1 &
  until [[ -f $work/$2/frames.csv && $(wc -l <"$work/$2/frames.csv") -gt 4 ]]; do
    kill -0 $! || { cat "$work/log"; exit 1; }
    sleep 0.02
  done
}

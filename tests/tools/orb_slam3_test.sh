#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# examples/orb_slam3/run.sh with a fake ORB-SLAM3 program. Usage: orb_slam3_test.sh ROOT
set -uo pipefail
root=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
check() { # check NAME COMMAND...
  if ! "${@:2}"; then
    echo "FAILED: $1"
    failures=$((failures + 1))
  fi
}

mkdir -p "$work/output"
touch "$work/vocabulary"
# Cameras 0.12 m apart along y; an image of the right one is missing.
for camera in 0 1; do
  mkdir -p "$work/recording/mav0/cam$camera/data"
  touch "$work/recording/mav0/cam$camera/data/"{0,66666667,1000000000}.png
  cat >"$work/recording/mav0/cam$camera/sensor.yaml" <<END
sensor_type: camera
T_BS:
  cols: 4
  rows: 4
  data: [0, 0, 1, 0.3,
         -1, 0, 0, $([[ $camera -eq 0 ]] && echo 0.06 || echo -0.06),
         0, -1, 0, 0.5,
         0, 0, 0, 1]
rate_hz: 15
resolution: [752, 480]
intrinsics: [263.2786, 263.2786, 375.5, 239.5]
END
done
rm "$work/recording/mav0/cam1/data/66666667.png"
cat >"$work/stereo" <<'END'
#!/usr/bin/env bash
echo "$1|$2|$3|$4|$5" >arguments
[[ -n ${QUIET:-} ]] || echo "0 0 0 0 0 0 0 1" >f_vinebench.txt
exit 139
END
chmod +x "$work/stereo"
run() { "$root/examples/orb_slam3/run.sh" "$@" 2>"$work/messages"; }

check "a crash after the trajectory" run "$work/stereo" "$work/vocabulary" "$work/recording" \
  "$work/output"
check "the arguments" grep -qFx \
  "$work/vocabulary|settings.yaml|$work/recording|times.txt|vinebench" "$work/output/arguments"
check "the frames of both cameras" diff <(printf '%s\n' 0 1000000000) "$work/output/times.txt"
# The right camera is 0.12 m along the left one's x axis, and turned by nothing.
for line in 'Camera.type: "PinHole"' "Camera1.fx: 263.278600000" "Camera1.cx: 375.500000000" \
  "Camera2.fx: 263.278600000" "Camera2.cy: 239.500000000" "Camera.width: 752" "Camera.height: 480" \
  "Camera.fps: 15" "  data: [1.000000000, 0.000000000, 0.000000000, 0.120000000,\
 0.000000000, 1.000000000, 0.000000000, 0.000000000,\
 0.000000000, 0.000000000, 1.000000000, 0.000000000, 0.0, 0.0, 0.0, 1.0]"; do
  check "the setting $line" grep -qFx "$line" "$work/output/settings.yaml"
done
rm "$work/output/f_vinebench.txt"
QUIET=1 run "$work/stereo" "$work/vocabulary" "$work/recording" "$work/output"
check "a crash without one" test $? -eq 139
run "$work/none" "$work/vocabulary" "$work/recording" "$work/output"
check "a missing program" grep -qF "none: no program" "$work/messages"
exit $((failures > 0))

#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Runs ORB-SLAM3's example program stereo_euroc (release 1.0) on a recording of Vinebench, for
# slam.external. Usage: run.sh STEREO_EUROC VOCABULARY RECORDING OUTPUT
#   STEREO_EUROC  the program, as built from its own sources
#   VOCABULARY    ORBvoc.txt, unpacked
# Takes the first two cameras, which must be a rectified pair; writes f_vinebench.txt, the poses
# of the left one.
set -euo pipefail
[[ $# -eq 4 ]] || { echo "usage: run.sh STEREO_EUROC VOCABULARY RECORDING OUTPUT" >&2; exit 2; }
program=$1 vocabulary=$2 recording=$3 output=$4
[[ -x $program ]] || { echo "run.sh: $program: no program" >&2; exit 2; }
[[ -r $vocabulary ]] || { echo "run.sh: $vocabulary: cannot be read" >&2; exit 2; }
left=$recording/mav0/cam0 right=$recording/mav0/cam1

# numbers KEY FILE: those in the brackets after the key, which may go over several lines.
numbers() {
  tr '\n' ' ' <"$2" | sed -nE "s/.*[[:space:]]$1: \[([^]]*)\].*/\1/p" | tr ',' ' '
}
read -r width height <<<"$(numbers resolution "$left/sensor.yaml")"
rate=$(sed -nE 's/^rate_hz: //p' "$left/sensor.yaml")
# T_c1_c2, row by row: the inverse of the left camera's T_BS times the right one's.
T_c1_c2=$(echo "$(numbers data "$left/sensor.yaml") $(numbers data "$right/sensor.yaml")" | awk '{
  for (r = 0; r < 3; ++r) {
    for (c = 0; c < 4; ++c) {
      sum = 0
      for (i = 0; i < 3; ++i) sum += $(1 + 4 * i + r) * ($(17 + 4 * i + c) - (c == 3 ? $(4 + 4 * i) : 0))
      printf "%.9f, ", sum
    }
  }
  print "0.0, 0.0, 0.0, 1.0"
}')

# Not the type "Rectified": release 1.0 crashes on it when it prints the second camera.
camera() { # camera NUMBER FILE
  local fx fy cx cy
  read -r fx fy cx cy <<<"$(numbers intrinsics "$2")"
  printf "Camera$1.%s: %.9f\n" fx "$fx" fy "$fy" cx "$cx" cy "$cy"
}
cat >"$output/settings.yaml" <<END
%YAML:1.0
File.version: "1.0"
Camera.type: "PinHole"
$(camera 1 "$left/sensor.yaml")
$(camera 2 "$right/sensor.yaml")
Stereo.T_c1_c2: !!opencv-matrix
  rows: 4
  cols: 4
  dt: f
  data: [$T_c1_c2]
Camera.width: $width
Camera.height: $height
Camera.fps: $(printf %.0f "$rate")
Camera.RGB: 1
Stereo.ThDepth: 40.0
ORBextractor.nFeatures: 1200
ORBextractor.scaleFactor: 1.2
ORBextractor.nLevels: 8
ORBextractor.iniThFAST: 20
ORBextractor.minThFAST: 7
Viewer.KeyFrameSize: 0.05
Viewer.KeyFrameLineWidth: 1.0
Viewer.GraphLineWidth: 0.9
Viewer.PointSize: 2.0
Viewer.CameraSize: 0.08
Viewer.CameraLineWidth: 3.0
Viewer.ViewpointX: 0.0
Viewer.ViewpointY: -0.7
Viewer.ViewpointZ: -1.8
Viewer.ViewpointF: 500.0
END
# Frames of both cameras, by the stamps in the image names.
comm -12 <(ls "$left/data" | sort) <(ls "$right/data" | sort) | sed 's/\.png$//' | sort -n \
  >"$output/times.txt"

cd "$output"
code=0
"$program" "$vocabulary" settings.yaml "$recording" times.txt vinebench || code=$?
# It may crash in its clean-up, after the trajectory has been written.
if [[ $code -ne 0 && ! -s f_vinebench.txt ]]; then
  echo "run.sh: $program: exit code $code, and no trajectory" >&2
  exit "$code"
fi

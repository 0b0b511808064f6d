#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Regenerates the contact sheets of docs/images: worlds, growth stages, lights, sensor effects and
# labels. Needs ImageMagick's montage. Usage: tools/contact_sheets.sh [VINEBENCH]
set -euo pipefail
cd "$(dirname "$0")/.."
vinebench=${1:-build/vinebench}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
command -v montage >/dev/null || { echo "contact_sheets: expected ImageMagick's montage" >&2; exit 2; }

# tile SHEET TITLE ARGUMENTS...: one image of a sheet, in the order of the calls.
count=0
tile() {
  count=$((count + 1))
  mkdir -p "$work/$1"
  local file
  file=$(printf '%s/%s/%02d_%s.png' "$work" "$1" "$count" "$2")
  "$vinebench" render "${@:3}" --out "$file"
}

# sheet NAME COLUMNS SIZE: the tiles of that name with their titles.
sheet() {
  local arguments=() file title
  for file in "$work/$1"/*.png; do
    title=$(basename "$file" .png)
    title=${title#*_}
    arguments+=(-label "${title//_/ }" "$file")
  done
  montage "${arguments[@]}" -tile "$2x" -geometry "$3+3+3" -pointsize 13 -quality 85 -strip \
    "docs/images/$1.jpg"
}

small=752x480@263.2786
person=900x575@520
csl=worlds/csl-vineyard.yaml
many=worlds/many-rows.yaml
typical=worlds/typical-vineyard.yaml

tile worlds csl-vineyard_from_the_rover "$csl" --camera $small --pose 0.6,0,0.5,0
tile worlds csl-vineyard_from_outside "$csl" --camera $person --pose=-2.2,-2.4,1.7,45,-12
tile worlds many-rows_from_the_rover "$many" --camera $small --pose 0.5,0,0.5,0
tile worlds many-rows_from_above "$many" --camera $person --pose=-6,-5,4,42,-14
tile worlds typical-vineyard_from_the_rover "$typical" --camera $small --pose 3,1.25,0.5,0
tile worlds typical-vineyard_from_above "$typical" --camera $person --pose=-8,-7,5,42,-12
sheet worlds 2 560x

for stage in "00 dormant" "09 budburst" "65 flowering" "75 pea_size" "83 veraison" "89 harvest" \
  "95 leaf_fall"; do
  code=${stage%% *}
  tile plants "BBCH_${code}_${stage#* }" "$csl" --camera 1400x1800@1240 --pose 1.5,-1.7,0.85,90 \
    --set "vines.bbch=$((10#$code))"
done
for training in unilateral_cordon single_guyot double_guyot; do
  tile plants "harvest,_$training" "$csl" --camera 1400x1800@1240 --pose 1.5,-1.7,0.85,90 \
    --set "vines.training=$training"
done
sheet plants 5 280x

view=(--camera "$small" --pose 4,1.25,0.5,0)
tile lights sun_50_degrees_high "$typical" "${view[@]}"
tile lights low_sun_into_the_lens "$typical" "${view[@]}" --set sun.azimuth_deg=82 \
  --set sun.elevation_deg=14
tile lights overcast "$typical" "${view[@]}" --set sky.overcast=1
tile lights haze,_60_m_of_visibility "$typical" "${view[@]}" --set sky.visibility=60
tile lights dusk,_2_degrees_below_the_horizon "$typical" "${view[@]}" --set sun.elevation_deg=-2
tile lights 20_September,_45_degrees_north,_16:30_UTC "$typical" "${view[@]}" \
  --set 'sun.at={latitude_deg: 45.4, longitude_deg: 9, date: 2026-09-20, time: "16:30"}'
sheet lights 3 420x

# Sensor effects need exposures in motion: a frame of a run in which the rover turns on the spot.
cat >"$work/sensors.yaml" <<END
name: sensors
seed: 1
world: $PWD/worlds/csl-vineyard.yaml
rover: $PWD/models/csl-rover/rover.yaml
duration: 0.6
route:
  speed: 1
  turn_rate_deg: 90
  turn_acceleration_deg: 720
  waypoints:
    - {position: [0.5, 0], heading_deg: 40}
    - {position: [0.5, 0], heading_deg: -80}
slam: {cameras: front}
END
effect() {
  count=$((count + 1))
  mkdir -p "$work/sensors"
  # The verdict is irrelevant here; tracking may be lost.
  "$vinebench" run "$work/sensors.yaml" --out "$work/run_$count" "${@:2}" >/dev/null 2>&1 || true
  cp "$work/run_$count/frames/000006_front_left.png" \
    "$(printf '%s/sensors/%02d_%s.png' "$work" "$count" "$1")"
}
c=sensors.camera
effect everything_off --set $c.noise.enabled=false
effect the_default
effect gain_of_20_dB --set $c.exposure.gain_db=20 --set $c.exposure.time=0.0002
effect lens_distortion --set \
  'sensors.calibration.cameras=[{name: front_left, distortion: [-0.2, 0.035, 0, 0]}]'
effect motion_blur --set $c.exposure.time=0.03 --set $c.exposure.reference_time=0.01 \
  --set $c.blur_subframes=24
effect rolling_shutter --set $c.exposure.time=0.002 --set $c.readout_time=0.06 --set $c.readout_bands=60
effect vignetting --set $c.vignetting.natural=0.7
effect dirt --set $c.dirt='[{count: 60, opacity: 0.6}]'
effect a_leaf_on_the_glass --set $c.leaves='[{position: [0.3, 0.5], size: 0.8, angle_deg: 25}]'
effect colour_filters --set $c.bayer=rggb --set $c.exposure.gain_db=12 \
  --set $c.exposure.time=0.0005
effect fixed_pattern --set $c.fixed_pattern.response=0.08 \
  --set $c.fixed_pattern.hot_pixels=0.001 --set $c.exposure.gain_db=12 \
  --set $c.exposure.time=0.0005
effect white_balance --set $c.white_balance.red=1.3 --set $c.white_balance.blue=0.8
effect saturation_and_contrast --set $c.response.saturation=1.5 --set $c.response.contrast=0.8
effect JPEG,_quality_10 --set $c.jpeg.quality=10
effect automatic_exposure_at_dusk --set $c.exposure.automatic=true --set world.sun.elevation_deg=-1
sheet sensors 4 376x

# Every kind of label; depth from black to white at 10 m, disparity over all greys.
labels=$work/labels
mkdir -p "$labels"
"$vinebench" render "$csl" --camera $small --pose=-0.3,0,0.5,8 --out "$labels/01_rgb.png" \
  --labels "$labels/02_semantic.png" --instances "$labels/03_instances.png" \
  --normals "$labels/04_normals.png" --depth "$labels/05_depth.png" \
  --disparity "$labels/06_disparity.png" --flow-to=-0.25,0.01,0.5,9 \
  --flow "$labels/07_flow.png" --flow-visible "$labels/08_flow_visible.png"
mogrify -level 0,10000 -depth 8 "$labels"/05_depth.png
mogrify -auto-level -depth 8 "$labels"/06_disparity.png
# COCO's things from the Python module: tinted masks and boxes.
PYTHONPATH=build/python /usr/bin/python3 - "$labels/09_coco,_bunches_and_posts.ppm" <<'END'
import sys
import vinebench
scenario = vinebench.Scenario("scenarios/aisle-loop.yaml", cameras=["front_left"], truth=["things"],
                              frames=(0, 0))
frame = next(scenario)
image = frame.images["front_left"].copy()
for thing in frame.things("front_left"):
    if thing["category"] not in ("bunch", "post") or thing["box"][3] < 6:
        continue
    colour = (255, 60, 200) if thing["category"] == "bunch" else (60, 160, 255)
    x, y, width, height = thing["box"]
    image[thing["mask"]] = image[thing["mask"]] // 2 + [c // 2 for c in colour]
    image[y:y + height, [x, x + width - 1]] = colour
    image[[y, y + height - 1], x:x + width] = colour
with open(sys.argv[1], "wb") as file:
    file.write(b"P6 %d %d 255\n" % (image.shape[1], image.shape[0]) + image.tobytes())
END
mogrify -format png "$labels"/*.ppm && rm "$labels"/*.ppm
sheet labels 3 420x

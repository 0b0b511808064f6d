#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes the pictures of docs/images anew: worlds, growth stages, lights and sensor effects, each on
# one sheet. Needs ImageMagick's montage. Usage: tools/contact_sheets.sh [VINEBENCH]
set -euo pipefail
cd "$(dirname "$0")/.."
vinebench=${1:-build/vinebench}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
command -v montage >/dev/null || { echo "contact_sheets: expected ImageMagick's montage" >&2; exit 2; }

# tile SHEET TITLE ARGUMENTS...: one picture of a sheet, in the order of the calls.
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
tile worlds many-rows_from_the_rover "$many" --camera $small --pose 1,1,0.5,0
tile worlds many-rows_from_above "$many" --camera $person --pose=-6,-5,4,42,-14
tile worlds typical-vineyard_from_the_rover "$typical" --camera $small --pose 3,1.25,0.5,0
tile worlds typical-vineyard_from_above "$typical" --camera $person --pose=-8,-7,5,42,-12
sheet worlds 2 560x

for stage in "00 dormant" "09 budburst" "65 flowering" "75 pea_size" "83 veraison" "89 harvest" \
  "95 leaf_fall"; do
  code=${stage%% *}
  tile plants "BBCH_${code}_${stage#* }" "$csl" --camera 700x900@620 --pose 1.5,-1.7,0.85,90 \
    --set "vines.bbch=$((10#$code))"
done
for training in unilateral_cordon single_guyot double_guyot; do
  tile plants "harvest,_$training" "$csl" --camera 700x900@620 --pose 1.5,-1.7,0.85,90 \
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
tile lights September_at_17:00_UTC "$typical" "${view[@]}" \
  --set 'sun.at={latitude_deg: 45.4, longitude_deg: 9, date: 2026-09-20, time: "16:30"}'
sheet lights 3 420x

#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Which part of the core is worth how much: replays the same images with one part of the full system
# taken away, and with one added to the paper's core, and prints a table of errors (docs/results.md).
# Each scenario and seed is recorded once, in OUT/recording, and removed when it has been replayed
# (long-path takes 3 GB); results that are there already are kept. Exit code 1 if a replay fails.
#   SEEDS=1..3  OUT=out/ablations  SCENARIOS="occluded-camera long-path"  VINEBENCH=build/vinebench
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seeds=${SEEDS:-1..3}
out=${OUT:-out/ablations}
read -ra scenarios <<<"${SCENARIOS:-occluded-camera long-path}"
vinebench=${VINEBENCH:-build/vinebench}
[[ $seeds =~ ^([0-9]+)(\.\.([0-9]+))?$ ]] || { echo "ablations.sh: SEEDS: expected A..B" >&2; exit 2; }
first=${BASH_REMATCH[1]} last=${BASH_REMATCH[3]:-${BASH_REMATCH[1]}}
[[ -x $vinebench ]] || { echo "ablations.sh: $vinebench: is no program" >&2; exit 2; }

# Name, whose settings it starts from, what is set.
patches='slam.refinement.enabled=true slam.stereo.search=windows'
variants=(
  'full|recorded|'
  'full, no patches|recorded|slam.refinement.enabled=false'
  'full, stereo by features|recorded|slam.stereo.search=features'
  "full, Huber's loss|recorded|slam.loss=huber"
  'full, no self-calibration|recorded|slam.stereo.self_calibration=false'
  "full, the paper's keyframes|recorded|slam.keyframes.distance=1e9 slam.keyframes.angle_deg=1e9"
  'paper|paper|'
  'paper, stereo by windows|paper|slam.stereo.search=windows'
  "paper, Cauchy's loss|paper|slam.loss=cauchy"
  'paper, keyframes by distance|paper|slam.keyframes.distance=0.25 slam.keyframes.angle_deg=12'
  "paper, patches and stereo by windows|paper|$patches"
  "paper, these and Cauchy's loss|paper|$patches slam.loss=cauchy"
)

# Of a run's metrics.json, in mm.
millimetres() {
  local value
  value=$(sed -nE "s/^ *\"$2\": ([-0-9.e]+),?\$/\1/p" "$1/metrics.json")
  [[ -n $value ]] && printf '%.1f' "$(awk "BEGIN { print 1000 * $value }")" || printf 'none'
}

for scenario in "${scenarios[@]}"; do
  for ((seed = first; seed <= last; ++seed)); do
    recording=$out/recording
    for variant in "${variants[@]}"; do
      IFS='|' read -r name base settings <<<"$variant"
      result=$out/$scenario/seed-$seed/$name
      [[ ! -s $result/metrics.json ]] || continue
      if [[ ! -s $recording/complete ]]; then
        rm -rf "$recording"
        mkdir -p "$out"
        "$vinebench" record "$scenario" --set "seed=$seed" --format euroc --out "$recording" >"$out/log.txt" 2>&1
        touch "$recording/complete" && echo yes >"$recording/complete"
        # The paper's settings, with the rover's wheels.
        { echo 'preset: paper'; sed -n '/^dead_reckoning:/,/^[a-z]/{/^dead_reckoning:/p;/^ /p}' \
          "$recording/euroc/slam.yaml"; } >"$recording/paper.yaml"
        cp "$recording/euroc/slam.yaml" "$recording/recorded.yaml"
      fi
      arguments=()
      for setting in $settings; do arguments+=(--set "$setting"); done
      "$vinebench" replay "$recording/euroc" --slam "$recording/$base.yaml" "${arguments[@]}" \
        --out "$result" >"$out/log.txt" 2>&1 || [[ $? -eq 1 ]] || { cat "$out/log.txt"; exit 1; }
    done
    rm -rf "$recording"
  done
done

printf '| ATE origin / ATE, mm'
for scenario in "${scenarios[@]}"; do
  for ((seed = first; seed <= last; ++seed)); do printf ' | %s, seed %d' "$scenario" "$seed"; done
done
printf ' |\n|---'
for scenario in "${scenarios[@]}"; do for ((seed = first; seed <= last; ++seed)); do printf '|---:'; done; done
echo '|'
for variant in "${variants[@]}"; do
  name=${variant%%|*}
  printf '| %s' "$name"
  for scenario in "${scenarios[@]}"; do
    for ((seed = first; seed <= last; ++seed)); do
      result=$out/$scenario/seed-$seed/$name
      printf ' | %s / %s' "$(millimetres "$result" ate_origin_rmse_m)" "$(millimetres "$result" ate_rmse_m)"
    done
  done
  echo ' |'
done

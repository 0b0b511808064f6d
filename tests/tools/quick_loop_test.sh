#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# The quick-loop scenario from end to end. Usage: quick_loop_test.sh STEP VINEBENCH ROOT WORK [PLUGIN]
# with STEP one of
#   verdict  its expectations are met
#   resolved a second run, of its own scenario.resolved.yaml with one thread in place of two, is the
#            same to the byte (needs verdict)
#   map      a run with the map of verdict is relocalised in it, by tag and by appearance (needs
#            verdict)
#   replayed replays of recordings of it, EuRoC and KITTI, give the same estimate (0.8 s)
#   plugin   the SLAM core gives the same estimate twice, and as a plug-in (0.8 s); PLUGIN is
#            examples/slam_plugin
#   external a program replaces the core, and its poses are evaluated (0.3 s)
#   front    with the front cameras only it is lost or ten times worse (needs verdict)
set -euo pipefail
step=$1 vinebench=$2 root=$3 work=$4
scenario=$root/scenarios/quick-loop.yaml

# A metric of a run's metrics.json; "null" if it was not measured.
metric() { sed -nE "s/^  \"$2\": \"?([^\",]*)\"?,?\$/\1/p" "$work/$1/metrics.json"; }

same_hash() {
  echo "hash of verdict: $(metric verdict hash), of $1: $(metric "$1" hash)"
  [[ -n $(metric verdict hash) && $(metric verdict hash) == $(metric "$1" hash) ]]
}

case $step in
  verdict)
    mkdir -p "$work"
    "$vinebench" run "$scenario" --out "$work/verdict" --threads 2 \
      --save-map "$work/verdict.map" --save-cloud "$work/verdict.ply"
    ;;
  resolved)
    "$vinebench" run "$work/verdict/scenario.resolved.yaml" --out "$work/resolved" --threads 1
    same_hash resolved
    ;;
  map)
    # In a known place no keyframes are added, so there is no loop to close.
    in_the_map=(--load-map "$work/verdict.map" --set goal.loop_closures_correct_min=null
      --set goal.loop_closures_missed_max=null --set guard=null)
    "$vinebench" run "$scenario" --out "$work/by_tag" "${in_the_map[@]}"
    # Without the tag camera: the second frame is the first that can have a pose.
    "$vinebench" run "$scenario" --out "$work/by_looks" "${in_the_map[@]}" \
      --set 'slam.cameras=[front, back]' --set goal.coverage_min=0.97
    for run in verdict by_tag by_looks; do
      echo "$run: $(metric $run keyframes) keyframes, $(metric $run landmarks) landmarks," \
        "ATE $(metric $run ate_rmse_m) m"
    done
    for run in by_tag by_looks; do
      awk -v new="$(metric $run keyframes)" -v first="$(metric verdict keyframes)" \
        -v now="$(metric $run landmarks)" -v before="$(metric verdict landmarks)" \
        'BEGIN { exit !(new <= 0.25 * first && now <= 1.15 * before) }'
    done
    ;;
  front)
    code=0
    "$vinebench" run "$scenario" --out "$work/front" --set slam.cameras=front || code=$?
    [[ $code -eq 1 ]] || { echo "exit code $code, expected 1" >&2; exit 1; }
    echo "front cameras alone: $(metric front losses) losses, ATE $(metric front ate_rmse_m) m;" \
      "all cameras: ATE $(metric verdict ate_rmse_m) m"
    awk -v losses="$(metric front losses)" -v alone="$(metric front ate_rmse_m)" \
      -v all="$(metric verdict ate_rmse_m)" \
      'BEGIN { exit !(losses + 0 > 0 || alone == "null" || alone + 0 >= 10 * all) }'
    ;;
  replayed)
    rm -rf "$work/recording"
    code=0
    "$vinebench" run "$scenario" --out "$work/short" --set duration=0.8 \
      --record "$work/recording" || code=$?
    [[ $code -le 1 ]] || exit $code  # too short for the scenario's expectations
    "$vinebench" replay "$work/recording" --out "$work/replayed" --threads 1
    for file in estimate.tum estimate_live.tum keyframes.tum; do
      [[ -s $work/short/$file ]] || { echo "$file is empty" >&2; exit 1; }
      cmp "$work/short/$file" "$work/replayed/$file"
    done
    # KITTI has the front pair only.
    rm -rf "$work/recording"
    "$vinebench" run "$scenario" --out "$work/short" --set duration=0.8 --set slam.cameras=front \
      --record "$work/recording" --record-format kitti || code=$?
    [[ $code -le 1 ]] || exit $code
    "$vinebench" replay "$work/recording" --out "$work/replayed" --threads 1
    for file in estimate.tum estimate_live.tum keyframes.tum; do
      cmp "$work/short/$file" "$work/replayed/$file"
    done
    ;;
  plugin)
    mkdir -p "$work"
    for run in built_in plugged; do
      how=(--verify-determinism)
      [[ $run == built_in ]] || how=(--set "slam.plugin.library=$5")
      code=0
      "$vinebench" run "$scenario" --out "$work/$run" --set duration=0.8 "${how[@]}" |
        tee "$work/$run.txt" || code=$?
      [[ $code -le 1 ]] || exit $code  # too short for the scenario's expectations
    done
    grep -qF "determinism: both runs have hash $(metric built_in hash)" "$work/built_in.txt"
    for file in estimate.tum estimate_live.tum keyframes.tum; do
      [[ -s $work/built_in/$file ]] || { echo "$file is empty" >&2; exit 1; }
      cmp "$work/built_in/$file" "$work/plugged/$file"
    done
    for figure in coverage landmarks ate_rmse_m; do
      [[ $(metric built_in $figure) == "$(metric plugged $figure)" ]]
    done
    ;;
  external)
    mkdir -p "$work"
    # A stationary estimate without a pose of the last frame.
    cat >"$work/stand.sh" <<'END'
#!/bin/sh
sed '1d; $d; s/$/ 0 0 0 0 0 0 1/' "$1/frames.csv" >"$2/trajectory.txt"
END
    chmod +x "$work/stand.sh"
    code=0
    "$vinebench" run "$scenario" --out "$work/external" --set duration=0.3 \
      --set "slam.external.program=$work/stand.sh" || code=$?
    [[ $code -eq 1 ]]
    # 0.3 s at 15 Hz are frames 0 to 4; four of the five have a pose.
    [[ $(metric external frames) -eq 5 && $(metric external coverage) == 0.8 ]]
    [[ ! -e $work/external/recording ]]
    ;;
  *)
    echo "unknown step '$step'" >&2
    exit 2
    ;;
esac

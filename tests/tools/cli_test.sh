#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# The command line: each command once on something small, and bad input, which gives exit code 2 and
# one message that names file, line and key. Usage: cli_test.sh VINEBENCH ROOT
set -uo pipefail
vinebench=$1
root=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

report() {
  echo "FAILED: $1"
  sed 's/^/    /' "$work/stdout" "$work/stderr"
  failures=$((failures + 1))
}

# expect CODE NAME WORDS... -- ARGUMENTS...: exit code, and words on stderr (on stdout for code 0).
expect() {
  local code=$1 name=$2 words=()
  shift 2
  while [[ $1 != -- ]]; do
    words+=("$1")
    shift
  done
  shift
  "$vinebench" "$@" >"$work/stdout" 2>"$work/stderr" </dev/null
  local got=$?
  if [[ $got -ne $code ]]; then
    report "$name: exit code $got, expected $code"
    return
  fi
  local where=stderr word
  [[ $code -eq 0 ]] && where=stdout
  for word in "${words[@]}"; do
    grep -qF -- "$word" "$work/$where" || report "$name: $where lacks '$word'"
  done
  if [[ $code -eq 2 && $(grep -c '^vinebench: ' "$work/stderr") -gt 1 ]]; then
    report "$name: more than one message"
  fi
}

# Writes a scenario, with $1 as further lines from line 4 on.
scenario() {
  printf '%s\n' "name: bad" "world: world.yaml" "rover: $root/models/csl-rover/rover.yaml" "$1" \
    "route: {waypoints: [{position: [0, 0]}]}" >"$work/bad.yaml"
}
world() {
  printf '%s\n' "name: bad" "rows: [{start: [0, 0], end: [4, 0]}]" "$1" >"$work/world.yaml"
}

world "ground_size: 20"
scenario "sede: 4"
expect 2 "unknown key" "bad.yaml:4: sede: unknown key, expected one of: " -- run "$work/bad.yaml"

scenario "seed: 4"
world "vines: {meshes: [nowhere.glb]}"
expect 2 "missing mesh" "world.yaml:3: world.vines.meshes.0: " "nowhere.glb" -- run "$work/bad.yaml"

world "tags: [{family: tag36h11, id: 587}]"
expect 2 "tag outside its family" "world.yaml:3: world.tags.0" "id" -- run "$work/bad.yaml"

world "ground_size: 20"
printf '%s\n' "model: $root/models/csl-rover/rover.xml" "rig: $root/models/csl-rover/rig.yaml" \
  "imu_rate_hz: -200" >"$work/rover.yaml"
sed -i "s|^rover: .*|rover: rover.yaml|" "$work/bad.yaml"
expect 2 "negative rate" "rover.yaml:3: rover.imu_rate_hz: expected" "-200" -- run "$work/bad.yaml"

scenario "seed: 4"
sed 's/^rate_hz: .*/rate_hz: -15/' "$root/models/csl-rover/rig.yaml" >"$work/rig.yaml"
printf '%s\n' "model: $root/models/csl-rover/rover.xml" "rig: rig.yaml" >"$work/rover.yaml"
sed -i "s|^rover: .*|rover: rover.yaml|" "$work/bad.yaml"
rate_line=$(grep -n '^rate_hz' "$work/rig.yaml" | cut -d: -f1)
expect 2 "negative frame rate" "rig.yaml:$rate_line: rate_hz: expected" "-15" -- \
  run "$work/bad.yaml" --out "$work/out"

scenario "seed: 4"
touch "$work/file"
expect 2 "unwritable output folder" "output folder" "$work/file/out" -- \
  run "$work/bad.yaml" --out "$work/file/out"

expect 2 "unknown --set key" "--set world.sun.elevation=20: world.sun.elevation: unknown key" -- \
  run "$work/bad.yaml" --set world.sun.elevation=20
expect 2 "--set without value" "--set seed: expected KEY=VALUE" -- run "$work/bad.yaml" --set seed
expect 2 "missing scenario" "$work/none.yaml" -- run "$work/none.yaml"
expect 2 "no YAML" "is not valid YAML" -- run "$work/rig.yaml" --set 'seed=[1'
expect 2 "unknown command" "vinebench: fly: no such command" -- fly
expect 2 "mistyped command" "replya: no such command; did you mean 'replay'?" -- replya
expect 2 "no command" "expected a command" -- 
expect 2 "unknown option" "run: --sed: no such option; did you mean '--seed'?" -- \
  run "$work/bad.yaml" --sed 1
expect 2 "no threads" "--threads" "found 0" -- run "$work/bad.yaml" --threads 0
expect 2 "mistyped scenario" "did you mean 'occluded-camera'?" -- run ocluded-camera
expect 2 "mistyped key" "slam.featurs" "did you mean 'features'?" -- \
  run "$root/scenarios/quick-loop.yaml" --set slam.featurs.features=9

expect 0 "help" "run" "eval" -- --help
expect 0 "help of run" "--verify-determinism" "--set" -- run --help
expect 0 "help run" "--verify-determinism" "--set" -- help run
expect 0 "help bench slam" "DATASET" -- help bench slam
expect 0 "help of eval" "GROUNDTRUTH" -- eval --help
expect 0 "version" "vinebench" "MuJoCo" "OpenCV" "Ceres" -- --version

printf '%s 0 0 0 0 0 1\n' "0 0" "1 1" "2 2" "3 3" >"$work/truth.tum"
sed 's/^/# a comment\n/;' "$work/truth.tum" >"$work/same.tum"
expect 0 "eval of equals" "ate_rmse_m           0.000000000" "poses                4" -- \
  eval "$work/truth.tum" "$work/same.tum"
echo "5 1 2 3" >"$work/short.tum"
expect 2 "eval of a broken file" "short.tum:1: expected 8 columns" -- \
  eval "$work/truth.tum" "$work/short.tum"
sed 's/^/10/' "$work/truth.tum" >"$work/later.tum"
for command in "eval $work/truth.tum $work/same.tum" "list" "run --help" "--version"; do
  "$vinebench" $command >/dev/full 2>"$work/stderr"
  [[ $? -eq 2 ]] || report "$command on a full disk: expected exit code 2"
  [[ $(<"$work/stderr") == "vinebench: standard output: cannot be written"* ]] ||
    report "$command on a full disk: $(<"$work/stderr")"
done
expect 2 "eval of unrelated trajectories" "later.tum: fewer than three" -- \
  eval "$work/truth.tum" "$work/later.tum"

expect 0 "help of replay" "DATASET" "--groundtruth" "--rig" -- replay --help
mkdir -p "$work/empty" "$work/kitti/image_l" "$work/kitti/image_r" "$work/euroc/mav0/cam0"
expect 2 "replay of nothing" "none: expected a folder" -- replay "$work/none"
expect 2 "replay of an empty folder" "is not a recording: expected an EuRoC/ASL folder" "KITTI" -- \
  replay "$work/empty"
echo "20 0 15 0 0 20 11 0 0 0 1" >"$work/kitti/calib.txt"
expect 2 "replay with a short matrix" "calib.txt:1: expected 12 numbers" "found 11" -- \
  replay "$work/kitti" --out "$work/out"
printf '20 0 15 %s 0 20 11 0 0 0 1 0\n' 0 -10 >"$work/kitti/calib.txt"
expect 2 "replay without images" "image_l: expected images named by their number" -- \
  replay "$work/kitti" --out "$work/out"
expect 2 "replay of one camera" "expected a cam1 beside cam0" -- \
  replay "$work/euroc" --out "$work/out"
expect 2 "replay with a missing rig" "rig.yaml: neither a file nor the name of a rig" -- \
  replay "$work/kitti" --rig "$work/no/rig.yaml" --out "$work/out"
expect 2 "recording into a full folder" "is not empty; expected a new or an empty folder" -- \
  run "$root/scenarios/quick-loop.yaml" --out "$work/out" --record "$work/kitti"
expect 2 "one scenario twice" "two of the scenarios have the name 'quick-loop'" -- \
  run "$root/scenarios/quick-loop.yaml" "$root/scenarios/quick-loop.yaml" --out "$work/out"
expect 2 "seeds backwards" "5..1 runs backwards" -- \
  run "$root/scenarios/quick-loop.yaml" --seeds 5..1 --out "$work/out"
expect 2 "recording of a set" "--record: is for one scenario" -- \
  run "$root/scenarios/quick-loop.yaml" --seeds 1..2 --record "$work/set" --out "$work/out"
expect 2 "jobs of one run" "expected several scenarios or --seeds" -- \
  run "$root/scenarios/quick-loop.yaml" --jobs 2 --out "$work/out"
expect 2 "verdicts in a missing folder" "none/verdicts.xml: cannot be written" -- \
  run "$root/scenarios/quick-loop.yaml" --seeds 1..2 --out "$work/out" \
  --junit "$work/none/verdicts.xml"
expect 2 "comparison with nothing" "none: expected a folder of runs" -- \
  compare "$work/none" "$work/none"
expect 2 "comparison of no runs" "empty: contains no run" -- compare "$work/empty" "$work/empty"
mkdir -p "$work/a" "$work/b"
echo '{"scenario": "row", "seed": 1, "ate_rmse_m": 0.01}' >"$work/a/metrics.json"
echo '{"scenario": "row", "seed": 1, "ate_rmse_m": 0.02}' >"$work/b/metrics.json"
expect 0 "comparison" "row: B is unknown" "one pair" -- compare "$work/a" "$work/b"
sed -i 's/0.01}/0.01, "frames": 150}/' "$work/a/metrics.json"
sed -i 's/0.02}/0.02, "frames": 22}/' "$work/b/metrics.json"
expect 2 "comparison of other lengths" "A has 150 frames, B has 22" -- compare "$work/a" "$work/b"
sed -i 's/"seed": 1/"seed": 2/' "$work/b/metrics.json"
expect 2 "comparison of unrelated runs" "no scenario and seed is in both folders" -- \
  compare "$work/a" "$work/b"
expect 2 "bench of no data set" "is not a recording" -- bench slam "$work/empty"

echo junk >"$work/junk.map"
quick_loop=$root/scenarios/quick-loop.yaml
expect 2 "load of a file that is not a map" "junk.map: not a map of Vinebench" -- \
  run "$quick_loop" --out "$work/out" --load-map "$work/junk.map"
expect 2 "load of a missing map" "none.map" -- \
  run "$quick_loop" --out "$work/out" --load-map "$work/none.map"
expect 2 "save to a missing folder" "does not exist" -- \
  run "$quick_loop" --out "$work/out" --save-map "$work/none/row.map"

# A world without a block, and one place: some seconds.
world "ground_size: 20"
expect 0 "bench" "bad: 1 rows, 4 plants" "frame of 5 cameras" "memory" -- \
  bench render --world "$work/world.yaml" --rig "$root/models/csl-rover/rig.yaml" --frames 1 \
  --json "$work/bench.json"
for key in '"cpu_ms"' '"frame_wall_ms"' '"scaling"' '"memory_mib"'; do
  grep -qF "$key" "$work/bench.json" || report "bench: its JSON lacks $key"
done
expect 2 "bench of a missing world" "none.yaml" -- bench render --world "$work/none.yaml"

# Data by name, from any folder.
pushd "$work" >/dev/null || exit 1
expect 0 "list" "scenarios" "  occluded-camera " "  csl-vineyard " "  csl-rover " "  euroc " -- list
expect 0 "list of worlds" "Three short rows" -- list worlds
grep -q "occluded-camera" "$work/stdout" && report "list of worlds: lists scenarios too"
expect 2 "list of something else" "expected one of scenarios, worlds" -- list tractors
expect 2 "scenario by name" "output folder" -- run quick-loop --out "$work/file/out"
expect 0 "new world" "new.yaml" -- world new --rows 2 --length 3 --terrain even
expect 0 "a rover in a world" -- render world.yaml --pose -2,0,1,0 --camera 64x48@50 --rover 0,0,0,0 \
  --out rover.png
[[ -s rover.png ]] || report "a rover in a world: no image"
expect 2 "new world again" "new.yaml" -- world new
expect 2 "new world of no terrain" "expected one of" "found lunar" -- world other --terrain lunar
expect 0 "completion of commands" "replay" -- __complete -- re
expect 0 "completion of scenarios" "occluded-camera" -- __complete -- run oc

# Runs without OpenGL and plants: the fake renderer draws a walled court.
court=(--set renderer.engine=fake --set duration=1)
expect 0 "record" "15 frames" -- record quick-loop --format euroc,rgb --out recorded "${court[@]}" \
  --frames 0..14
expect 0 "check" "SOUND" -- check recorded
cp -r recorded interrupted
rm interrupted/frames.csv interrupted/files.xxh128
sed -i 's/^complete: true/complete: false/' interrupted/dataset.yaml
expect 0 "check of an interrupted data set" "INTERRUPTED, 0 of 15 frames: no frame to check" -- \
  check interrupted
expect 0 "replay" "frames" "results: " -- replay recorded --out replayed
expect 0 "bench slam" "% tracked" -- bench slam recorded --frames 12 --json slam.json
expect 0 "bench record" "pictures/hour" -- bench record --scenario quick-loop "${court[@]}" --frames 3
"$vinebench" run quick-loop "${court[@]}" --seeds 1..2 --jobs 2 --junit verdicts.xml --out set \
  >"$work/stdout" 2>"$work/stderr"
[[ $? -eq 1 ]] || report "set of runs: expected exit code 1, for a drive that ends too early"
grep -q '<testcase ' verdicts.xml || report "set of runs: verdicts.xml has no case"
grep -q 'quick-loop' set/table.md || report "set of runs: table.md lacks the scenario"
popd >/dev/null || exit 1

# Shell completion, as a shell would call it.
complete_in_bash() {
  PATH=$(dirname "$vinebench"):$PATH bash -c "
    source '$root/tools/completion/vinebench.bash'
    compopt() { :; }
    COMP_WORDS=($*) COMP_CWORD=\$((\${#COMP_WORDS[@]} - 1))
    _vinebench && printf '%s\n' \"\${COMPREPLY[@]}\""
}
[[ $(complete_in_bash vinebench ben) == bench ]] || report "completion in bash of a command"
complete_in_bash vinebench run --see | grep -qx -- --seeds || report "completion in bash of an option"
[[ $(cd "$work" && complete_in_bash vinebench run world.y) == world.yaml ]] ||
  report "completion in bash of a file"

if [[ $failures -ne 0 ]]; then
  echo "$failures failed"
  exit 1
fi

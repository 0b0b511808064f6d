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

expect 0 "realism of a set with itself" "31 of 31 medians inside" -- realism \
  worlds/photographs/side.json --ours "$root/worlds/photographs/side.json" --out "$work/realism"
expect 2 "realism without photographs" "nowhere: expected a folder of photographs" -- realism \
  nowhere --ours csl-vineyard --out "$work/realism"
expect 2 "realism fit of a world" "--fit: expected one scenario" -- realism \
  worlds/photographs/side.json --ours csl-vineyard --fit photographs --out "$work/realism"

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
expect 2 "guard of few seeds" "--seeds: expected at least 5 seeds, found 2" -- \
  guard "$root/scenarios/quick-loop.yaml" --seeds 1..2 --out "$work/guard"
printf '{base: %s, name: flow}\n' "$root/scenarios/quick-loop.yaml" >"$work/flow.yaml"
expect 2 "guard without a place" "flow.yaml: would be no scenario with a block 'guard:'" -- \
  guard "$work/flow.yaml" --write --out "$work/guard"
[ ! -e "$work/guard" ] || report "guard without a place: has run"
expect 2 "verdicts in a missing folder" "none/verdicts.xml: cannot be written" -- \
  run "$root/scenarios/quick-loop.yaml" --seeds 1..2 --out "$work/out" \
  --junit "$work/none/verdicts.xml"
expect 2 "comparison with nothing" "none: expected a folder of runs" -- \
  compare "$work/none" "$work/none"
expect 2 "comparison of no runs" "empty: contains no run" -- compare "$work/empty" "$work/empty"
mkdir -p "$work/a" "$work/b"
echo '{"scenario": "row", "seed": 1, "ate_rmse_m": 0.01}' >"$work/a/metrics.json"
echo '{"scenario": "row", "seed": 1, "ate_rmse_m": 0.02}' >"$work/b/metrics.json"
expect 0 "comparison" "row: cannot tell yet" "at least 1 more seed" -- compare "$work/a" "$work/b"
expect 2 "margin of no metric" "metric 'ate_rmse': " "did you mean 'ate_rmse_m'" -- \
  compare "$work/a" "$work/b" --margin ate_rmse=5%
expect 2 "margin without a unit" "--margin: expected a percentage" -- \
  compare "$work/a" "$work/b" --margin 5
expect 2 "alpha of no test" "at least 1e-06 and at most 0.5, found 0" -- compare "$work/a" "$work/b" --alpha 0
mkdir -p "$work/a3/2" "$work/a3/3" "$work/b3/2" "$work/b3/3"
for seed in 2 3; do
  echo "{\"scenario\": \"row\", \"seed\": $seed, \"ate_rmse_m\": 0.0$seed}" >"$work/a3/$seed/metrics.json"
  echo "{\"scenario\": \"row\", \"seed\": $seed, \"ate_rmse_m\": 0.0${seed}0$seed}" >"$work/b3/$seed/metrics.json"
done
expect 0 "comparison of two seeds" "row: B is equal to A within the margins" "| +1" -- \
  compare "$work/a3" "$work/b3" --margin ate_rmse_m=20% --json "$work/compared.json"
grep -q '"adjusted_p_equivalence"' "$work/compared.json" || report "comparison: no p-values as JSON"
expect 0 "plan by one system" "| ATE, mm |" "usually an upper bound" -- plan "$work/a3" --detect 10%
expect 0 "plan by two systems" "| ATE, mm |" -- \
  plan "$work/a3" "$work/b3" --detect ate_rmse_m=1 --metric ate_rmse_m --power 0.9
expect 2 "plan by one seed" "a: expected runs of at least two seeds of a scenario" -- plan "$work/a" --detect 10%
expect 2 "plan without a change" "--detect is required" -- plan "$work/a3"
expect 2 "plan of nothing" "none: expected a folder of runs" -- plan "$work/none" --detect 10%
expect 2 "repeats of a recording" "--record: is for one scenario" -- \
  run "$root/scenarios/quick-loop.yaml" --repeats 2 --record "$work/set" --out "$work/out"
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
expect 0 "reference" "world.sun.elevation_deg " "number, default 50; -12 to 90" -- reference
expect 0 "reference of a rig" "cameras.N.distortion " "any number of numbers" -- reference rig cameras
grep -q "stereo_pairs" "$work/stdout" && report "reference of a rig: has other keys too"
expect 0 "reference as JSON" '"own_key": "elevation_deg"' '"--verify-determinism"' -- reference --json
expect 2 "reference of no key" "scenario: has no key world.son" -- reference scenario world.son
expect 2 "scenario by name" "output folder" -- run quick-loop --out "$work/file/out"
expect 0 "new world" "new.yaml" -- world new --rows 2 --length 3 --terrain even
expect 0 "a rover in a world" -- render world.yaml --pose -2,0,1,0 --camera 64x48@50 --rover 0,0,0,0 \
  --out rover.png
[[ -s rover.png ]] || report "a rover in a world: no image"
expect 2 "new world again" "new.yaml" -- world new
expect 2 "new world of no terrain" "expected one of" "found lunar" -- world other --terrain lunar
expect 0 "completion of commands" "replay" -- __complete -- re
expect 0 "completion of scenarios" "occluded-camera" -- __complete -- run oc

# A mesh of another tool: what is not drawn of it is said once, however often it is read.
printf '%s\n' "v 0 0 0" "v 0.1 0 0" "v 0 0 1" "usemtl Bark" "f 1 2 3" >"$work/vine.obj"
meshes() {
  world "vines: {meshes: [vine.obj, vine.obj], mesh_import: {labels: {$1}}}"
}
view=(render "$work/world.yaml" --camera 64x48@30 --pose 2,-2,1,90 --out "$work/view.png")
meshes "Bark: trunk"
expect 0 "render of a mesh" -- "${view[@]}"
[[ $(grep -c "^vinebench: warning: $work/vine.obj: normals are computed" "$work/stderr") -eq 1 ]] ||
  report "render of a mesh: expected one warning"
meshes "Brak: trunk"
expect 2 "mistyped material" "vines.mesh_import.labels.Brak" "did you mean 'Bark'?" -- "${view[@]}"
meshes "Bark: trnk"
expect 2 "mistyped label" "world.yaml:3: vines.mesh_import.labels.Bark" "did you mean 'trunk'?" -- \
  "${view[@]}"

# Runs without OpenGL and plants: the fake renderer draws a walled court.
court=(--set renderer.engine=fake --set duration=1)
moment=(--set renderer.engine=fake --set duration=0.3)

expect 0 "place-tags" "planned                   3 tags" "own" -- place-tags typical-vineyard \
  --route typical-one-tag --budget 3 --out planned
[[ $(wc -l <planned/tags.csv) -eq 4 && -s planned/plan.svg ]] || report "place-tags: no list or picture"
expect 0 "a planned world" -- render "$PWD/planned/world.yaml" --set vines.templates=1 --set vines.bbch=0 \
  --camera 32x24@20 --pose 0,0,1,0 --out planned.png
expect 1 "place-tags, not to be kept" "with all places that are seen" -- place-tags typical-vineyard --route typical-one-tag \
  --error 0.001 --out planned
expect 0 "place-camera" "as it is" "mountings of 'side'" -- place-camera typical-vineyard --route typical-one-tag \
  --yaw-step 90 --out mounted
[[ -s mounted/rig.yaml && $(wc -l <mounted/mounts.csv) -eq 37 ]] || report "place-camera: no rig or list"
expect 2 "place-camera, mistyped camera" "did you mean 'side'" -- place-camera typical-vineyard \
  --route typical-one-tag --camera sid
expect 2 "place-tags without a route" "--route" -- place-tags typical-vineyard

# Searches. In a court without tags a scenario fails as it is; two runs lose no frame.
printf 'difficulties:\n  - {name: speed, between: {route.speed: [0.5, 1]}}\n  - {name: gap, between: {sensors.drops.frame_rate: [0, 0.9]}}\n' >space.yaml
search=(search quick-loop --space space.yaml "${moment[@]}" --proof 0)
expect 0 "search" "Found: as it is, after 1 runs" -- "${search[@]}" --budget 1 --out searched
[[ -s searched/search.md && -s searched/counter-example.yaml ]] || report "search: no report or scenario"
expect 1 "search that finds nothing" -- "${search[@]}" --find losses_max --budget 1 --out searched
grep -q "nothing breaks it within 1 runs" "$work/stdout" || report "search that finds nothing: does not say so"
[[ $(wc -l <searched/runs.csv) -eq 2 ]] || report "search: expected a line for each run"
expect 0 "search, a map" "map.svg and map.csv" -- "${search[@]}" --map speed --map gap --map-size 2 --budget 1 --out searched
[[ $(wc -l <searched/map.csv) -eq 5 ]] || report "search: a map of four cells"
expect 0 "search, a shard" "shard 1/3: 1 runs" -- "${search[@]}" --shard 1/3 --out searched
expect 2 "search for another scenario's bound" "did you mean 'losses_max'" -- "${search[@]}" --find losses_mx
expect 2 "search, mistyped difficulty" "did you mean 'speed'" -- "${search[@]}" --map sped --map gap
sed 's/0.5, 1/0.5, -1/' space.yaml >impossible.yaml
expect 2 "search, impossible values" "difficulty 'speed', severity 1: " -- search quick-loop --space impossible.yaml

# Other SLAM systems, and scenarios that are not trusted.
printf '#!/bin/sh\n[ "$(wc -l <"$1/frames.csv")" -gt 1 ] && kill -SEGV $$\n' >crashes.sh
chmod +x crashes.sh
expect 1 "crash of a program" -- run quick-loop "${court[@]}" --out crashed \
  --set slam.external.program=crashes.sh
grep -q 'FAILED' "$work/stdout" || report "crash of a program: no verdict"
grep -q 'crashes.sh: ended by signal 11' crashed/metrics.json || report "crash of a program: no cause"
chmod -x crashes.sh
expect 2 "program that is not executable" "crashes.sh: cannot be started: Permission denied" -- \
  run quick-loop "${court[@]}" --out crashed --set slam.external.program=crashes.sh
expect 2 "trajectory elsewhere" "slam.external.trajectory: expected a file in" -- \
  run quick-loop "${court[@]}" --out crashed --set slam.external.program=crashes.sh \
  --set slam.external.trajectory=/tmp/poses.txt
expect 2 "no plug-in" "slam.plugin.library: " "crashes.sh" -- \
  run quick-loop "${court[@]}" --out crashed --set slam.plugin.library=crashes.sh
cat >space.yaml <<'END'
difficulties:
  - {name: low sun, between: {world.sun.elevation_deg: [50, 4]}}
END
for command in "run quick-loop --out untrusted" "run quick-loop --seeds 1..2 --out untrusted" \
  "record quick-loop --format rgb --out untrusted" "bench record --scenario quick-loop" \
  "bench slam --scenario quick-loop" "search quick-loop --space space.yaml --out untrusted"; do
  # shellcheck disable=SC2086
  expect 2 "untrusted plug-in, $command" "slam.plugin: is code" -- $command "${court[@]}" \
    --untrusted --set slam.plugin.library=crashes.sh
  # shellcheck disable=SC2086
  expect 2 "untrusted program, $command" "slam.external: is a program" -- $command "${court[@]}" \
    --untrusted --set slam.external.program=crashes.sh
  # shellcheck disable=SC2086
  expect 2 "untrusted file, $command" "names /etc/passwd" -- $command "${court[@]}" \
    --untrusted --set world.vines.cultivar=/etc/passwd
done
[[ ! -e untrusted ]] || report "untrusted scenarios: leave a folder"
expect 0 "untrusted record" "3 frames" -- record quick-loop --format rgb --out untrusted \
  "${court[@]}" --frames 0..2 --untrusted
expect 0 "record" "15 frames" -- record quick-loop --format euroc,rgb --out recorded "${court[@]}" \
  --frames 0..14
expect 0 "check" "SOUND" -- check recorded
cp -r recorded interrupted
rm interrupted/frames.csv interrupted/files.xxh128
sed -i 's/^complete: true/complete: false/' interrupted/dataset.yaml
expect 0 "check of an interrupted data set" "INTERRUPTED, 0 of 15 frames: no frame to check" -- \
  check interrupted
expect 0 "replay" "frames" "results: " -- replay recorded --out replayed --untrusted
expect 2 "untrusted program, replay" "slam.external: is a program" -- replay recorded \
  --out replayed --untrusted --set slam.external.program=/bin/true
expect 1 "replay with a program that fails" -- replay recorded \
  --out replayed --set slam.external.program=/bin/false
expect 0 "bench slam" "% tracked" -- bench slam recorded --frames 12 --json slam.json
expect 0 "bench record" "pictures/hour" -- bench record --scenario quick-loop "${court[@]}" --frames 2
"$vinebench" run quick-loop "${moment[@]}" --seeds 1..2 --jobs 2 --junit verdicts.xml --out set \
  >"$work/stdout" 2>"$work/stderr"
[[ $? -eq 1 ]] || report "set of runs: expected exit code 1, for a drive that ends too early"
grep -q '<testcase ' verdicts.xml || report "set of runs: verdicts.xml has no case"
grep -q 'quick-loop' set/table.md || report "set of runs: table.md lacks the scenario"

"$vinebench" run quick-loop "${moment[@]}" --seeds 1..2 --repeats 2 --jobs 2 --junit verdicts.xml \
  --out set >"$work/stdout" 2>"$work/stderr"
[[ $? -eq 1 ]] || report "set with repeats: expected exit code 1"
grep -q 'seed 1, repeat 1: FAILED (kept)' "$work/stderr" || report "set with repeats: a run is not kept"
grep -q 'repeats of 2 seeds: repeats agree by hash' "$work/stdout" || report "set with repeats: no hash"
grep -q 'seed 2: broken, 2 of 2 repeats fail' "$work/stdout" || report "set with repeats: not broken"
grep -q 'name="seed-2/repeat-2"' verdicts.xml || report "set with repeats: verdicts.xml lacks a repeat"
expect 0 "comparison of repeats" "all runs are the same to the byte" "A: quick-loop, repeats of 2" -- \
  compare set set

# Caches: those of other users and of nobody, and several processes that fill one at once.
view=(render csl-vineyard --set vines.templates=1 --set vines.bbch=0 --camera 32x24@20 --pose 0,0,1,0)
expect_notices() { # expect_notices COUNT NAME
  local got
  got=$(grep -c 'plants are not kept' "$work/stderr")
  [[ $got -eq $1 ]] || report "$2: $got notices, expected $1"
}
expect 0 "render with a cache" -- "${view[@]}" --out kept.png --cache plants
expect_notices 0 "render with a cache"
[[ -n $(ls plants/*.glb) ]] || report "render with a cache: nothing is kept"
[[ $(stat -c %a plants) == 700 ]] || report "render with a cache: the folder is not private"
for cache in "$work/file" "$work/file/below" /proc/none; do
  expect 0 "render with the cache $cache" -- "${view[@]}" --out unkept.png --cache "$cache"
  expect_notices 1 "render with the cache $cache"
  cmp -s kept.png unkept.png || report "render with the cache $cache: another image"
done
bare=(--set world.vines.templates=1 --set world.vines.bbch=0)
VINEBENCH_CACHE=/proc/none expect 0 "a recording of two seeds without a cache" -- \
  record quick-loop --format tum --out uncached --seeds 1..2 --frames 0..1 "${moment[@]}" "${bare[@]}"
expect_notices 1 "a recording of two seeds without a cache"
"$vinebench" run quick-loop "${moment[@]}" "${bare[@]}" --seeds 1..2 --jobs 2 --out uncached_set \
  --cache /proc/none >"$work/stdout" 2>"$work/stderr"
[[ -s uncached_set/table.md ]] || report "a set without a cache: no table"
expect_notices 1 "a set without a cache"
mkdir tmp theirs && chmod 1777 tmp
planted=$PWD/tmp/vinebench-cache-$(id -u)
ln -s "$PWD/theirs" "$planted"
unset_home=(env -u HOME -u XDG_CACHE_HOME -u VINEBENCH_CACHE TMPDIR="$PWD/tmp")
"${unset_home[@]}" "$vinebench" "${view[@]}" --out unkept.png >"$work/stdout" 2>"$work/stderr" ||
  report "a planted cache: exit code $?"
expect_notices 1 "a planted cache"
[[ -z $(ls theirs) ]] || report "a planted cache: its link was followed"
rm "$planted"
"${unset_home[@]}" "$vinebench" "${view[@]}" --out unkept.png >"$work/stdout" 2>"$work/stderr"
expect_notices 0 "the cache of a user without a home"
[[ $(stat -c %a "$planted") == 700 ]] || report "the cache of a user without a home: is not private"

processes=()
for i in 1 2 3 4; do
  "$vinebench" "${view[@]}" --out "at_once_$i.png" --cache at_once >"at_once_$i.txt" 2>&1 &
  processes+=($!)
done
for i in 1 2 3 4; do
  wait "${processes[i - 1]}" || report "process $i of several that fill a cache: exit code $?"
  [[ -s at_once_$i.txt ]] && report "process $i of several that fill a cache: $(cat at_once_$i.txt)"
  cmp -s kept.png "at_once_$i.png" || report "process $i of several that fill a cache: another image"
done
[[ -z $(find at_once -name '*.partial') ]] || report "several that fill a cache: temporary files stay"

# Folders in use. flock(1) holds them as another process would.
in_use() { # in_use NAME FOLDER ARGUMENTS...
  local name=$1 folder=$2 before
  shift 2
  mkdir -p "$folder"
  before=$(ls -A "$folder")
  exec 9<"$folder"
  flock 9
  expect 2 "$name" "another process is writing there" -- "$@"
  [[ $(ls -A "$folder") == "$before" ]] || report "$name: the folder has changed"
  exec 9<&-
}
in_use "run into a folder in use" busy run quick-loop "${court[@]}" --out busy
in_use "set into a folder in use" busy run quick-loop "${court[@]}" --seeds 1..2 --out busy
in_use "record into a folder in use" busy record quick-loop --format tum --out busy "${court[@]}"
in_use "run with a recording in use" busy run quick-loop "${court[@]}" --out free --record busy
in_use "replay into a folder in use" busy replay recorded --out busy
"$vinebench" run quick-loop --set renderer.engine=fake --out busy >/dev/null 2>&1 &
first=$!
for _ in {1..100}; do [[ -d busy/frames ]] && break || sleep 0.1; done
expect 2 "two runs into one folder" "another process is writing there" -- \
  run quick-loop "${court[@]}" --out busy
kill -KILL $first
wait $first 2>/dev/null
expect 0 "replay after a killed run" "results: " -- replay recorded --out busy
popd >/dev/null || exit 1

# What is no file is neither waited for nor read without end.
mkfifo "$work/pipe"
ln -s /dev/zero "$work/zeros"
ln -s loop "$work/loop"
for special in pipe zeros; do
  expect 2 "eval of $special" "$special: expected a regular file" -- \
    eval "$work/$special" "$work/truth.tum"
  expect 2 "map from $special" "$special: expected a regular file" -- \
    replay "$work/recorded" --out "$work/replayed" --load-map "$work/$special"
  expect 2 "settings from $special" "$special: expected a regular file" -- \
    replay "$work/recorded" --out "$work/replayed" --slam "$work/$special"
  expect 2 "scenario from $special" "neither a file nor the name of a scenario" -- run "$work/$special"
  cp -r "$work/recorded" "$work/with-$special"
  rm "$work/with-$special/euroc/rig.yaml"
  cp -a "$work/$special" "$work/with-$special/euroc/rig.yaml"
  expect 2 "rig from $special" "rig.yaml: expected a regular file" -- \
    replay "$work/with-$special" --out "$work/replayed"
done
expect 2 "map in a loop of links" "loop" -- \
  replay "$work/recorded" --out "$work/replayed" --save-map "$work/loop/row.map"
echo "world: [1" >"$work/recorded/scenario.resolved.yaml"
expect 2 "check of a damaged scenario" "scenario.resolved.yaml:2: is not valid YAML" -- \
  check "$work/recorded"

# Names that are not UTF-8: the finished runs are kept, and reported with U+FFFD.
odd=$(printf 'odd\xff')
cp -r "$work/recorded/euroc" "$work/$odd"
expect 0 "replay with an odd name" "frames" -- replay "$work/$odd" --out "$work/$odd/out"
grep -qF $'"scenario": "odd\xef\xbf\xbd"' "$work/$odd/out/metrics.json" ||
  report "replay with an odd name: not in metrics.json"
"$vinebench" run "$quick_loop" "${moment[@]}" --seeds 1..1 --out "$work/$odd/set" >"$work/stdout" \
  2>"$work/stderr"
[[ $? -eq 1 ]] || report "set of runs with an odd name: expected exit code 1"
grep -qF $'odd\xef\xbf\xbd/set/quick-loop/seed-1' "$work/$odd/set/summary.json" ||
  report "set of runs with an odd name: not in summary.json"

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

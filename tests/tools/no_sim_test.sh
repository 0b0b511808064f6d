#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# The program of a build without the simulation: it needs none of its libraries, replays and judges
# a recording, and refuses in one line what it cannot do.
# Usage: no_sim_test.sh VINEBENCH WALL_RECORDING
set -euo pipefail
vinebench=$1
wall_recording=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "FAILED: $1"
  exit 1
}

if ldd "$vinebench" | grep -iE 'mujoco|osmesa|libEGL|assimp|tinygltf'; then
  fail "needs a library of the simulation"
fi
"$vinebench" --version | grep -q '^vinebench ' || fail "--version"

# The wall is exact to the pixel: a tenth of a pixel is 1 mm at its 2 m.
"$wall_recording" "$work/wall"
"$vinebench" replay "$work/wall" --out "$work/out" >"$work/stdout" 2>/dev/null
python3 - "$work/out/metrics.json" <<'EOF'
import json, sys
metrics = json.load(open(sys.argv[1]))
assert metrics["frames"] == 12, metrics["frames"]
assert metrics["coverage"] == 1, metrics["coverage"]
assert metrics["ate_rmse_m"] < 1e-3, metrics["ate_rmse_m"]
EOF
"$vinebench" eval "$work/out/groundtruth.tum" "$work/out/estimate.tum" | grep -q '^poses *12$' ||
  fail "eval"
"$vinebench" compare "$work/out" "$work/out" >"$work/stdout" || fail "compare"
"$vinebench" bench slam "$work/wall" --frames 12 >"$work/stdout" || fail "bench slam"

for command in run record render world "bench render" "bench record" "bench slam"; do
  # shellcheck disable=SC2086
  "$vinebench" $command $([[ $command == "bench slam" ]] || echo some.yaml --out there) \
    >"$work/stdout" 2>"$work/stderr" && fail "$command: expected an error"
  [[ $(wc -l <"$work/stderr") -eq 1 ]] || fail "$command: expected one line of error"
  grep -q 'this build has no simulation' "$work/stderr" || fail "$command: $(cat "$work/stderr")"
done
echo "all is well"

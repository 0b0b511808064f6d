#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# The same hash on every processor: libraries are told that this one has less than it has. Eight frames
# of quick-loop, from plants that each run grows anew. Usage: same_bytes_test.sh VINEBENCH ROOT WORK
set -euo pipefail
vinebench=$1 root=$2 work=$3

# shellcheck source=tests/tools/masks.sh
source "$(dirname "$0")/masks.sh"

# A value of the run's metrics.json.
metric() { sed -nE "s/^ *\"$2\": \"?([^\",]*)\"?,?\$/\1/p" "$work/$1/metrics.json"; }

run() {
  local name=$1 code=0
  shift
  rm -rf "$work/cache"
  mkdir -p "$work/cache"
  env "$@" VINEBENCH_CACHE="$work/cache" MESA_SHADER_CACHE_DIR="$work/cache" \
    "$vinebench" run "$root/scenarios/quick-loop.yaml" --out "$work/$name" --set duration=0.5 \
    --set world.vines.templates=2 >"$work/$name.log" 2>&1 || code=$?
  [[ $code -le 1 ]] || { cat "$work/$name.log"; exit $code; }  # too short for its expectations
}

mkdir -p "$work"
run plain VINEBENCH_GL=osmesa
failed=0
for mask in glibc opencv mesa all; do
  case $mask in
    all) settings=("$glibc" "$opencv" "$mesa") ;;
    *) settings=("${!mask}") ;;
  esac
  run "$mask" VINEBENCH_GL=osmesa "${settings[@]}"
  echo "$mask: $(metric "$mask" hash), without a mask $(metric plain hash)"
  [[ -n $(metric plain hash) && $(metric plain hash) == "$(metric "$mask" hash)" ]] || failed=1
done
# What stands beside the hash says that nothing is chosen by the processor.
for name in libm opencv shaders; do
  value=$(metric plain $name)
  echo "$name: $value"
  [[ -n $value && $value != *" for "* && $value != "for "* ]] || failed=1
done
exit $failed

#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# Sequences of Vinebench-100, drawn at random, are made on what seems to be an older processor, from
# plants that are grown anew, and must have the hashes of the recipe. Minutes, and no test of ctest.
# Usage: masked_sequences.sh VINEBENCH ROOT [COUNT [SEED]]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
vinebench=$(realpath "$1")
recipe=$(realpath "$2")/collections/vinebench-100.yaml
count=${3:-10}
seed=${4:-1}
# shellcheck source=tests/tools/masks.sh
source "$here/masks.sh"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
names=$("$vinebench" dataset "$recipe" --list | awk '{print $1}' |
  python3 -c 'import random, sys; names = sys.stdin.read().split(); print(",".join(random.Random(int(sys.argv[2])).sample(names, int(sys.argv[1]))))' "$count" "$seed")
echo "made with ${glibc%%=*}, ${opencv%%=*} and ${mesa%%=*}: $names"
env "$glibc" "$opencv" "$mesa" VINEBENCH_GL=osmesa VINEBENCH_CACHE="$work/cache" MESA_SHADER_CACHE_DIR="$work/cache" \
  "$vinebench" dataset "$recipe" --only "$names" --out "$work/made" 2>"$work/log.txt" || { tail -n 5 "$work/log.txt"; exit 1; }
echo "masked_sequences: passed"

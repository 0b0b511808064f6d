#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# A right camera that exposes 35 ms late is named as the cause of the drift; a run that cannot be
# repeated is refused.
# Usage: explain_test.sh VINEBENCH SOURCE_DIR
set -euo pipefail
vinebench=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$vinebench" run "$source/tests/planted_causes/drive.yaml" --out "$work/run" --threads 1 \
  --set 'sensors.timing.triggers=[{camera: right, delay: 0.035}]' > "$work/run.txt" 2>&1
"$vinebench" explain "$work/run" --from 2.0 --lead 0.6 --threads 2 > "$work/text" 2> "$work/log"
cat "$work/text"
grep -q '^stretch 1, 2.00 to 3.47 s: caused by cameras that expose at other times' "$work/text"
grep -q '"cause": true' "$work/run/explanation.json"

# Another pose in the file than the repetition's.
sed -i '20s/ [-0-9.]* / 9.000000000 /' "$work/run/estimate_live.tum"
code=0
"$vinebench" explain "$work/run" --from 2.0 --lead 0.6 > /dev/null 2> "$work/log" || code=$?
if [ "$code" != 2 ] || ! grep -q 'cannot be repeated here' "$work/log"; then
  cat "$work/log"
  echo "expected a refusal with exit code 2, found $code"
  exit 1
fi

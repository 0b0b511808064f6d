#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# A sweep in parts has the table of one run, also where a part was killed; what does not belong
# together is refused with one message.
# Usage: sweep_test.sh VINEBENCH
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
vinebench=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
# shellcheck source=tests/tools/expect.sh
source "$here/expect.sh"

cat >spec.yaml <<'EOF'
scenarios: [quick-loop, aisle-loop]
seeds: 1..3
set: {renderer.engine: fake, duration: 0.3}
EOF
expect 0 "plan" '{"sweep_plan":1,' -- sweep plan spec.yaml
mv stdout plan.jsonl
[[ $(wc -l <plan.jsonl) -eq 7 ]] || report "plan: expected a line and six tasks"

touch code.so
sed 's/duration: 0.3/slam.plugin.library: code.so/' spec.yaml >code.yaml
"$vinebench" sweep plan code.yaml >code.jsonl 2>/dev/null
expect 2 "untrusted" "slam.plugin: is code" -- sweep run code.jsonl --untrusted --out untrusted
[[ ! -e untrusted ]] || report "untrusted: leaves a folder"

# In one go; the drives end too early for their expectations.
fake=(--set renderer.engine=fake --set duration=0.3)
"$vinebench" run quick-loop aisle-loop --seeds 1..3 --jobs 2 "${fake[@]}" --out whole >stdout 2>stderr
[[ $? -eq 1 ]] || report "run: expected exit code 1"

# In two parts in two folders, one of which is killed at its second run.
expect 0 "first shard" "shard 1/2: 3 of 3 runs are whole in part1" -- \
  sweep run plan.jsonl --shard 1/2 --out part1
"$vinebench" sweep run plan.jsonl --shard 2/2 --out part2 >stdout 2>stderr </dev/null &
shard=$!
for _ in $(seq 600); do
  [[ -z $(find part2 -name metrics.json 2>/dev/null) ]] || break
  sleep 0.05
done
kill -9 $shard
wait $shard 2>/dev/null
expect 2 "merge of a part" "of 6 runs are missing:" -- sweep merge plan.jsonl part2 part1 --out merged
expect 0 "second shard again" "shard 2/2: 3 of 3 runs are whole in part2" -- \
  sweep run plan.jsonl --shard 2/2 --out part2
grep -q '(kept)' stderr || report "second shard again: nothing was kept"
expect 1 "merge" "6 runs: 0 passed, 6 failed, 0 missing" -- \
  sweep merge plan.jsonl part2 part1 --out merged
cmp merged/table.md whole/table.md || report "merge: another table than that of run"
[[ $(wc -l <merged/results.csv) -eq 7 ]] || report "merge: results.csv has not a row for each run"
expect 0 "more shards than runs" "shard 9/9: 0 of 0" -- sweep run plan.jsonl --shard 9/9 --out part1

# Bad input.
expect 2 "no specification" "spec.yml" -- sweep plan spec.yml
echo "scenarios: [quick-lop]" >typo.yaml
expect 2 "no scenario" "quick-lop" -- sweep plan typo.yaml
echo "scenarios: [quick-loop]
set: {slam.trakcing.radius: 3}" >key.yaml
expect 2 "no key" "slam.trakcing" -- sweep plan key.yaml
expect 2 "no shard" "expected I/N" -- sweep run plan.jsonl --shard 3/2
expect 2 "no plan" "spec.yaml:1: expected a line of a plan" -- sweep run spec.yaml
head -n 4 plan.jsonl >cut.jsonl
expect 2 "a part of a plan" "expected 6 tasks, found 3" -- sweep merge cut.jsonl part1
sed '1s/"version":"[^"]*"/"version":"0.0.1"/' plan.jsonl >old.jsonl
expect 2 "a plan of another version" "another build" -- sweep run old.jsonl --out other
sed 's/duration=0.3/duration=0.4/' plan.jsonl >changed.jsonl
expect 2 "a changed plan" "is not what it was" -- sweep run changed.jsonl --out other
[[ ! -e other ]] || report "a refused plan: leaves a folder"
expect 2 "no folder" "none: expected a folder" -- sweep merge plan.jsonl none
first=$(find part1 -name inputs.txt | sort | head -n 1)
cp "$first" inputs
echo 0 >"$first"
expect 2 "other inputs" "a result of other inputs" -- sweep merge plan.jsonl part1 part2 --out merged
cp inputs "$first"
sed -i '/^ *"hash":/d' "$(dirname "$first")/metrics.json"
expect 2 "no hash" "has no hash" -- sweep merge plan.jsonl part1 part2 --out merged
cmp merged/table.md whole/table.md || report "a refused merge: changes the table"

[[ $failures -eq 0 ]] && echo "sweep: passed"
exit $((failures > 0))

#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# Two nodes share folders over a file system on which a lock of one is none for the other, as NFS is
# without a lock service: the same folder, mounted twice by bindfs. Both grow the first plants of a
# shared cache at once, while others are killed; then both make the same shard of a sweep into the same
# folder at once. Needs tools/setup.sh --cluster and /dev/fuse. Usage: shared_folder_test.sh VINEBENCH ROOT
set -uo pipefail
vinebench=$1
root=$2

command -v bindfs >/dev/null || { echo "skipped: no bindfs (tools/setup.sh --cluster)"; exit 77; }
work=$(mktemp -d)
trap 'umount -l "$work/a" "$work/b" 2>/dev/null; rm -rf "$work"' EXIT
fail() {
  echo "FAILED: $1"
  tail -n 5 "$work"/*.log 2>/dev/null
  exit 1
}
mkdir "$work"/{real,a,b}
for node in a b; do
  bindfs "$work/real" "$work/$node" 2>"$work/mount.log" || { echo "skipped: $(cat "$work/mount.log")"; exit 77; }
done
flock -n "$work/a/lock" -c "flock -n $work/b/lock -c true" || fail "the nodes see each other's locks: nothing is tested"

# --- a cache ---
world=$root/worlds/csl-vineyard.yaml
view=(render "$world" --set vines.templates=1 --camera 48x32@20 --pose 2,-2,1,90)
VINEBENCH_CACHE=$work/alone "$vinebench" "${view[@]}" --out "$work/alone.png" >"$work/alone.log" 2>&1 || fail "render"
for round in 1 2; do
  for node in a b; do
    # Killed as it grows or writes, or after.
    VINEBENCH_CACHE=$work/$node/cache timeout -s KILL "0.$((RANDOM % 9 + 1))" "$vinebench" "${view[@]}" \
      --out "$work/killed.png" >/dev/null 2>&1 &
    VINEBENCH_CACHE=$work/$node/cache "$vinebench" "${view[@]}" --out "$work/$node-$round.png" >"$work/$node.log" 2>&1 &
  done
  wait
  for node in a b; do
    cmp "$work/alone.png" "$work/$node-$round.png" || fail "node $node, round $round: another picture"
  done
done
kept() { (cd "$1" && find . -type f ! -name '*.tmp*' -exec sha256sum {} + | sort); }
[[ -n $(kept "$work/alone") ]] || fail "nothing is kept in a cache"
missing=$(comm -23 <(kept "$work/alone") <(kept "$work/real/cache"))
[[ -z $missing ]] || fail "files of the cache are missing or differ: $missing"

# --- one shard, twice at once ---
cd "$work" || exit 1
cat >spec.yaml <<EOF
scenarios: [quick-loop]
seeds: 1..3
set: {renderer.engine: fake, duration: 0.3}
EOF
"$vinebench" sweep plan spec.yaml --out plan.jsonl 2>plan.log || fail "plan"
for node in a b; do
  "$vinebench" sweep run plan.jsonl --out "$work/$node/results" >"$node.log" 2>&1 &
done
wait
"$vinebench" sweep run plan.jsonl --out "$work/a/results" >again.log 2>&1 || fail "the shard, once more"
"$vinebench" sweep merge plan.jsonl "$work/b/results" --out merged >merge.log 2>&1
[[ $? -le 1 ]] || fail "merge"
"$vinebench" run quick-loop --seeds 1..3 --set renderer.engine=fake --set duration=0.3 --out whole >whole.log 2>&1
cmp merged/table.md whole/table.md || fail "another table than that of a run in one go"
echo "shared folder: passed"

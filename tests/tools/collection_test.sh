#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# A data set from its recipe: made, found to be the same, found to be another; seeds that are sealed.
# Usage: collection_test.sh VINEBENCH ROOT
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
vinebench=$1
root=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
# shellcheck source=tests/tools/expect.sh
source "$here/expect.sh"

cp "$root/scenarios/quick-loop.yaml" own.yaml
sed -i "s#: \.\./#: $root/#" own.yaml
cat >recipe.yaml <<'EOF'
# Ours.
name: two
formats: [tum]
set: {renderer.engine: fake, duration: 0.2}
sequences:
  - {name: first, scenario: quick-loop, seed: 3}
  - {name: second, split: test, scenario: own.yaml, seed: 4}
EOF
expect 0 "list" "second                   test" -- dataset recipe.yaml --list
expect 0 "make" "2 sequences: 2 new" -- dataset recipe.yaml --out made --jobs 2 --write
grep -q '^# Ours' recipe.yaml || report "make: the comment is gone"
[[ $(grep -c 'frames_xxh128: "[0-9a-f]\{32\}"' recipe.yaml) -eq 2 ]] || report "make: no hashes"
expect 0 "again" "1 sequences: 1 the same frames" -- dataset recipe.yaml --out again --split test --format euroc
[[ -e again/test/second/euroc/mav0 && ! -e again/train ]] || report "again: another split or format"
"$vinebench" check made/train/first >stdout 2>stderr || report "check: a sequence is not sound"

sed 's/seed: 3/seed: 5/' recipe.yaml >other.yaml
expect 1 "another seed" "1 DIFFERENT frames" -- dataset other.yaml --out other --only first
expect 2 "no sequence" "there is no sequence third" -- dataset recipe.yaml --only third
expect 2 "no recipe" "own.yaml" -- dataset own.yaml

expect 0 "seal" "1 seeds are in secrets.yaml alone" -- dataset recipe.yaml --split test --seal secrets.yaml
grep -q 'seed: 4' recipe.yaml && report "seal: the seed is still there"
expect 2 "sealed" "its seed is secret" -- dataset recipe.yaml --out sealed --split test
expect 2 "sealed twice" "exists" -- dataset recipe.yaml --split train --seal secrets.yaml
expect 0 "opened" "1 sequences: 1 the same frames" -- dataset recipe.yaml --out opened --split test \
  --secrets secrets.yaml
sed -i 's/4$/6/' secrets.yaml
expect 2 "another secret" "is not the one that was committed to" -- dataset recipe.yaml --out opened \
  --secrets secrets.yaml

"$vinebench" dataset "$root/collections/vinebench-100.yaml" --list >stdout 2>stderr
[[ $(wc -l <stdout) -eq 100 ]] || report "vinebench-100: expected 100 sequences"
[[ $(stat -c %s "$root/collections/vinebench-100.yaml") -le 51200 ]] ||
  report "vinebench-100: is larger than 50 kB"

[[ $failures -eq 0 ]] && echo "collection: passed"
exit $((failures > 0))

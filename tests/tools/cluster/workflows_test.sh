#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# A sweep by a Snakemake workflow and by GNU parallel has the table of a run in one go, and the
# manifest for Kubernetes is valid. Needs snakemake and kubernetes-validate of PyPI, and GNU parallel,
# and does without those that are missing. Usage: workflows_test.sh VINEBENCH ROOT
set -euo pipefail
vinebench=$1
root=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
tried=0

cat >spec.yaml <<'EOF'
scenarios: quick-loop
seeds: 1..4
set: {renderer.engine: fake, duration: 0.3}
EOF
one_go() {
  [[ -e whole/table.md ]] && return
  "$vinebench" run quick-loop --seeds 1..4 --set renderer.engine=fake --set duration=0.3 --out whole \
    >whole.txt 2>&1 || [[ $? -eq 1 ]]
}

if command -v snakemake >/dev/null; then
  snakemake --snakefile "$root/tools/cluster/Snakefile" --cores 2 --quiet all \
    --config spec=spec.yaml out=snake shards=2 "vinebench=$vinebench" >snake.log 2>&1 ||
    { cat snake.log; exit 1; }
  one_go
  cmp snake/table.md whole/table.md
  echo "snakemake: the same table"
  tried=1
fi
if command -v parallel >/dev/null; then
  "$vinebench" sweep plan spec.yaml --out plan.jsonl
  parallel --will-cite -j 2 "$vinebench" sweep run plan.jsonl --shard {}/2 --out parallel ::: 1 2 \
    >parallel.log 2>&1
  "$vinebench" sweep merge plan.jsonl parallel >merge.log 2>&1 || [[ $? -eq 1 ]]
  one_go
  cmp parallel/table.md whole/table.md
  echo "GNU parallel: the same table"
  tried=1
fi
if command -v kubernetes-validate >/dev/null; then
  kubernetes-validate --strict "$root/tools/cluster/kubernetes.yaml"
  # The command divides the work by as many shards as there are pods.
  pods=$(sed -n 's/^  completions: //p' "$root/tools/cluster/kubernetes.yaml")
  grep -q "+ 1))/$pods\"" "$root/tools/cluster/kubernetes.yaml"
  tried=1
fi
[[ $tried -eq 1 ]] || { echo "skipped: neither snakemake, parallel nor kubernetes-validate"; exit 77; }
echo "workflows: passed"

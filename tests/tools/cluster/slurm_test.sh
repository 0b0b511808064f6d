#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0

# A sweep on a Slurm cluster of one node, which this test starts on the loopback device: tasks are
# killed and requeued at random, the disk is full for a while and the clock jumps, and the merged table
# is that of a run in one go, to the byte. Needs tools/setup.sh --cluster, and root for the full disk.
# Usage: slurm_test.sh VINEBENCH ROOT [SEEDS [KILLS]]; two scenarios over so many seeds
set -uo pipefail
vinebench=$1
root=$2
seeds=${3:-100}
kills=${4:-20}
shards=10

for program in munged slurmctld slurmd sbatch; do
  command -v "$program" >/dev/null || { echo "skipped: no $program (tools/setup.sh --cluster)"; exit 77; }
done

work=$(mktemp -d)
mounted=
linked=
stop_cluster() {
  scancel --me 2>/dev/null
  pkill -F "$work/slurmctld.pid" 2>/dev/null
  pkill -F "$work/slurmd.pid" 2>/dev/null
  sleep 1
  pkill -F "$work/munged.pid" 2>/dev/null
  [[ -z $mounted ]] || umount -l "$work/full"
  [[ -z $linked ]] || rm -f /etc/slurm/slurm.conf
  rm -rf "$work"
}
trap stop_cluster EXIT
fail() {
  echo "FAILED: $1"
  tail -n 4 "$work"/*.log "$work"/out-*.txt 2>/dev/null
  exit 1
}
free_port() { python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])'; }

# --- the cluster ---
chmod 755 "$work"
mkdir -p "$work"/{state,spool,results,full}
(umask 077 && dd if=/dev/urandom of="$work/munge.key" bs=1024 count=1 status=none)
export SLURM_CONF=$work/slurm.conf
cpus=$(nproc)
cat >"$SLURM_CONF" <<EOF
ClusterName=vinebench
SlurmctldHost=$(hostname)(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
CryptoType=crypto/munge
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
MinJobAge=3600
KillWait=2
JobRequeue=1
NodeName=$(hostname) NodeAddr=127.0.0.1 CPUs=$cpus State=UNKNOWN
PartitionName=vines Nodes=ALL Default=YES MaxTime=INFINITE State=UP
EOF
munged --force --key-file="$work/munge.key" --socket="$work/munge.socket" --pid-file="$work/munged.pid" \
  --log-file="$work/munged.log" --seed-file="$work/munge.seed" >/dev/null 2>&1 || fail "munged"
slurmctld -i >/dev/null 2>&1 || fail "slurmctld"
slurmd >/dev/null 2>&1 || fail "slurmd"
for _ in $(seq 60); do
  sinfo -h -o %t 2>/dev/null | grep -q idle && break
  sleep 0.5
done
sinfo -h -o %t | grep -q idle || fail "the node is not idle"

# --- the sweep ---
cd "$work" || exit 1
cat >spec.yaml <<EOF
scenarios: [quick-loop, aisle-loop]
seeds: 1..$seeds
set: {renderer.engine: fake, duration: 0.3}
EOF
"$vinebench" sweep plan spec.yaml --out plan.jsonl 2>plan.log || fail "plan"
tasks=$((2 * seeds))

# The clock of half of the shards jumps by a month forth and back while they run.
clock=$(find /usr/lib -name libfaketime.so.1 2>/dev/null | head -n 1)
echo "+0" >clock.txt
cat >program.sh <<EOF
#!/bin/sh
if [ -n "$clock" ] && [ \$((SLURM_ARRAY_TASK_ID % 2)) -eq 0 ]; then
  export LD_PRELOAD=$clock FAKETIME_TIMESTAMP_FILE=$work/clock.txt FAKETIME_NO_CACHE=1
  export FAKETIME_DONT_FAKE_MONOTONIC=1
fi
exec "$vinebench" "\$@"
EOF
chmod +x program.sh
[[ -n $clock ]] || echo "note: without libfaketime no clock jumps"

export VINEBENCH=$work/program.sh
submit() { # submit OUT ARRAY; prints the job's number
  sbatch --parsable --mem=0 --output="$work/out-%a.txt" --array="$2" "$root/tools/cluster/sweep.sbatch" \
    plan.jsonl "$1" $shards
}
running() { squeue -h -r -j "$1" -t running -o %i; }
wait_for() { # until no task of the job is left, or no progress for five minutes
  local job=$1
  for _ in $(seq 3000); do
    [[ -n $(squeue -h -r -j "$job" -o %i 2>/dev/null) ]] || return 0
    sleep 0.2
  done
  fail "job $job does not end"
}
failed_tasks() { # of the job, by accounting of the controller
  scontrol show job "$1" -o 2>/dev/null | grep -E 'JobState=(FAILED|CANCELLED|TIMEOUT|NODE_FAIL|OUT_OF_MEMORY)' |
    sed -E 's/.*ArrayTaskId=([0-9]+).*/\1/' | sort -nu
}

# First onto a disk that is too small for all of it.
out=$work/results
if [[ $(id -u) -eq 0 ]] && mount -t tmpfs -o size=1500k none "$work/full" 2>/dev/null; then
  mounted=1
  job=$(submit "$work/full" 1-2) || fail "sbatch"
  wait_for "$job"
  grep -qs 'No space left on device' "$work"/out-[12].txt || fail "the full disk was not noticed"
  # What is whole moves to a larger disk, where the same shards go on.
  cp -a "$work/full/." "$out"
  umount "$work/full" && mounted=
else
  echo "note: without root no disk is full"
fi

start_pending() { # Slurm waits two minutes before it starts a requeued task again
  local id
  for id in $(squeue -h -r -j "$1" -t pending -o %i); do scontrol update jobid="$id" starttime=now 2>/dev/null; done
}

RANDOM=20
job=$(submit "$out" 1-$shards) || fail "sbatch"
killed=0
while [[ $killed -lt $kills ]]; do
  sleep "$((RANDOM % 3)).$((RANDOM % 9 + 1))"
  start_pending "$job"
  mapfile -t ids < <(running "$job")
  [[ ${#ids[@]} -gt 0 ]] || { [[ -n $(squeue -h -r -j "$job" -o %i) ]] && continue || break; }
  id=${ids[RANDOM % ${#ids[@]}]}
  ((RANDOM % 2)) && echo "+30d" >clock.txt || echo "-30d" >clock.txt
  if ((RANDOM % 2)); then
    # As a node that runs out of memory does; a failed task is requeued by hand.
    pkill -9 -f -- "--shard ${id#*_}/$shards " || continue
    for _ in $(seq 50); do running "$job" | grep -qx "$id" || break; sleep 0.1; done
    scontrol requeue "$id" 2>/dev/null
  else
    # As a job of a higher priority does.
    scontrol requeue "$id" 2>/dev/null || continue
  fi
  killed=$((killed + 1))
done
for _ in $(seq 3000); do
  start_pending "$job"
  [[ -n $(squeue -h -r -j "$job" -o %i) ]] || break
  sleep 0.5
done
wait_for "$job"
echo "$tasks runs in $shards tasks, $killed killed and requeued"
[[ $killed -eq $kills ]] || fail "only $killed of $kills kills: too few seeds"
bad=$(failed_tasks "$job")
[[ -z $bad ]] || fail "tasks that failed in the end: $bad"

"$vinebench" sweep merge plan.jsonl "$out" --out merged >merge.txt 2>&1
[[ $? -le 1 ]] || { cat merge.txt; fail "merge"; }

# --- in one go ---
"$vinebench" run quick-loop aisle-loop --seeds "1..$seeds" --jobs "$cpus" --threads "$cpus" \
  --set renderer.engine=fake --set duration=0.3 --out whole >whole.txt 2>&1
[[ $? -le 1 ]] || fail "run"
cmp merged/table.md whole/table.md || fail "the merged table is another than that of a run in one go"
sha256sum merged/table.md whole/table.md | cut -c 1-64 | uniq -c
# --- the same by Snakemake, whose executor submits each shard as a job of its own ---
# Its jobs forget SLURM_CONF, so that the cluster's file must be where every cluster has it.
if [[ $(id -u) -eq 0 && ! -e /etc/slurm/slurm.conf ]]; then
  mkdir -p /etc/slurm && ln -s "$SLURM_CONF" /etc/slurm/slurm.conf && linked=1
fi
if [[ -n $linked ]] && command -v snakemake >/dev/null && snakemake --help | grep -q slurm-status-command; then
  snakemake --snakefile "$root/tools/cluster/Snakefile" --executor slurm --jobs 4 \
    --slurm-status-command squeue --slurm-no-account --slurm-init-seconds-before-status-checks 2 \
    --seconds-between-status-checks 2 --default-resources slurm_partition=vines mem_mb=0 \
    --set-resources shard:mem_mb=0 --latency-wait 10 \
    --config spec=spec.yaml out=snake shards=4 "vinebench=$vinebench" >snake.log 2>&1 ||
    { tail -n 20 snake.log .snakemake/slurm_logs/*/*.log; fail "snakemake"; }
  cmp snake/table.md whole/table.md || fail "Snakemake's table is another"
  echo "snakemake on slurm: the same table"
else
  echo "note: without root, snakemake and its executor for Slurm no workflow"
fi
echo "slurm: passed"

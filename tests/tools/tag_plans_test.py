# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The tables of tools/tag_plans.py and tools/collection_peers.py from results made here, with a program
that says what the real one would. Usage: tag_plans_test.py ROOT"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

# Plans of five and ten tags are predicted to leave 8 and 4 mm, the world's own twelve 6.
PROGRAM = r"""#!/bin/sh
case $1 in
  place-tags)
    while [ "$1" != --budget ]; do shift; done
    echo "the world's own          12 tags  95 % of the poses within     6.0 mm      85.4 nats"
    [ $2 = 5 ] && error=8.0 || error=4.0
    printf 'planned                %4d tags  95 %% of the poses within     %s mm  1 nats\n' $2 $error ;;
  compare) echo "compared $2 $3" | sed 's#/[^ ]*/##g' ;;
  dataset) printf 'row-5     test   many-rows seed 1015 duration=10\nfar-5   test  far-tag seed secret duration=10\n' ;;
esac
"""


def run(script, arguments, out, **settings):
    program = out / "vinebench"
    program.write_text(PROGRAM)
    program.chmod(0o755)
    environment = os.environ | {"OUT": str(out), "VINEBENCH": str(program), "TABLE": "1"} | settings
    return subprocess.run([sys.executable, script, *arguments], env=environment, capture_output=True, text=True)


def write_metrics(folder, **metrics):
    folder.mkdir(parents=True)
    (folder / "metrics.json").write_text(json.dumps(metrics))


def plans(root, out):
    for name, errors in (("own", (5, 7, 9)), ("planned-10", (4, 5, 6)), ("planned-5", (6, 8, 30))):
        for seed, error in enumerate(errors, 1):
            write_metrics(out / name / f"rows/seed-{seed}", ate_world_p95_m=error * 1e-3)
    done = run(root / "tools/tag_plans.py", ["world.yaml", "route.yaml", "5", "10"], out)
    # By the prediction, with the median of three seeds; both orders are the same.
    assert done.stdout.splitlines()[2:7] == [
        "| planned 10 | 4.0 | 5.0 | 3 |", "| own 12 | 6.0 | 7.0 | 3 |", "| planned 5 | 8.0 | 8.0 | 3 |", "",
        "rank correlation of predicted and measured: 1.00 over 3 plans"], done.stdout + done.stderr
    assert "compared own planned-5" in done.stdout, done.stdout
    # Own has 9 mm in the median, more than five planned: of the ranks 1 2 3 it is 1 3 2, whose
    # correlation is 1 - 6 * 2 / 24.
    for seed in (1, 2):
        (out / f"own/rows/seed-{seed}/metrics.json").write_text(json.dumps({"ate_world_p95_m": 0.009}))
    done = run(root / "tools/tag_plans.py", ["world.yaml", "route.yaml", "5", "10"], out)
    assert "measured: 0.50 over 3 plans" in done.stdout, done.stdout
    done = run(root / "tools/tag_plans.py", ["world.yaml", "route.yaml", "few"], out)
    assert done.returncode != 0 and "Usage" in done.stderr


def collection(root, out):
    shared = {"losses": 0, "loop_closures": {"correct": 1, "wrong": 0}, "peak_rss_mib": 200}
    for system, origin, coverage in (("full", 0.001, 1.0), ("one-pair", 0.0042, 0.9), ("orb-slam3", None, 0)):
        folder = out / f"row-5/seed-1015/{system}"
        write_metrics(folder, ate_origin_rmse_m=origin, ate_rmse_m=origin, coverage=coverage, **shared)
        (folder / "estimate_live.tum").write_text("0.0 0 0 0 0 0 0 1\n")
    done = run(root / "tools/collection_peers.py", ["--table"], out)
    # The sequence whose seed is secret is none; a run without a pose has no error.
    assert done.stdout.splitlines()[2:] == ["| `row-5` | 1.0 | 100.0 | 4.2 | 90.0 | none | 0.0 |",
                                            "| median of 1 | 1.0 | 100.0 | 4.2 | 90.0 | none | 0.0 |"], \
        done.stdout + done.stderr


def main():
    root = Path(sys.argv[1]).resolve()
    for test in (plans, collection):
        with tempfile.TemporaryDirectory() as out:
            test(root, Path(out))
    print("tag_plans: passed")


if __name__ == "__main__":
    main()

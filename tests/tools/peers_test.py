# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The table of tools/peers.py from results made here, and its messages. Usage: peers_test.py ROOT"""
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

failures = 0


def check(name, good):
    global failures
    failures += not good
    if not good:
        print(f"FAILED: {name}")


def peers(root, out, arguments=("--table",), script="peers.py", **settings):
    environment = os.environ | {"OUT": str(out), "VINEBENCH": sys.executable} | settings
    return subprocess.run([sys.executable, root / "tools" / script, *arguments], env=environment,
                          capture_output=True, text=True)


def write_run(folder, origin, coverage, peer):
    (folder / "external").mkdir(parents=True)
    metrics = {"ate_origin_rmse_m": origin, "ate_rmse_m": origin and origin / 2, "losses": 1,
               "coverage": coverage, "loop_closures": {"correct": 1, "wrong": 0},
               "peak_rss_mib": 200.4}
    (folder / "metrics.json").write_text(json.dumps(metrics))
    # 30 mm, then 400 mm over a gap of a second, which is no step.
    poses = "0.0 0 0 0 0 0 0 1\n0.066 0.03 0 0 0 0 0 1\n1.066 0.43 0 0 0 0 0 1\n"
    (folder / "estimate_live.tum").write_text(poses)
    if peer:
        (folder / "external/live.txt").write_text(poses)
        (folder / "external/wheel.json").write_text(json.dumps(
            {"frames": 8, "tracked": 6, "losses": 2, "cpu_ms_a_frame": 40.4, "map_changes": [1.5],
             "peak_rss_mib": 100.0}))


def main(root, out):
    for seed, origin in ((1, 0.004), (2, 0.002), (3, None)):
        write_run(out / f"lane/seed-{seed}/orb-slam3", origin, 0.5, True)
    write_run(out / "lane/seed-1/orb-slam3-again", 0.006, 0.25, True)
    write_run(out / "lane/seed-1/full", 0.001, 1.0, False)
    (out / "lane/seed-1/full/common.json").write_text(json.dumps({"ate_rmse_m": 0.0003}))
    (out / "lane/bench.json").write_text(json.dumps(
        {"runs": [{"cpu_ms": {"mean": 46.0}}, {"cpu_ms": {"mean": 18.0}}]}))
    done = peers(root, out, SCENARIOS="scenarios/lane.yaml", SEEDS="1..3")
    # Sorted, ATE origin is 2, 4 mm and none, ATE half of it: the medians are 4 and 2.
    rows = ["| `lane` | ours, two pairs and tags | 1 | 1.0 | 0.5 | 0.3 | 100.0 | 100.0 | 1 | 30 | 1 | 0 | – | 46"
            " | 200 |",
            "| `lane` | ORB-SLAM3, front pair | 1 2 3 | 4.0 | 2.0 | 2.0 | 50.0 | 75.0 | 2 | 30 | – | – | 1 | 40"
            " | 100 |",
            "| `lane` | ORB-SLAM3, front pair | 1 | 4.0 | 2.0 | 2.0 | 50.0 | 75.0 | 2 | 30 | – | – | 1 | 40"
            " | 100 |",
            "| `lane` | ORB-SLAM3, front pair, again | 1 | 6.0 | 3.0 | 3.0 | 25.0 | 75.0 | 2 | 30 | – | – | 1"
            " | 40 | 100 |"]
    check(f"the table:\n{done.stdout}{done.stderr}", done.stdout.splitlines()[2:] == rows)
    check("its file", (out / "table.md").read_text() == done.stdout)
    for settings, message in (({"SEEDS": "few"}, "SEEDS: expected A..B, such as 1..5, found 'few'"),
                              ({"SEEDS": "5..1"}, "SEEDS: expected A..B"),
                              ({"SEEDS": "1..²"}, "SEEDS: expected A..B"),
                              ({"SEEDS": "1.." + 5000 * "9"}, "SEEDS: expected A..B"),
                              ({"FRAMES": "3OO"}, "FRAMES: expected a whole number from 0 to"),
                              ({"FRAMES": "-1"}, "FRAMES: expected a whole number from 0 to"),
                              ({"TRAINING_SEED": ""}, "TRAINING_SEED: expected a whole number"),
                              ({"SEEDS": "8..9"}, "TRAINING_SEED: 9 is one of SEEDS"),
                              ({"VOCABULARY": str(out / "none")}, "none: is no file"),
                              ({"VINEBENCH": str(out / "none")}, "none: is no program")):
        done = peers(root, out, **settings)
        good = done.returncode == 2 and message in done.stderr
        check(f"{settings}: {message}", good and len(done.stderr.splitlines()) == 1)
    for script in "peers.py", "collection_peers.py":
        done = peers(root, out / "help", ["--help"], script)
        check(f"{script} --help", done.returncode == 0 and "--table" in done.stdout)
        done = peers(root, out / "help", ["--tabel"], script)
        check(f"{script} --tabel", done.returncode == 2 and "unknown argument '--tabel'" in done.stderr)
    check("nothing is run or written for these", not (out / "help").exists())
    # A table made later has the same versions.
    text = (root / "tools/peers.py").read_text()
    packages = re.findall(r'"([^"]+)"', re.search(r"^PACKAGES = \[(.*?)\]", text, re.M | re.S)[1])
    check("packages have versions", packages and all(re.match(r"[a-z0-9-]+==\d", p) for p in packages))
    return 1 if failures else 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        sys.exit(main(Path(sys.argv[1]).resolve(), Path(name)))

#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Other SLAM systems beside ours on the same images (docs/peers.md): makes the runs that are not
there yet and prints a table of medians over the seeds. From the environment:
  SCENARIOS="occluded-camera long-path many-rows csl-1 csl-2"  SEEDS=1..5  OUT=out/peers
  VINEBENCH=build/vinebench  PYTHON=python3 (3.9 to 3.13, for the environment of the wheel)
  VOCABULARY=ORBvoc.txt (default: trained once on quick-loop, seed TRAINING_SEED=9)
  AGAIN=1 (ORB-SLAM3 a second time on the first scenario and seed; 0: not)
  FRAMES=300 (on which our CPU time is measured, first seed of each scenario; 0: not measured)
With --table nothing is run. Exit code 1 if a run cannot be made, 2 for wrong settings.
"""
import json
import math
import os
import re
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# numpy 2.0.2 is the last for Python 3.9, 2.2.6 the first choice for 3.13, which 2.0.2 does not have.
PACKAGES = ["pyorbslam3==0.1.1", "numpy==2.0.2; python_version<'3.13'",
            "numpy==2.2.6; python_version>='3.13'", "opencv-python-headless==4.11.0.86"]
MOST = 10**9  # of a seed, of frames
RECORDING = "recording"
PEER, AGAIN = "orb-slam3", "orb-slam3-again"
# Ours, replayed on the peer's recording.
OURS = {"full": [], "one-pair": ["slam.cameras=[front]", "slam.loop.enabled=false"]}
NAMES = {"full": "ours, two pairs and tags", "one-pair": "ours, front pair, no loops",
         PEER: "ORB-SLAM3, front pair", AGAIN: "ORB-SLAM3, front pair, again"}
BENCHED = {"full": 0, "one-pair": -1}  # rows of `bench slam`: all cameras, ..., the first pair


def stop(message, code=2):
    sys.exit(print(f"peers.py: {message}", file=sys.stderr) or code)


def only_table(usage):
    """Whether the command line asks for a table alone; prints `usage` for --help."""
    match sys.argv[1:]:
        case []:
            return False
        case ["--table"]:
            return True
        case ["--help" | "-h"]:
            sys.exit(print(usage.strip()))
    stop(f"unknown argument '{sys.argv[-1]}': expected --table, --help or none")


def whole_number(name, default):
    text = os.environ.get(name, default)
    if not re.fullmatch(r"[0-9]{1,10}", text) or int(text) > MOST:
        stop(f"{name}: expected a whole number from 0 to {MOST}, found '{text}'")
    return int(text)


def seed_range(text):
    match = re.fullmatch(r"([0-9]{1,10})(?:\.\.([0-9]{1,10}))?", text)
    seeds = range(int(match[1]), int(match[2] or match[1]) + 1) if match else []
    if not seeds or seeds[-1] > MOST:
        stop(f"SEEDS: expected A..B, such as 1..5, found '{text}'")
    return seeds


class Settings:
    def __init__(self):
        get = os.environ.get
        self.scenarios = get("SCENARIOS", "occluded-camera long-path many-rows csl-1 csl-2").split()
        self.seeds = seed_range(get("SEEDS", "1..5"))
        self.out = Path(get("OUT", "out/peers")).resolve()
        self.vinebench = Path(get("VINEBENCH", ROOT / "build/vinebench")).resolve()
        self.training_seed = whole_number("TRAINING_SEED", "9")
        self.vocabulary = get("VOCABULARY")
        self.python = get("PYTHON", "python3")
        self.again = get("AGAIN", "1") != "0"
        self.frames = whole_number("FRAMES", "300")
        if not self.vinebench.is_file():
            stop(f"{self.vinebench}: is no program")
        if self.vocabulary and not Path(self.vocabulary).is_file():
            stop(f"VOCABULARY: {self.vocabulary}: is no file")
        if not self.vocabulary and self.training_seed in self.seeds:
            stop(f"TRAINING_SEED: {self.training_seed} is one of SEEDS")

    def folder(self, scenario, seed, system):
        return self.out / Path(scenario).stem / f"seed-{seed}" / system

    def bench(self, scenario):
        return self.out / Path(scenario).stem / "bench.json"


def call(*command, allowed=(0,)):
    """Runs a command; returns what it prints."""
    name = Path(command[0]).name
    try:
        done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace", cwd=ROOT)
    except OSError as error:
        stop(f"{name}: {error.strerror}", 1)
    if done.returncode not in allowed:
        stop(f"{name}: exit code {done.returncode}: {done.stdout.strip()[-1000:]}", 1)
    return done.stdout


def environment(settings):
    """The Python that has the wheel."""
    python = settings.out / "venv/bin/python3"
    ready = settings.out / "venv/packages.txt"
    if not ready.is_file() or ready.read_text() != "\n".join(PACKAGES):
        call(settings.python, "-m", "venv", settings.out / "venv")
        call(python, "-m", "pip", "install", "--quiet", *PACKAGES)
        ready.write_text("\n".join(PACKAGES))
    return python


def vocabulary(settings, python):
    if settings.vocabulary:
        return Path(settings.vocabulary).resolve()
    file = settings.out / f"vocabulary-{settings.training_seed}.txt"
    if not file.is_file():
        data = settings.out / "training"
        call(settings.vinebench, "record", "quick-loop", "--set",
             f"seed={settings.training_seed}", "--format", "euroc", "--out", data)
        call(python, ROOT / "examples/orb_slam3/train_vocabulary.py", data / "euroc", file)
        shutil.rmtree(data)
    return file


def options_of(changes):
    return [part for change in changes for part in ("--set", change)]


def run_full(settings, folder, scenario, seed, recording, cameras, changes):
    """The scenario with our core, which also records it for the others; all cameras if none is
    named."""
    some = ["--record-cameras", ",".join(cameras)] if cameras else []
    # 1: the scenario's expectations are not met.
    call(settings.vinebench, "run", scenario, "--set", f"seed={seed}", *options_of(changes),
         "--record", recording, *some, "--out", folder, allowed=(0, 1))


def replay(settings, folder, recording, truth, changes, allowed=(0,)):
    call(settings.vinebench, "replay", recording, "--groundtruth", truth, "--out", folder,
         *options_of(changes), allowed=allowed)


def run_peer(settings, folder, recording, truth, python, words):
    """ORB-SLAM3 in the core's place."""
    arguments = [ROOT / "examples/orb_slam3/run_wheel.py", "{recording}", "{output}",
                 "--vocabulary", words]
    shutil.rmtree(folder, ignore_errors=True)
    values = {"program": python, "arguments": f"[{', '.join(json.dumps(str(a)) for a in arguments)}]",
              "trajectory": "f_vinebench.txt", "poses_of": "front_left"}
    replay(settings, folder, recording, truth,
           [f"slam.external.{key}={value}" for key, value in values.items()],
           allowed=(0, 1))  # 1: it has failed


def errors_on_peers_frames(settings, folders):
    """Ours over the frames in the peer's trajectory alone, as far as there are any."""

    def lines_of(folder):
        lines = (folder / "estimate.tum").read_text().splitlines()
        return [line for line in lines if line and not line.startswith("#")]

    stamps = {line.split()[0] for line in lines_of(folders[PEER])}
    for system in OURS:
        result = folders[system] / "common.json"
        common = [line for line in lines_of(folders[system]) if line.split()[0] in stamps]
        if result.is_file() or len(common) < 3:
            continue
        trajectory = folders[system] / "common.tum"
        trajectory.write_text("\n".join(common) + "\n")
        found = call(settings.vinebench, "eval", folders[PEER] / "groundtruth.tum", trajectory)
        rows = (line.split() for line in found.splitlines())
        result.write_text(json.dumps({row[0]: float(row[1]) for row in rows if len(row) == 2}))


def run_case(settings, scenario, seed, python, words, name=None, changes=(), again=False):
    """All systems on one drive, which is rendered once; its folder is the scenario's or `name`."""
    systems = (*OURS, PEER, AGAIN) if again else (*OURS, PEER)
    folders = {system: settings.folder(name or scenario, seed, system) for system in systems}
    bench = settings.bench(scenario)
    with_bench = settings.frames > 0 and seed == settings.seeds[0] and not bench.is_file()
    missing = {s: f for s, f in folders.items() if not (f / "metrics.json").is_file()}
    if with_bench or missing:
        recording = settings.folder(name or scenario, seed, RECORDING)
        shutil.rmtree(recording, ignore_errors=True)
        # The peer and our front pair alone need no more; a benchmark does.
        cameras = () if with_bench else ("front_left", "front_right")
        run_full(settings, folders["full"], scenario, seed, recording, cameras, changes)
        truth = folders["full"] / "groundtruth.tum"
        for system, folder in missing.items():
            if system in (PEER, AGAIN):
                run_peer(settings, folder, recording, truth, python, words)
            elif system != "full":
                replay(settings, folder, recording, truth, OURS[system])
        if with_bench:
            call(settings.vinebench, "bench", "slam", recording, "--frames", settings.frames,
                 "--json", bench)
        shutil.rmtree(recording, ignore_errors=True)
    errors_on_peers_frames(settings, folders)


def largest_step(file):
    """m between the positions of two consecutive lines that are at most 0.1 s apart."""
    rows = [[float(value) for value in line.split()[:4]]
            for line in file.read_text().splitlines() if line and not line.startswith("#")]
    return max((math.dist(a[1:], b[1:]) for a, b in zip(rows, rows[1:]) if b[0] - a[0] <= 0.1),
               default=None)


def scaled(value, factor):
    return None if value is None else factor * value


def measured(settings, scenario, seed, system):
    """What is known of a run; None for what is not."""
    folder = settings.folder(scenario, seed, system)
    if not (folder / "metrics.json").is_file():
        return None
    metrics = json.loads((folder / "metrics.json").read_text())
    row = {"origin": scaled(metrics["ate_origin_rmse_m"], 1e3),
           "ate": scaled(metrics["ate_rmse_m"], 1e3),
           "coverage": scaled(metrics["coverage"], 100), "losses": metrics["losses"]}
    if system in OURS:
        loops = metrics["loop_closures"]
        row |= {"tracked": row["coverage"], "right": loops["correct"], "wrong": loops["wrong"],
                "step": largest_step(folder / "estimate_live.tum")}
        if not (folder / "scenario.resolved.yaml").is_file():  # else it is the simulation's too
            row["memory"] = metrics["peak_rss_mib"]
        if (folder / "common.json").is_file():
            common = json.loads((folder / "common.json").read_text())
            row["common"] = scaled(common["ate_rmse_m"], 1e3)
        bench = settings.bench(scenario)
        if bench.is_file():
            rows = json.loads(bench.read_text())["runs"]
            row["cpu"] = rows[BENCHED[system]]["cpu_ms"]["mean"]
    elif (folder / "external/wheel.json").is_file():
        row["common"] = row["ate"]
        wheel = json.loads((folder / "external/wheel.json").read_text())
        row |= {"tracked": 100 * wheel["tracked"] / wheel["frames"], "losses": wheel["losses"],
                "cpu": wheel["cpu_ms_a_frame"], "changes": len(wheel["map_changes"]),
                "memory": wheel["peak_rss_mib"], "step": largest_step(folder / "external/live.txt")}
    row["step"] = scaled(row.get("step"), 1e3)
    return row


def median(rows, key, digits):
    values = [row.get(key) for row in rows]
    if all(value is None for value in values):
        return "–"
    # A run without a figure, e.g. one that never initialised, is worse than all others.
    middle = statistics.median(math.inf if value is None else value for value in values)
    return "none" if math.isinf(middle) else f"{middle:.{digits}f}"


COLUMNS = {"ATE origin, mm": ("origin", 1), "ATE, mm": ("ate", 1),
           "ATE on ORB-SLAM3's frames, mm": ("common", 1), "coverage, %": ("coverage", 1),
           "tracked, %": ("tracked", 1), "losses": ("losses", 0), "largest live step, mm": ("step", 0),
           "loops right": ("right", 0), "loops wrong": ("wrong", 0), "map changes": ("changes", 0),
           "CPU a frame, ms": ("cpu", 0), "memory, MiB": ("memory", 0)}


def line(scenario, name, runs):
    """Of the table: medians of the runs, which are given by seed."""
    cells = [median(runs.values(), *column) for column in COLUMNS.values()]
    cells = [f"`{Path(scenario).stem}`", name, " ".join(map(str, runs)), *cells]
    return f"| {' | '.join(cells)} |"


def table(settings):
    lines = ["| " + " | ".join(["scenario", "system", "seeds", *COLUMNS]) + " |",
             "|---|---|---|" + "---:|" * len(COLUMNS)]
    for scenario in settings.scenarios:
        for system, name in NAMES.items():
            found = {seed: row for seed in settings.seeds
                     if (row := measured(settings, scenario, seed, system))}
            if system == AGAIN:  # beside the first run of the same seed
                first = {seed: measured(settings, scenario, seed, PEER) for seed in found}
                lines += [line(scenario, NAMES[PEER], first)] if all(first.values()) and first else []
            if found:
                lines.append(line(scenario, name, found))
    return "\n".join(lines) + "\n"


def main():
    table_only = only_table(__doc__)
    settings = Settings()
    settings.out.mkdir(parents=True, exist_ok=True)
    if not table_only:
        python = environment(settings)
        words = vocabulary(settings, python)
        first = settings.again
        for scenario in settings.scenarios:
            for seed in settings.seeds:
                run_case(settings, scenario, seed, python, words, again=first)
                first = False
    text = table(settings)
    (settings.out / "table.md").write_text(text)
    print(text, end="")


if __name__ == "__main__":
    main()

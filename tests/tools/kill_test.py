# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Kills recordings and sets of them, at file operations and at random times, and expects that
`check` says what there is and that `record --resume` gives the bytes of an uninterrupted one.
Usage: kill_test.py VINEBENCH SHIM ROOT [--every K] [--first A] [--last B] [--times N] [--seed S]
  --every K  at every K-th file operation (default: 480)
  --first A, --last B  of the operations A to B of each recording (default: all)
  --times N  at N random times, half of them in a set (default: 4)
  --seed S   of these times (default: 1)"""
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

from interruption import content, numbers, parse_arguments, run, write_scenario

FORMATS = "euroc,kitti,tum,dcvslam,rgb,depth,coco"
INTERRUPTED = re.compile(r"INTERRUPTED, \d+ of \d+ (frames|sequences)")


class Recording:
    """One kind of recording, with what it is when nothing interrupts it."""

    def __init__(self, name, arguments, work):
        self.name = name
        self.arguments = arguments
        self.work = work
        self.out = work / name / "data"
        self.out.parent.mkdir()
        start = time.monotonic()
        code, _, errors, _ = run(self.command())
        self.seconds = time.monotonic() - start
        assert code == 0, errors
        self.whole = content(self.out)

    def command(self, *more):
        return [vinebench, "record", *self.arguments, "--out", self.out, *more]

    def clear(self):
        shutil.rmtree(self.out, ignore_errors=True)

    def expect_what_there_is_checked(self, when):
        """Nothing, an interrupted part that is sound, or all of it."""
        if not self.out.is_dir() or not any(self.out.iterdir()):
            return
        code, out, errors, _ = run([vinebench, "check", self.out])
        if not (self.out / "dataset.yaml").exists():
            problem = code != 2 or "was interrupted before its first file" not in errors
        else:
            problem = code != 0 or not (INTERRUPTED.search(out) or ": SOUND" in out)
        if problem:
            report(f"{self.name}, {when}: check ended with {code}: {out}{errors}")

    def expect_the_whole_after_resuming(self, when):
        code, _, errors, _ = run(self.command("--resume"))
        if code != 0:
            report(f"{self.name}, {when}: --resume ended with {code}: {errors[-500:]}")
            return
        there = content(self.out)
        differing = sorted(name for name in self.whole.keys() | there.keys()
                           if self.whole.get(name) != there.get(name))
        if differing:
            report(f"{self.name}, {when}: after --resume other bytes in {differing[:5]}")

    def expect(self, when):
        self.expect_what_there_is_checked(when)
        self.expect_the_whole_after_resuming(when)

    def kill_at(self, number, *more):
        """Whether there was such an operation."""
        code, _, errors, at = run(self.command(*more), shim=shim, fault=("KILL", number),
                                  folder=self.out)
        if at and code != -9:
            report(f"{self.name}: ended with {code} in place of a kill: {errors[-500:]}")
        return at

    def kill_after(self, seconds):
        with subprocess.Popen([str(word) for word in self.command()], stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as program:
            time.sleep(seconds)
            program.kill()


failures = 0


def report(text):
    global failures
    failures += 1
    print("FAILED:", text, flush=True)


def kill_at_operations(recording):
    """Also while the resumed recording removes what the first one left."""
    kills = last = 0
    for number in numbers(arguments):
        recording.clear()
        at = recording.kill_at(number)
        if not at:
            break
        recording.expect_what_there_is_checked(f"killed at operation {number}, {at}")
        kills += 1
        again = recording.kill_at(1 + number * 7 % 60, "--resume")
        kills += 1 if again else 0
        recording.expect(f"killed at operation {number}, {at}, and when resumed at {again}")
        last = number
    print(f"{recording.name}: {kills} kills at file operations up to number {last}", flush=True)
    return kills


def kill_at_times(recording, count, draw):
    for _ in range(count):
        recording.clear()
        seconds = draw.uniform(0, recording.seconds)
        recording.kill_after(seconds)
        recording.expect(f"killed after {seconds:.4f} s of {recording.seconds:.2f}")
    print(f"{recording.name}: {count} kills at random times", flush=True)
    return count


def main():
    draw = random.Random(arguments.seed)
    kills = 0
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        scenario = write_scenario(work, root)
        usual = [scenario, "--format", FORMATS, "--jobs", "2"]
        sequence = Recording("sequence", usual, work)
        several = Recording("set", [*usual, "--seeds", "3..5", "--frames", "0..1"], work)
        for recording in (sequence, several):
            kills += kill_at_operations(recording)
            kills += kill_at_times(recording, (arguments.times + 1) // 2, draw)
    print(f"{kills} kills, {failures} failures")
    return 1 if failures else 0


arguments = parse_arguments(every=480, first=1, last=0, times=4, seed=1)
vinebench, shim, root = arguments.vinebench, arguments.shim, arguments.root
sys.exit(main())

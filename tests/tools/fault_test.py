# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Lets file operations of recordings, runs and sets fail, in turn one alone (EIO) and one with all
later ones (ENOSPC, a full disk). Expects exit code 2 with one message, and that whatever has a
final name is whole, or of a growing list a beginning.
Usage: fault_test.py VINEBENCH SHIM ROOT [--every K] [--first A] [--last B]
  --every K  at every K-th file operation (default: 180)
  --first A, --last B  of the operations A to B of each command (default: all)"""
import json
import pathlib
import shutil
import sys
import tempfile

from interruption import content, numbers, parse_arguments, run, write_scenario

GROWING = (".csv", ".jsonl", ".xxh128", "times.txt", "poses.txt", "tum/body.txt", "tum/left.txt",
           "tum/right.txt", "tum/side.txt", ".mcap")
REWRITTEN = ("dataset.yaml", "dcvslam/config.yaml", "metrics.json", "summary.json", "table.md",
             "junit.xml", "log.txt", "mcap/metadata.yaml")

failures = 0


def without_summary(mcap):
    """The data of an MCAP file, which is closed properly when it cannot grow."""
    at = 8
    while at + 9 <= len(mcap) and mcap[at] != 0x0f:
        at += 9 + int.from_bytes(mcap[at + 1:at + 9], "little")
    return mcap[:at]


def report(text):
    global failures
    failures += 1
    print("FAILED:", text, flush=True)


class Case:
    """A command that writes below one folder."""

    def __init__(self, name, folder, command):
        self.name = name
        self.folder = folder
        self.command = [vinebench, *command]
        self.clear()
        code, _, errors, _ = run(self.command)
        assert code in (0, 1), errors  # a drive so short fails its scenario's expectations
        self.whole = content(folder)

    def clear(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir()

    def fail_at(self, kind, number):
        """The operation that failed, if there was one."""
        self.clear()
        code, out, errors, at = run(self.command, shim=shim, fault=(kind, number),
                                    folder=self.folder)
        if not at:
            return at
        when = f"{self.name}, {kind} at {number}, {at}"
        lines = [line for line in (out + errors).splitlines()
                 if line.startswith("vinebench: ") or ": ERROR, " in line]
        if code != 2 or "internal error" in errors:
            report(f"{when}: ended with {code}: {errors[-500:]}")
        elif not lines or len(lines) > self.messages():
            report(f"{when}: {len(lines)} messages: {errors[-800:]}")
        self.expect_whole_files(when)
        self.expect_readable(when)
        return at

    def messages(self):
        """One of each run of a set, and one of the set."""
        return 3 if "--seeds" in self.command and "run" in self.command else 1

    def expect_whole_files(self, when):
        for name, there in content(self.folder).items():
            whole = self.whole.get(name)
            if name.endswith((".partial", *REWRITTEN)):
                continue
            if whole is None and name.endswith(".jsonl"):
                continue  # COCO's lists, until its files are made of them
            if name.endswith(".mcap"):
                there = without_summary(there)
            if whole is None:
                report(f"{when}: {name} is not a file of a whole one")
            elif not (whole.startswith(there) if name.endswith(GROWING) else whole == there):
                report(f"{when}: {name} is not whole: {len(there)} of {len(whole)} bytes")

    def expect_readable(self, when):
        for file in self.folder.rglob("*.json"):
            try:
                json.loads(file.read_text())
            except ValueError as error:
                report(f"{when}: {file.name}: {error}")
        for card in self.folder.rglob("dataset.yaml"):
            code, out, errors, _ = run([vinebench, "check", card.parent])
            if code != 0:
                report(f"{when}: check ended with {code}: {out}{errors}")


def main():
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        scenario = write_scenario(work, root)
        record = ["record", scenario, "--format", "euroc,kitti,tum,dcvslam,rgb,depth,coco,mcap"]
        out = work / "out"
        cases = [
            ("record", [*record, "--out", out / "data"]),
            ("set of sequences", [*record, "--frames", "0..1", "--seeds", "1..2", "--out",
                                  out / "data"]),
            ("run", ["run", scenario, "--out", out / "run"]),
            ("run with a recording and a map",
             ["run", scenario, "--out", out / "run", "--record", out / "data", "--save-map",
              out / "row.map", "--save-cloud", out / "row.ply"]),
            ("set of runs", ["run", scenario, "--seeds", "1..2", "--jobs", "2", "--out", out / "set",
                             "--junit", out / "junit.xml"]),
        ]
        for name, command in cases:
            case = Case(name, out, [str(word) for word in command])
            done = 0
            for number in numbers(arguments):
                if not case.fail_at("EIO" if done % 2 else "ENOSPC", number):
                    break
                done += 1
            print(f"{name}: {done} faults", flush=True)
            faults += done
    print(f"{faults} faults, {failures} failures")
    return 1 if failures else 0


arguments = parse_arguments(every=180, first=1, last=0)
vinebench, shim, root = arguments.vinebench, arguments.shim, arguments.root
sys.exit(main())

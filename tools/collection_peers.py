#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Reference results on the sequences of a recipe: our core and ORB-SLAM3, as in tools/peers.py, on the
same images. Prints a row for each sequence and the median of all. From the environment, beside what
tools/peers.py reads:
  COLLECTION=collections/vinebench-100.yaml  SPLIT=test
With --table nothing is run.
"""
import math
import os
import re
import statistics
import sys

import peers

SHOWN = (*peers.OURS, peers.PEER)


def sequences(settings):
    """(name, scenario, seed, settings) of each; those whose seed is secret are none."""
    recipe = os.environ.get("COLLECTION", str(peers.ROOT / "collections/vinebench-100.yaml"))
    split = os.environ.get("SPLIT", "test")
    listed = peers.call(settings.vinebench, "dataset", recipe, "--split", split, "--list")
    found = []
    for line in listed.splitlines():
        match = re.fullmatch(r"(\S+) +(\S+) +(\S+) seed ([0-9]+)(.*)", line)
        if match:
            changes = [text for text in re.split(r" (?=[a-z0-9_.]+=)", match[5]) if text]
            found.append((match[1], match[3], int(match[4]), changes))
    if not found:
        peers.stop(f"{recipe}: no sequence of '{split}' whose seed is known")
    return found


def cell(value):
    return "–" if value is None else "none" if math.isinf(value) else f"{value:.1f}"


def table(settings, listed):
    names = [peers.NAMES[system] for system in SHOWN]
    head = [f"{name}: {what}" for name in names for what in ("ATE origin, mm", "coverage, %")]
    lines = ["| sequence | " + " | ".join(head) + " |", "|---|" + "---:|" * len(head)]
    columns = [[] for _ in head]
    for name, _, seed, _ in listed:
        rows = [peers.measured(settings, name, seed, system) for system in SHOWN]
        if not any(rows):
            continue
        values = []
        for row in rows:
            origin = None if row is None else math.inf if row["origin"] is None else row["origin"]
            values += [origin, None if row is None else row["coverage"] or 0.0]
        for column, value in zip(columns, values):
            column += [] if value is None else [value]
        lines.append(f"| `{name}` | {' | '.join(map(cell, values))} |")
    medians = [cell(statistics.median(column) if column else None) for column in columns]
    lines.append(f"| median of {len(lines) - 2} | {' | '.join(medians)} |")
    return "\n".join(lines) + "\n"


def main():
    table_only = peers.only_table(__doc__)
    settings = peers.Settings()
    settings.frames = 0
    settings.out.mkdir(parents=True, exist_ok=True)
    listed = sequences(settings)
    if not table_only:
        python = peers.environment(settings)
        words = peers.vocabulary(settings, python)
        for name, scenario, seed, changes in listed:
            peers.run_case(settings, scenario, seed, python, words, name, changes)
    text = table(settings, listed)
    (settings.out / "collection.md").write_text(text)
    print(text, end="")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Whether planned tags do what `vinebench place-tags` predicts (docs/tags.md): plans of several sizes,
the same drives with each and with the world's own tags, and a table of what 95 % of the poses are within.
Usage: tag_plans.py WORLD ROUTE [BUDGET...]; from the environment:
  SEEDS=1..20  JOBS=1  OUT=out/tag-plans  VINEBENCH=build/vinebench  METRIC=ate_world_p95_m
Runs that are there are kept. With TABLE=1 nothing is run: the seeds that all have are reported.
"""
import json
import os
import re
import statistics
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
OUT = Path(os.environ.get("OUT", "out/tag-plans")).resolve()
VINEBENCH = os.environ.get("VINEBENCH", str(ROOT / "build/vinebench"))
METRIC = os.environ.get("METRIC", "ate_world_p95_m")
PREDICTED = re.compile(r"^(planned|the world's own) +(\d+) tags +95 % of the poses within +([0-9.]+) mm", re.M)


def call(*command, allowed=(0,)):
    done = subprocess.run([VINEBENCH, *map(str, command)], stdout=subprocess.PIPE, text=True)
    if done.returncode not in allowed:
        sys.exit(f"tag_plans.py: vinebench {command[0]}: exit code {done.returncode}")
    return done.stdout


def plan(world, route, budgets):
    """{name: (tags, predicted mm, world)}"""
    plans = {}
    for budget in budgets:
        folder = OUT / f"plan-{budget}"
        text = call("place-tags", world, "--route", route, "--budget", budget, "--out", folder)
        for name, tags, error in PREDICTED.findall(text):
            if name == "planned":
                plans[f"planned-{tags}"] = (int(tags), float(error), folder / "world.yaml")
            else:
                plans["own"] = (int(tags), float(error), Path(world).resolve())
    return plans


def drive(route, plans):
    for name, (_, _, world) in plans.items():
        # 1: expectations that the scenario has for its own tags.
        call("run", route, "--set", f"world={json.dumps(str(world))}", "--seeds", os.environ.get("SEEDS", "1..20"),
             "--jobs", os.environ.get("JOBS", "1"), "--out", OUT / name, allowed=(0, 1))


def measured(name):
    """mm by seed."""
    found = {}
    for file in sorted((OUT / name).glob("*/seed-*/metrics.json")):
        value = json.loads(file.read_text()).get(METRIC)
        if value is not None:
            found[int(file.parent.name[5:])] = 1e3 * value
    return found


def ranks(values):
    order = sorted(range(len(values)), key=values.__getitem__)
    places = [0.0] * len(values)
    for place, i in enumerate(order):
        places[i] = place
    return places


def rank_correlation(a, b):
    """Spearman's; no two values are the same."""
    n = len(a)
    squares = sum((x - y) ** 2 for x, y in zip(ranks(a), ranks(b)))
    return 1 - 6 * squares / (n * (n * n - 1))


def table(plans):
    rows = {name: measured(name) for name in plans}
    lines = ["| tags | predicted, mm | measured, mm: median | seeds |", "|---|---:|---:|---:|"]
    medians = {}
    for name, (tags, predicted, _) in sorted(plans.items(), key=lambda item: item[1][1]):
        if rows[name]:
            medians[name] = statistics.median(rows[name].values())
            lines.append(f"| {name.split('-')[0]} {tags} | {predicted:.1f} | {medians[name]:.1f} | {len(rows[name])} |")
    print("\n".join(lines))
    if len(medians) > 2:
        names = list(medians)
        rho = rank_correlation([plans[n][1] for n in names], [medians[n] for n in names])
        print(f"\nrank correlation of predicted and measured: {rho:.2f} over {len(names)} plans")
    for name in plans:
        if name != "own" and len(set(rows[name]) & set(rows.get("own", {}))) > 1:
            print(f"\n{name} against own:")
            print(call("compare", OUT / "own", OUT / name, "--metric", METRIC, allowed=(0, 1)))


def main():
    if len(sys.argv) < 3 or not all(text.isdigit() for text in sys.argv[3:]):
        sys.exit(__doc__)
    world, route, *budgets = sys.argv[1:]
    plans = plan(world, route, budgets or ["5", "10"])
    if os.environ.get("TABLE") != "1":
        drive(route, plans)
    table(plans)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Runs a scenario with several seeds and prints the errors and what degraded the estimate.

    run.py occluded-camera --seeds 1 2 3
"""
import argparse

import vinebench as vb


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenario", nargs="?", default="quick-loop")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1])
    arguments = parser.parse_args()
    for seed in arguments.seeds:
        report = vb.run(arguments.scenario, seed=seed)
        error = report.metrics.ate_rmse_m
        told = "none" if error is None else f"{1000 * error:.1f} mm"
        print(f"seed {seed}: {report.verdict}, ATE {told}, hash {report.hash}")
        for part in report.degraded:
            print(f"  {part.begin:.1f} to {part.end:.1f} s: {part.cause} {' '.join(part.cameras)}")


if __name__ == "__main__":
    main()

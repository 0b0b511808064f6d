# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""`vinebench eval` against evo, on trajectories made here. Usage: evo_test.py VINEBENCH

Exit code 77 (skipped) where evo is not installed, 1 where a figure differs in its ninth digit.
"""
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    from evo.core import metrics, sync
    from evo.core.metrics import PoseRelation, Unit
    from evo.tools import file_interface
except ImportError:
    print("evo is not installed: skipped")
    sys.exit(77)

TOLERANCE = 1.5e-9  # m and %: both sides are rounded to nine digits


def quaternion(yaw, pitch):
    """x, y, z, w of a turn by `yaw` about z after one by `pitch` about y."""
    cy, sy, cp, sp = math.cos(yaw / 2), math.sin(yaw / 2), math.cos(pitch / 2), math.sin(pitch / 2)
    return -sy * sp, cy * sp, sy * cp, cy * cp


def write_pair(folder, seed, drop_every):
    """A winding path of 30 s at 15 Hz, and an estimate that drifts, jitters and misses frames; its
    stamps are up to 2 ms late."""
    draw = random.Random(seed)
    truth, estimate = [], []
    for i in range(450):
        t = i / 15
        x, y, z = 0.4 * t, math.sin(0.5 * t), 0.05 * math.sin(1.3 * t)
        yaw = math.atan2(0.5 * math.cos(0.5 * t), 0.4)
        truth.append((t, x, y, z, *quaternion(yaw, 0.02 * math.sin(t))))
        if drop_every and i % drop_every == 1:
            continue
        a = 0.3 + 0.002 * t  # another world, and a heading that drifts
        ex, ey = math.cos(a) * x - math.sin(a) * y, math.sin(a) * x + math.cos(a) * y
        noise = [draw.gauss(0, 0.01) for _ in range(3)]
        estimate.append((t + draw.uniform(0, 0.002), 1.01 * ex + noise[0] + 5, ey + noise[1] - 2,
                         z + noise[2], *quaternion(yaw + a + draw.gauss(0, 0.005), 0)))
    for name, poses in (("truth.tum", truth), ("estimate.tum", estimate)):
        lines = (" ".join(f"{value:.9f}" for value in pose) for pose in poses)
        (folder / name).write_text("\n".join(lines) + "\n")


def ours(program, folder):
    out = subprocess.run([program, "eval", folder / "truth.tum", folder / "estimate.tum"],
                         check=True, capture_output=True, text=True).stdout
    return {key: float(value) for key, value in (line.split() for line in out.splitlines())}


def of_evo(folder):
    truth = file_interface.read_tum_trajectory_file(str(folder / "truth.tum"))
    estimate = file_interface.read_tum_trajectory_file(str(folder / "estimate.tum"))
    truth, estimate = sync.associate_trajectories(truth, estimate, max_diff=0.01)
    figures = {"poses": truth.num_poses}

    def absolute(trajectory):
        error = metrics.APE(PoseRelation.translation_part)
        error.process_data((truth, trajectory))
        return error.get_all_statistics()

    # Relative errors first: alignment does not change them, but its rounding would.
    relative = metrics.RPE(PoseRelation.translation_part, delta=1, delta_unit=Unit.meters,
                           all_pairs=True, pairs_from_reference=True)
    relative.process_data((truth, estimate))
    figures["rpe_trans_percent"] = 100 * relative.get_all_statistics()["mean"]
    estimate.align_origin(truth)
    figures["ate_origin_rmse_m"] = absolute(estimate)["rmse"]
    estimate.align(truth)
    for name in ("rmse", "mean", "median", "max"):
        figures[f"ate_{name}_m"] = absolute(estimate)[name]
    return figures


def main(program):
    failures = 0
    for seed, drop_every in ((1, 0), (2, 7), (3, 2)):
        with tempfile.TemporaryDirectory() as name:
            write_pair(Path(name), seed, drop_every)
            expected, found = of_evo(Path(name)), ours(program, Path(name))
        for key, value in expected.items():
            wrong = key not in found or bool(abs(found[key] - value) > TOLERANCE)
            failures += wrong
            print(f"{seed} {key:<20} evo {value:.10f} ours {found.get(key)}{' FAILED' * wrong}")
        if set(found) != set(expected):
            print(f"{seed}: not compared: {set(found) ^ set(expected)} FAILED")
            failures += 1
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))

#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Feeds the built-in core with frames from Python, as those of a camera driver would be, and
compares its trajectory with the truth.

    frame_by_frame.py quick-loop
"""
import sys

import numpy as np

import vinebench as vb
from vinebench.trajectories import row_of


def main(name: str) -> None:
    scenario = vb.Scenario(name)
    slam = vb.Slam(scenario)  # its cameras, tags and settings
    truth = []
    for frame in scenario:
        # Arrays alone: images by camera, inertial and wheel readings since the frame before.
        given = vb.SensorFrame(frame.stamp, frame.images, imu=frame.imu, wheels=frame.wheels)
        estimate = slam.process(given)
        inliers = sum(counts.inliers for counts in estimate.cameras.values())
        print(f"{estimate.time:.3f} s: {estimate.status.name}, {inliers} inliers")
        truth.append(row_of(frame.stamp, frame.T_world_body))
    trajectory = slam.finish().trajectory
    assert trajectory is not None
    evaluation = vb.evaluate(np.array(truth), trajectory)
    print(f"ATE {1000 * evaluation.ate.rmse:.1f} mm over {evaluation.poses} poses")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "quick-loop")

#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""A localisation system in Python, by the wheels alone, judged by the bench as any SLAM system.

    wheel_odometry.py quick-loop
"""
import sys
from typing import Optional

import numpy as np

import vinebench as vb
from vinebench.trajectories import Array


class WheelOdometry:
    """Integrates the motion of four mecanum wheels: front left, front right, rear left, rear
    right."""

    def __init__(self) -> None:
        self.wheels = vb.Wheels(0.1, 0.19, 0.15)
        self.pose = np.eye(4)
        self.before: Optional[Array] = None

    def start(self, setup: vb.SystemSetup) -> None:
        """The nominal geometry of the wheels."""
        if setup.wheels is not None:
            self.wheels = setup.wheels

    def process(self, frame: vb.SensorFrame) -> vb.Estimate:
        """Integrates the readings since the frame before."""
        for reading in frame.wheels:
            angles = reading[1:5]
            if self.before is not None:
                self.pose = self.pose @ self.step(angles - self.before)
            self.before = angles
        return vb.Estimate(self.pose.copy(), vb.TrackingStatus.DEAD_RECKONING)

    def step(self, turned: Array) -> Array:
        """The body's motion while the wheels turned by these angles, rad."""
        front_left, front_right, rear_left, rear_right = self.wheels.radius / 4 * turned
        lever = self.wheels.half_track + self.wheels.half_wheelbase
        x = front_left + front_right + rear_left + rear_right
        y = -front_left + front_right + rear_left - rear_right
        turn = (-front_left + front_right - rear_left + rear_right) / lever
        T = np.eye(4)
        T[:2, :2] = [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
        # Along an arc: the chord is turned by half the angle.
        T[:2, 3] = [x * np.cos(turn / 2) - y * np.sin(turn / 2),
                    x * np.sin(turn / 2) + y * np.cos(turn / 2)]
        return T


def main(name: str) -> None:
    system = WheelOdometry()
    report = vb.run(name, slam=system)
    truth = report.trajectories.truth
    driven = np.linalg.norm(np.diff(truth[:, 1:3], axis=0), axis=1).sum()
    error = vb.evaluate(truth, report.trajectories.live).ate_origin.max
    print(f"WheelOdometry: error at most {1000 * error:.1f} mm, {driven:.2f} m driven")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "quick-loop")

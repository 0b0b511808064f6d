#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Closes the loop: the built-in core says where the rover is, a controller of a few lines drives it
along the scenario's route by that.

    drive.py quick-loop
"""
import argparse

import numpy as np

import vinebench as vb
from vinebench.trajectories import Array


def towards(goal: Array, T_world_body: Array, speed: float) -> Array:
    """A twist towards a waypoint (x, y, heading); the rover moves sideways as well as ahead."""
    offset = T_world_body[:2, :2].T @ (goal[:2] - T_world_body[:2, 3])
    distance = float(np.linalg.norm(offset))
    heading = np.arctan2(T_world_body[1, 0], T_world_body[0, 0])
    turn = np.remainder(goal[2] - heading + np.pi, 2 * np.pi) - np.pi
    pace = min(speed, 2 * distance) / max(distance, 1e-9)
    return np.array([*(pace * offset), np.clip(2 * turn, -1, 1)])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenario", nargs="?", default="quick-loop")
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--speed", type=float, default=0.4)
    arguments = parser.parse_args()
    simulation = vb.Simulation(arguments.scenario, set={"duration": arguments.seconds})
    slam = vb.Slam(simulation)
    waypoints = list(simulation.route[1:])
    _, info = simulation.reset()
    T_world_map = info["T_world_body"]  # where it starts is known; the rest is the core's
    ended = False
    while not ended and waypoints:
        estimate = slam.process(simulation.frame)
        if estimate.T_map_body is None:
            break
        T_world_body = T_world_map @ estimate.T_map_body
        if estimate.time == 0:  # a registered tag puts the map elsewhere
            T_world_map = T_world_map @ np.linalg.inv(estimate.T_map_body)
            T_world_body = info["T_world_body"]
        twist = towards(waypoints[0], T_world_body, arguments.speed)
        if np.linalg.norm(waypoints[0][:2] - T_world_body[:2, 3]) < 0.1:
            waypoints.pop(0)
        _, _, terminated, truncated, info = simulation.step(twist)
        ended = terminated or truncated
    happened = "collided" if info["collision"] else (
        "reached the end" if info["reached"] or not waypoints else "stopped")
    print(f"{happened} after {info['time']:.1f} s and {info['progress']:.2f} m of the route")


if __name__ == "__main__":
    main()

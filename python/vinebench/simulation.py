# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""A rover in a vineyard that is driven by commands, in the shape of Gymnasium's API."""
from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Callable, Optional, TypedDict

import numpy as np
import numpy.typing as npt

from vinebench._load import core
from vinebench._route import RouteProgress
from vinebench.trajectories import Array, PathLike

if TYPE_CHECKING:
    from vinebench._core import Frame, Rig

Image = npt.NDArray[np.uint8]


class Observation(TypedDict):
    """What the rover senses at an instant; fixed shapes."""

    images: dict[str, Image]
    """By camera, (h, w, 3) RGB. Zeros where the camera delivered none (info["delivered"])."""
    imu: Array
    """(6,): the latest reading, rad/s x y z, m/s^2 x y z, body axes; zeros before the first."""
    wheels: Array
    """(4,): likewise, rad/s of the front left, front right, rear left, rear right wheel."""


Reward = Callable[[Observation, dict[str, Any]], float]


def progress_reward(observation: Observation, info: dict[str, Any]) -> float:
    """The default: metres gained along the scenario's route since the last step, less 1 for a
    collision and for leaving the ground."""
    return float(info["gain"]) - (1.0 if info["collision"] or info["failure"] else 0.0)


class Simulation:
    """A scenario whose rover is driven by body twists in place of its route.

    A step drives through the physics until the next cameras' instant and then renders, so that the
    images are always those of the returned state. The same scenario, seed and twists give the same
    bytes, with any number of threads. For one thread at a time.
    """

    def __init__(self, scenario: PathLike, *, seed: Optional[int] = None,
                 set: Optional[Mapping[str, Any]] = None, randomise: Optional[PathLike] = None,
                 cameras: Sequence[str] = (), truth: Sequence[str] = (),
                 reward: Reward = progress_reward,
                 max_twist: tuple[float, float, float] = (1.0, 1.0, 1.5),
                 arrival: float = 0.2, threads: int = 2) -> None:
        """scenario, seed, set, randomise, cameras, truth, threads: as of Scenario. An episode is
            truncated at the scenario's `duration`, {"duration": 20} in s; it has no end without.
        reward: a function of the observation and the info after a step.
        max_twist: limits of the absolute twist: m/s forward, m/s to the left, rad/s to the left.
        arrival: m from the route's end, within which an episode has reached it.
        """
        self._drive = core.Drive(os.fspath(scenario), seed=seed, set=dict(set or {}),
                                 randomise=None if randomise is None else os.fspath(randomise),
                                 cameras=list(cameras), truth=list(truth), threads=threads)
        self._cameras = [camera for camera in self._drive.rig.cameras
                         if not cameras or camera.name in cameras]
        self._reward = reward
        self.max_twist = np.asarray(max_twist, dtype=np.float64)
        if self.max_twist.shape != (3,) or not (self.max_twist > 0).all():
            raise ValueError("max_twist: expected three positive numbers")
        self._progress = RouteProgress(self._drive.route[:, :2], arrival)
        self._running = False
        self._frame: Optional[Frame] = None
        self._observation: Optional[Observation] = None

    @property
    def rig(self) -> "Rig":
        """The nominal cameras of the rover."""
        return self._drive.rig

    @property
    def image_shapes(self) -> dict[str, tuple[int, int, int]]:
        """(h, w, 3) of each camera that an observation has."""
        return {camera.name: (camera.height, camera.width, 3) for camera in self._cameras}

    @property
    def period(self) -> float:
        """Time from one frame to the next, s."""
        return 1.0 / self._drive.rig.rate_hz

    @property
    def route(self) -> Array:
        """(n, 3): x, y [m], heading [rad] of the scenario's waypoints, in the world."""
        return self._drive.route

    @property
    def frame(self) -> "Frame":
        """The latest frame, with its truth and all readings."""
        if self._frame is None:
            raise core.Error("the simulation has no frame before the first reset()")
        return self._frame

    def reset(self, *, seed: Optional[int] = None, options: Optional[Mapping[str, Any]] = None
              ) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode: the rover stands at the start and the first frame is taken.

        seed: another vineyard, other sensors' noise; the same ones as before if None.
        options: {"start": (x, y [m], heading [rad])} in the world, in place of the route's start.

        Returns the observation and the info, as step(). Raises vinebench.Error for a start inside
        an obstacle.
        """
        given = dict(options or {})
        start = given.pop("start", None)
        if given:
            raise ValueError(f"options: expected start, found {', '.join(sorted(given))}")
        if start is not None:
            start = tuple(float(number) for number in start)
            if len(start) != 3:
                raise ValueError("options: start: expected x, y, heading")
        self._running = False
        frame = self._drive.reset(seed, start)
        self._progress = RouteProgress(self._drive.route[:, :2], self._progress.arrival)
        self._running = True
        return self._take(frame, np.zeros(3))

    def step(self, twist: npt.ArrayLike
             ) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Drives by a body twist until the next frame.

        twist: m/s forward, m/s to the left, rad/s to the left, within max_twist, else it is cut.

        Returns the observation, the reward, whether the episode has terminated (a collision, the
        rover left the ground that there is, or the route's end is reached), whether it is truncated
        (at `duration`), and the info:
            time [s], T_world_body (4, 4) [m], twist (3,) that was commanded, progress and gain [m]
            along the route, reached, collision (it touched something since the step began),
            delivered (by camera), failure (text, if the rover left the ground: the observation is
            then the last one before), seed.
        """
        if not self._running:
            raise core.Error("the episode has ended: call reset()")
        command = np.asarray(twist, dtype=np.float64)
        if command.shape != (3,):
            raise ValueError(f"twist: expected shape (3,), found {command.shape}")
        if not np.isfinite(command).all():
            raise ValueError("twist: expected finite numbers")
        command = np.clip(command, -self.max_twist, self.max_twist)
        try:
            frame = self._drive.step((float(command[0]), float(command[1]), float(command[2])))
        except core.Error as error:
            return self._fallen(command, str(error))
        if frame is None:
            self._running = False
            raise core.Error("the scenario's duration has ended: call reset()")
        observation, info = self._take(frame, command)
        terminated = bool(info["collision"] or info["reached"])
        last = self._drive.last_number
        truncated = last is not None and frame.number >= last
        self._running = not (terminated or truncated)
        return observation, self._reward(observation, info), terminated, truncated, info

    def _take(self, frame: "Frame", command: Array) -> tuple[Observation, dict[str, Any]]:
        self._frame = frame
        images = frame.images
        imu, wheels = frame.imu, frame.wheels
        before = self._observation if frame.number > 0 else None
        observation = Observation(
            images={name: _colour(images[name]) if name in images else np.zeros(shape, np.uint8)
                    for name, shape in self.image_shapes.items()},
            imu=imu[-1, 1:] if len(imu) else before["imu"] if before else np.zeros(6),
            wheels=wheels[-1, 5:] if len(wheels) else before["wheels"] if before else np.zeros(4))
        self._observation = observation
        info = self._info(frame, command)
        info["delivered"] = {name: name in images for name in self.image_shapes}
        return observation, info

    def _info(self, frame: "Frame", command: Array) -> dict[str, Any]:
        T_world_body = frame.T_world_body
        gain = self._progress.advance(T_world_body[:2, 3])
        return {"time": frame.time, "T_world_body": T_world_body, "twist": command,
                "progress": self._progress.distance, "gain": gain,
                "reached": self._progress.reached, "collision": bool(self._drive.collided),
                "failure": None, "seed": self._drive.seed}

    def _fallen(self, command: Array, reason: str
                ) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """The physics has no state to show: the last one stays."""
        assert self._observation is not None
        self._running = False
        info = self._info(self.frame, command)
        info["delivered"] = {name: True for name in self.image_shapes}
        info["failure"] = reason
        return self._observation, self._reward(self._observation, info), True, False, info


def _colour(image: Image) -> Image:
    """(h, w, 3), also of a grey camera."""
    return image if image.ndim == 3 else np.repeat(image[:, :, None], 3, axis=2)

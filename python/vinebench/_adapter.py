# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Between the bench and a SLAM system written in Python: checks and converts what it answers."""
from __future__ import annotations

import dataclasses
import math
import traceback
from typing import TYPE_CHECKING, Any, Callable, Optional, Protocol, TypeVar, Union

import numpy as np

from vinebench.slam import Estimate, SlamSummary, TrackingStatus
from vinebench.trajectories import Array, row_of

if TYPE_CHECKING:
    from vinebench._core import Rig, SensorFrame


_Answer = TypeVar("_Answer")


class SystemFailed(Exception):
    """A system under test has failed, as it says itself: the message is the failure's cause, without
    the place in the code."""


class SlamSystem(Protocol):
    """A SLAM system written in Python. Only `process` is required; `start(setup)`, called before
    the first frame with a SystemSetup, and `finish()`, which returns a SlamSummary, a trajectory
    (N, 8) or None, are called if they are there. If `stopped` is true after a frame, the run ends
    with it."""

    def process(self, frame: "SensorFrame", /) -> Union[Estimate, Array, None]:
        """The estimate at a frame: an Estimate, a pose T_map_body (4, 4) in m, or None."""


@dataclasses.dataclass(frozen=True, eq=False)
class RegisteredTag:
    """An AprilTag whose pose in the world is known beforehand."""

    family: str
    id: int
    size: float
    """Side of the black square, m."""
    T_world_tag: Array
    """(4, 4), m; tag frame: x right, y down on the printed face, z into the tag."""


@dataclasses.dataclass(frozen=True)
class Wheels:
    """The nominal geometry of the four mecanum wheels, whose upper rollers form an X from above."""

    radius: float
    """m"""
    half_track: float
    """m, body centre to wheel centre along y."""
    half_wheelbase: float
    """m, along x."""


@dataclasses.dataclass(frozen=True, eq=False)
class SystemSetup:
    """What a SLAM system is given before the first frame."""

    rig: "Rig"
    """Nominal: it differs from the true one if the scenario has calibration errors."""
    tags: tuple[RegisteredTag, ...]
    wheels: Optional[Wheels]
    threads: int
    """Available to it."""


def _counts(estimate: Estimate) -> dict[str, tuple[int, int, int, int]]:
    return {name: (int(c.features), int(c.stereo), int(c.matches), int(c.inliers))
            for name, c in estimate.cameras.items()}


class SystemAdapter:
    """What the extension calls; see python/systems.h. Remembers the first exception."""

    def __init__(self, system: SlamSystem) -> None:
        if not callable(getattr(system, "process", None)):
            raise TypeError(f"slam: expected an object with a method process(frame), found "
                            f"{type(system).__name__}")
        self._system = system
        self.name = type(system).__name__
        self.exception: Optional[BaseException] = None
        self._live: list[Array] = []

    def stopped(self) -> bool:
        """Whether the system wants the run to end."""
        return bool(getattr(self._system, "stopped", False))

    def start(self, setup: dict[str, Any]) -> None:
        """Passes the setup on."""
        start = getattr(self._system, "start", None)
        if start is None:
            return
        wheels = setup["wheels"]
        given = SystemSetup(rig=setup["rig"],
                            tags=tuple(RegisteredTag(**tag) for tag in setup["tags"]),
                            wheels=None if wheels is None else Wheels(*wheels),
                            threads=setup["threads"])
        self._guarded("start", lambda: start(given))

    def process(self, frame: "SensorFrame") -> dict[str, Any]:
        """The estimate as the extension reads it."""
        return self._guarded("process", lambda: self._entry(frame, self._system.process(frame)))

    def finish(self) -> dict[str, Any]:
        """The summary as the extension reads it."""
        finish = getattr(self._system, "finish", None)
        return self._guarded("finish", lambda: self._summary(finish() if finish else None))

    def _guarded(self, method: str, call: Callable[[], _Answer]) -> _Answer:
        """Calls and, where that raises, raises again with a message that says what and where."""
        try:
            return call()
        except Exception as error:
            self.exception = error
            if isinstance(error, SystemFailed):
                raise RuntimeError(f"{self.name}: {error}") from error
            place = traceback.extract_tb(error.__traceback__)[-1]
            raise RuntimeError(f"{self.name}.{method}: {type(error).__name__}: {error} "
                               f"({place.filename}:{place.lineno})") from error

    def _entry(self, frame: "SensorFrame", answer: Any) -> dict[str, Any]:
        estimate = answer if isinstance(answer, Estimate) else self._estimate(answer)
        pose = None if estimate.T_map_body is None else _pose(estimate.T_map_body)
        if pose is not None:
            self._live.append(row_of(frame.stamp, pose))
        closure = estimate.loop_closure
        return {"status": int(TrackingStatus(estimate.status)), "T_map_body": pose,
                "covariance": _covariance(estimate.covariance), "cameras": _counts(estimate),
                "keyframe": bool(estimate.keyframe),
                "loop_closure": None if closure is None else dataclasses.asdict(closure),
                "T_world_map": (None if estimate.T_world_map is None
                                else _pose(estimate.T_world_map, "T_world_map"))}

    def _estimate(self, pose: Any) -> Estimate:
        """Of a bare pose, or of none."""
        if pose is None and not self._live:
            return Estimate(status=TrackingStatus.INITIALIZING)
        return Estimate(T_map_body=pose)

    def _summary(self, answer: Any) -> dict[str, Any]:
        summary = answer if isinstance(answer, SlamSummary) else SlamSummary(trajectory=answer)
        live = np.array(self._live).reshape(-1, 8)
        keyframes = summary.keyframes
        return {"trajectory": live if summary.trajectory is None else summary.trajectory,
                "keyframes": np.zeros((0, 8)) if keyframes is None else keyframes,
                "landmarks": int(summary.landmarks), "T_world_map": summary.T_world_map}


def _pose(given: Any, name: str = "T_map_body") -> Array:
    """Checked here, so that the message has the place."""
    pose = np.asarray(given, dtype=np.float64)
    if pose.shape != (4, 4):
        raise ValueError(f"{name}: expected shape (4, 4), found {pose.shape}")
    R = pose[:3, :3]
    rigid = (np.isfinite(pose).all() and np.abs(R @ R.T - np.eye(3)).max() <= 1e-3
             and np.linalg.det(R) > 0 and np.abs(pose[3] - [0, 0, 0, 1]).max() <= 1e-3)
    if not rigid:
        raise ValueError(f"{name}: expected a rigid transform: a rotation matrix, a "
                         "translation, and 0, 0, 0, 1 in the last row")
    return pose


def _covariance(given: Any) -> Array:
    if given is None:
        return np.zeros((6, 6))
    covariance = np.asarray(given, dtype=np.float64)
    if covariance.shape != (6, 6):
        raise ValueError(f"covariance: expected shape (6, 6), found {covariance.shape}")
    if not math.isfinite(float(covariance.sum())):
        raise ValueError("covariance: expected finite numbers")
    return covariance

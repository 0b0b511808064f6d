# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Estimates of SLAM systems, and the built-in core."""
from __future__ import annotations

import dataclasses
import enum
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Optional, Union

from vinebench._load import core
from vinebench.trajectories import Array, PathLike

if TYPE_CHECKING:
    from vinebench._core import Frame, Rig, Scenario, SensorFrame
    from vinebench.simulation import Simulation


class TrackingStatus(enum.IntEnum):
    """How a pose came about."""

    INITIALIZING = 0
    """No map yet, or not yet found in a loaded one."""
    TRACKING = 1
    """By cameras."""
    DEAD_RECKONING = 2
    """By the wheels or the last velocity, with growing covariance."""
    LOST = 3
    """No pose."""


@dataclasses.dataclass(frozen=True)
class CameraCounts:
    """Features of one camera in a frame."""

    features: int = 0
    """Extracted."""
    stereo: int = 0
    """With a depth within the stereo limit (left cameras only)."""
    matches: int = 0
    """To landmarks of the map."""
    inliers: int = 0
    """Of these, consistent with the estimated pose."""


@dataclasses.dataclass(frozen=True, eq=False)
class TagSighting:
    """An AprilTag found in an image of a frame."""

    camera: str
    family: str
    id: int
    corners: Array
    """(4, 2), px: the tag's own lower left, then counter-clockwise as printed."""
    T_camera_tag: Array
    """(4, 4), m; tag frame: x right, y down on the printed face, z into the tag."""
    rejected: Optional[str]
    """"ambiguous", "misplaced", "duplicate", or None if it was not rejected."""


@dataclasses.dataclass(frozen=True, eq=False)
class LoopClosure:
    """A constraint to an earlier frame, found in this one."""

    earlier: int
    """ns, stamp of the frame that was recognised."""
    later: int
    """ns, stamp of the frame that recognised it."""
    T_earlier_later: Array
    """(4, 4), body to body, m."""
    tag_id: int = -1
    """-1 if it was not closed by a tag."""
    correction: float = 0.0
    """How far this frame's body moved, m."""


@dataclasses.dataclass(frozen=True, eq=False)
class Estimate:
    """The live estimate at one frame. A system of your own returns it with what it knows."""

    T_map_body: Optional[Array] = None
    """(4, 4), m: coordinates in the body (x forward, y left, z up) to the system's own map; None if
    not initialised or lost."""
    status: TrackingStatus = None  # type: ignore[assignment]
    """By default TRACKING with a pose, LOST without."""
    stamp: int = 0
    """ns, of the frame."""
    covariance: Optional[Array] = None
    """(6, 6), of T_map_body in the body frame: m, then rad; None or zeros if unknown."""
    cameras: Mapping[str, CameraCounts] = dataclasses.field(default_factory=dict)
    """By name."""
    tags: tuple[TagSighting, ...] = ()
    keyframe: bool = False
    loop_closure: Optional[LoopClosure] = None
    T_world_map: Optional[Array] = None
    """(4, 4), m: where this frame's map is in the world, by the registered tags seen until now."""

    def __post_init__(self) -> None:
        if self.status is None:
            known = TrackingStatus.LOST if self.T_map_body is None else TrackingStatus.TRACKING
            object.__setattr__(self, "status", known)

    @property
    def time(self) -> float:
        """The stamp in s."""
        return self.stamp * 1e-9


@dataclasses.dataclass(frozen=True, eq=False)
class SlamSummary:
    """The final result of a SLAM system, after all corrections."""

    trajectory: Optional[Array] = None
    """(N, 8): t [s], x y z [m], qx qy qz qw of T_map_body, of every frame that has a pose. A system
    of your own that gives None has its live poses judged."""
    keyframes: Optional[Array] = None
    """(K, 8), likewise."""
    landmarks: int = 0
    T_world_map: Optional[Array] = None
    """(4, 4), m: the system's own estimate of its map's place in the world, from registered tags."""


def estimate_of(entry: Mapping[str, Any]) -> Estimate:
    """The estimate that the extension gave as a dict."""
    closure = entry["loop_closure"]
    return Estimate(
        T_map_body=entry["T_map_body"], status=TrackingStatus(entry["status"]),
        stamp=entry["stamp"], covariance=entry["covariance"],
        cameras={name: CameraCounts(*counts) for name, counts in entry["cameras"].items()},
        tags=tuple(TagSighting(**tag) for tag in entry["tags"]), keyframe=entry["keyframe"],
        loop_closure=None if closure is None else LoopClosure(**closure),
        T_world_map=entry["T_world_map"])


def flat_settings(settings: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Nested settings by dotted key."""
    flat: dict[str, Any] = {}
    for key, value in settings.items():
        if isinstance(value, Mapping):
            flat.update(flat_settings(value, f"{prefix}{key}."))
        else:
            flat[f"{prefix}{key}"] = value
    return flat


class Slam:
    """The built-in SLAM core, frame by frame, in lockstep: everything that a frame starts is
    finished when its estimate is returned."""

    def __init__(self, rig: Union[PathLike, "Rig", "Scenario", "Simulation"], *,
                 settings: Optional[Mapping[str, Any]] = None,
                 threads: Optional[int] = None) -> None:
        """rig: a rig's file or name, a Rig, or a Scenario or Simulation, whose cameras (nominal),
            registered tags, wheels and SLAM settings are taken.
        settings: keys of the scenario's `slam`, nested or dotted: {"tracking": {"window": 20}} or
            {"tracking.window": 20}.
        threads: number of worker threads, all processors' by default; changes no result.

        Raises vinebench.Error for a rig without a stereo pair and for settings that are none.
        """
        count = threads or os.cpu_count() or 1
        flat = flat_settings(settings or {})
        drive = getattr(rig, "_drive", None)
        if drive is not None:
            self._core = core.Slam.of_drive(drive, flat, count)
        elif isinstance(rig, core.Scenario):
            self._core = core.Slam.of_scenario(rig, flat, count)
        else:
            given = rig if isinstance(rig, core.Rig) else core.Rig.load(
                core.rig_file(os.fspath(rig)))  # type: ignore[arg-type]
            self._core = core.Slam.of_rig(given, flat, count)

    @property
    def rig(self) -> "Rig":
        """The rig that it was given."""
        return self._core.rig

    def process(self, frame: Union["Frame", "SensorFrame"]) -> Estimate:
        """The estimate at the next frame, in order of the stamps.

        frame: of a Scenario or Simulation, or SensorFrame(stamp, images, imu=..., wheels=...). Of a
        Frame only the sensors' data are used, not its truth. The GIL is released.

        Raises ValueError for stamps that do not ascend and for images of another size than the
        camera's, TypeError for other objects.
        """
        return estimate_of(self._core.process(frame))

    def finish(self) -> SlamSummary:
        """Completes pending work and returns the result; the end of this system."""
        return SlamSummary(**self._core.finish())

    def load_map(self, file: PathLike) -> None:
        """Goes on with a map that save_map wrote; before the first frame."""
        self._core.load_map(os.fspath(file))

    def save_map(self, file: PathLike) -> None:
        """Writes the map as it is now."""
        self._core.save_map(os.fspath(file))

    def save_cloud(self, file: PathLike) -> None:
        """Writes the landmarks as a point cloud in PLY format."""
        self._core.save_cloud(os.fspath(file))

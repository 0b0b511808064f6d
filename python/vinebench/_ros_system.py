# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""A SLAM system on topics of ROS 2 as one of the bench."""
from __future__ import annotations

import bisect
import dataclasses
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Optional, Protocol

import numpy as np

from vinebench._adapter import SystemFailed
from vinebench._ros_poses import PoseFrames, ReceivedPose, matrix_of, nanoseconds, received
from vinebench.slam import Estimate, SlamSummary, TrackingStatus
from vinebench.trajectories import Array, row_of

if TYPE_CHECKING:
    from vinebench._core import RosMessages, SensorFrame

_NEAR = 100_000  # ns: stamps that went through a double, or through microseconds


class Node(Protocol):
    """What is needed of Topics."""

    def publish(self, topic: str, message: bytes) -> None: ...
    def spin(self, until: float, done: Callable[[], bool] = ...) -> bool: ...
    def publishers_of(self, topic: str) -> int: ...


@dataclasses.dataclass(frozen=True)
class Pace:
    """When frames are published, and how long answers are waited for."""

    rate: Optional[float] = None
    """Times real time; None in lockstep."""
    lag: int = 0
    """In lockstep, how many frames later a pose may come."""
    timeout: float = 2.0
    """s of wall time for the pose of a frame; at a rate, for the last one."""
    give_up: float = 60.0
    """s of wall time without any pose, after which the system has failed."""

    @property
    def live(self) -> bool:
        """Whether each frame's pose is known before the next frame is published."""
        return self.rate is None and self.lag == 0


class Ros2System:
    """Publishes each frame and takes the poses for the frames' stamps. In lockstep they are the live
    estimates; else these are not known, and the final trajectory is judged in their place."""

    def __init__(self, node: Node, messages: "RosMessages", topic: str, frames: PoseFrames,
                 pace: Pace) -> None:
        self._node, self._messages, self._topic = node, messages, topic
        self._frames, self._pace = frames, pace
        self._published: dict[int, float] = {}  # stamps of the frames, ascending: wall time
        self._stamps: list[int] = []
        self._poses: dict[int, ReceivedPose] = {}  # by stamp, the latest
        self._path: Optional[list[tuple[int, Array]]] = None
        self._map: Optional[str] = None
        self._problem: Optional[SystemFailed] = None
        self._begin: Optional[tuple[float, int]] = None  # wall time of the first frame's stamp
        self._heard = 0.0  # when the latest pose came
        self.late = 0.0
        """s of wall time, by which a frame was later than the rate asks for, at most."""
        self.latencies: list[float] = []
        """s of wall time from a frame to its first pose."""
        self.stopped = False
        """Ends the run after the frame."""

    def take(self, message: Any) -> None:
        """A message of the pose topic."""
        now = time.monotonic()
        try:
            pose = received(message, self._frames)
            if self._map is not None and pose.frame != self._map:
                raise SystemFailed(f"expected poses in frame '{self._map}' as before, found "
                                   f"'{pose.frame}'")
        except SystemFailed as problem:
            self._problem = self._problem or SystemFailed(f"{self._topic}: {problem}")
            return
        self._map, self._heard = pose.frame, now
        stamp = self._stamp_of(pose.time)
        if stamp is None:
            return
        if stamp not in self._poses:
            self.latencies.append(now - self._published[stamp])
        self._poses[stamp] = pose

    def take_path(self, message: Any) -> None:
        """A message of the path topic: the whole trajectory as it is corrected now."""
        try:
            entries = [(self._stamp_of(nanoseconds(entry.header.stamp)), matrix_of(entry.pose))
                       for entry in message.poses]
        except SystemFailed as problem:
            self._problem = self._problem or problem
            return
        inverse = np.linalg.inv(self._frames.T_body_child)
        # The latest of a stamp; poses at other stamps than a frame's are no frame's.
        known = {stamp: pose @ inverse for stamp, pose in entries
                 if stamp is not None and pose is not None}
        self._path = sorted(known.items(), key=lambda entry: entry[0])

    def process(self, frame: "SensorFrame") -> Estimate:
        """Publishes the frame; in lockstep, waits for the pose."""
        if self._begin is None:
            self._begin = (time.monotonic(), frame.stamp)
            self._heard = self._begin[0]
        self._stamps.append(frame.stamp)
        self._publish(frame)
        if self._pace.rate is None and len(self._stamps) > self._pace.lag:
            self._wait([self._stamps[-1 - self._pace.lag]])
        else:
            self._node.spin(0)
        if self._problem is not None:
            raise self._problem
        if not self._answered(frame.stamp) and not self.stopped:
            self._give_up()
        pose = self._poses.get(frame.stamp)
        if self._pace.live and pose is not None and pose.T_map_body is not None:
            return Estimate(pose.T_map_body, covariance=pose.covariance)
        lost = self._pace.live and self._map is not None
        return Estimate(status=TrackingStatus.LOST if lost else TrackingStatus.INITIALIZING)

    def finish(self) -> SlamSummary:
        """Every frame's latest pose, or the path."""
        if not self._pace.live and not self.stopped:
            self._wait(self._stamps[-1 - self._pace.lag:])
        if self._problem is not None:
            raise self._problem
        if not self._poses and self._path is None and not self.stopped:
            raise SystemFailed(f"{self._topic}: no pose of a frame ever came in")
        rows = [row_of(stamp, pose.T_map_body) for stamp, pose in sorted(self._poses.items())
                if pose.T_map_body is not None]
        if self._path is not None:
            rows = [row_of(stamp, pose) for stamp, pose in self._path]
        return SlamSummary(trajectory=np.array(rows).reshape(-1, 8))

    def _publish(self, frame: "SensorFrame") -> None:
        """At once; at a rate, each message at its time."""
        for topic, at, message in self._messages.of_frame(frame):
            if self._pace.rate is not None:
                assert self._begin is not None
                begin, stamp = self._begin
                due = begin + (at - self._messages.start - stamp) * 1e-9 / self._pace.rate
                self._node.spin(due)
                self.late = max(self.late, time.monotonic() - due)
            self._published[frame.stamp] = time.monotonic()
            self._node.publish(topic, message)

    def _stamp_of(self, received_time: int) -> Optional[int]:
        """The frame's that a message's time means."""
        wanted = received_time - self._messages.start
        after = bisect.bisect_left(self._stamps, wanted - _NEAR)
        if after == len(self._stamps) or self._stamps[after] > wanted + _NEAR:
            return None
        return self._stamps[after]

    def _answered(self, stamp: int) -> bool:
        return stamp in self._poses

    def _wait(self, stamps: list[int]) -> None:
        self._node.spin(time.monotonic() + self._pace.timeout,
                        lambda: (self._problem is not None or all(map(self._answered, stamps))
                                 or self._node.publishers_of(self._topic) == 0))

    def _give_up(self) -> None:
        """Fails if it is of no use to go on."""
        if self._node.publishers_of(self._topic) == 0:
            raise SystemFailed(f"{self._topic}: its publisher is gone")
        waited = time.monotonic() - self._heard
        if waited > self._pace.give_up:
            what = "no pose ever came in" if self._map is None else "no pose for"
            raise SystemFailed(f"{self._topic}: {what} {waited:.0f} s "
                               f"({len(self._stamps)} frames were published)")

# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Poses of ROS 2's messages as those of the bench. Needs no ROS: any object with a message's fields
will do."""
from __future__ import annotations

import dataclasses
import math
from typing import Any, Optional

import numpy as np

from vinebench._adapter import SystemFailed
from vinebench.trajectories import Array, row_of, to_matrices

BODY = "base_link"
TYPES = ("geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PoseWithCovarianceStamped",
         "nav_msgs/msg/Odometry")
_UNIT = 1e-3  # a quaternion's length may differ from 1 by so much
_NS = 10**9


@dataclasses.dataclass(frozen=True)
class PoseFrames:
    """What the poses of a system under test are of."""

    T_body_child: Array
    """(4, 4), m: the identity, or where the camera is whose pose it is."""
    children: frozenset[str] = frozenset({BODY, ""})
    """What an Odometry's child_frame_id may be."""
    map: Optional[str] = None
    """What a header's frame_id must be; any if None."""


@dataclasses.dataclass(frozen=True, eq=False)
class ReceivedPose:
    """A pose of the body; none where the system says that it has none."""

    time: int
    """ns, of the header."""
    frame: str
    T_map_body: Optional[Array]
    covariance: Optional[Array]
    """(6, 6), in the body frame: m, then rad."""


def nanoseconds(stamp: Any) -> int:
    """Of a builtin_interfaces/Time."""
    return int(stamp.sec) * _NS + int(stamp.nanosec)


def matrix_of(pose: Any) -> Optional[Array]:
    """The transform (4, 4) of a geometry_msgs/Pose; None if a number of it is not finite, by which a
    system says that it has no pose. Raises SystemFailed for a quaternion that is not of unit
    length."""
    p, q = pose.position, pose.orientation
    numbers = [p.x, p.y, p.z, q.x, q.y, q.z, q.w]
    if not all(math.isfinite(number) for number in numbers):
        return None
    length = math.sqrt(sum(number * number for number in numbers[3:]))
    if abs(length - 1) > _UNIT:
        raise SystemFailed(f"expected an orientation of unit length, found ({q.x:g}, {q.y:g}, "
                           f"{q.z:g}, {q.w:g})")
    unit = [number / length for number in numbers[3:]]
    matrix: Array = to_matrices(np.array([[0.0, *numbers[:3], *unit]]))[0]
    return matrix


def pose_of(matrix: Array) -> tuple[list[float], list[float]]:
    """Position and orientation (x, y, z, w) of a transform (4, 4), for a geometry_msgs/Pose."""
    row = row_of(0, matrix)
    return row[1:4].tolist(), row[4:].tolist()


def body_covariance(given: Any, R_map_child: Array, T_body_child: Array) -> Optional[Array]:
    """The covariance (6, 6) of T_map_body in the body frame, from the 36 numbers of a
    PoseWithCovariance, which are along the axes of the header's frame. None if it is not known: all
    0, or not a covariance."""
    C = np.asarray(given, dtype=np.float64).reshape(6, 6)
    if not np.isfinite(C).all() or not C.any() or (np.diag(C) < 0).any():
        return None
    turn = np.kron(np.eye(2), R_map_child.T)  # to the child's axes
    R, t = T_body_child[:3, :3], T_body_child[:3, 3]
    cross = np.array([[0, -t[2], t[1]], [t[2], 0, -t[0]], [-t[1], t[0], 0]])
    adjoint = np.block([[R, cross @ R], [np.zeros((3, 3)), R]])
    J = adjoint @ turn
    covariance: Array = J @ C @ J.T
    return covariance


def received(message: Any, frames: PoseFrames) -> ReceivedPose:
    """Of a PoseStamped, PoseWithCovarianceStamped or Odometry. Raises SystemFailed for a pose in
    another frame, or of another one, than expected."""
    header = message.header
    if frames.map is not None and header.frame_id != frames.map:
        raise SystemFailed(f"expected poses in frame '{frames.map}', found '{header.frame_id}'")
    child = getattr(message, "child_frame_id", "")
    if child not in frames.children:
        wanted = " or ".join(f"'{name}'" for name in sorted(frames.children) if name)
        raise SystemFailed(f"expected poses of {wanted}, found child_frame_id '{child}' "
                           f"(--pose-of, --child-frame)")
    covariance = getattr(message.pose, "covariance", None)
    pose = message.pose if covariance is None else message.pose.pose
    T_map_child = matrix_of(pose)
    time = nanoseconds(header.stamp)
    if T_map_child is None:
        return ReceivedPose(time, header.frame_id, None, None)
    known = (None if covariance is None else
             body_covariance(covariance, T_map_child[:3, :3], frames.T_body_child))
    # Exactly the pose that was sent where it is the body's.
    T_map_body = (T_map_child if np.array_equal(frames.T_body_child, np.eye(4)) else
                  T_map_child @ np.linalg.inv(frames.T_body_child))
    return ReceivedPose(time, header.frame_id, T_map_body, known)

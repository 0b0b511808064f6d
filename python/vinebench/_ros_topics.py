# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The node of the bridge: its topics, and those of the system under test. The only file that knows
rclpy."""
from __future__ import annotations

import importlib
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Optional

from vinebench._load import core
from vinebench._ros_poses import TYPES

INSTALL = ("source the setup.bash of ROS 2, or install python/ros2-requirements.txt with pip "
           "(docs/ros2.md)")
_SETTLED = 0.5  # s without a new subscription, before the first frame
_SLICE = 0.05  # s, after which a wait looks at the interruption
# Messages that wait for a slow subscriber: readings since the frame before come at once.
_DEPTH = {"sensor_msgs/msg/Imu": 1000, "sensor_msgs/msg/JointState": 1000,
          "rosgraph_msgs/msg/Clock": 1000}
_USUAL_DEPTH = 10


def _rclpy() -> Any:
    try:
        return importlib.import_module("rclpy")
    except ImportError as error:
        reason = str(error).splitlines()[0]
        raise core.Error(f"rclpy cannot be imported ({reason}): {INSTALL}") from error


def _message_type(name: str) -> Any:
    """The class of "sensor_msgs/msg/Image"; None if it is not installed, or only that of ROS 1."""
    package, _, kind = name.split("/")
    try:
        found = getattr(importlib.import_module(f"{package}.msg"), kind)
    except (ImportError, AttributeError):
        return None
    return found if hasattr(found, "get_fields_and_field_types") else None


def _required_type(name: str) -> Any:
    found = _message_type(name)
    if found is None:
        raise core.Error(f"{name}: this message type of ROS 2 is not installed: {INSTALL}")
    return found


def has_transforms() -> bool:
    """Whether tf2_msgs is installed, which PyPI lacks."""
    return _message_type("tf2_msgs/msg/TFMessage") is not None


class Topics:
    """Publishes messages in CDR, and takes those of the system under test."""

    def __init__(self, interrupted: Callable[[], bool]) -> None:
        self._rclpy = _rclpy()
        self._interrupted = interrupted
        self._publishers: dict[str, Any] = {}
        self._latched: set[str] = set()
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.signals import SignalHandlerOptions
        try:
            self._rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
            self._node = self._rclpy.create_node("vinebench")
            self._executor = SingleThreadedExecutor()
            self._executor.add_node(self._node)
        except Exception as error:  # no middleware, say
            raise core.Error(f"rclpy: {str(error).splitlines()[0]}: {INSTALL}") from error

    def close(self) -> None:
        """Ends the node."""
        self._executor.shutdown()
        self._node.destroy_node()
        self._rclpy.try_shutdown()

    def advertise(self, topics: Iterable[tuple[str, str, bool]]) -> None:
        """Topic, type, whether it is latched."""
        from rclpy.qos import DurabilityPolicy, QoSProfile
        for topic, kind, latched in topics:
            quality = QoSProfile(depth=_DEPTH.get(kind, _USUAL_DEPTH))
            if latched:
                self._latched.add(topic)
                quality = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
            self._publishers[topic] = self._node.create_publisher(_required_type(kind), topic,
                                                                  quality)

    def publish(self, topic: str, message: bytes) -> None:
        """If the topic is advertised and somebody listens, or may later."""
        publisher = self._publishers.get(topic)
        if publisher is not None and (topic in self._latched
                                      or publisher.get_subscription_count() > 0):
            publisher.publish(message)

    def spin(self, until: float, done: Callable[[], bool] = lambda: False) -> bool:
        """Takes messages until a time of time.monotonic(), or until it is done or interrupted;
        returns whether it is done."""
        while not done() and not self._interrupted():
            left = until - time.monotonic()
            if left <= 0:
                return done()
            self._executor.spin_once(timeout_sec=min(left, _SLICE))
        return done()

    def publishers_of(self, topic: str) -> int:
        return int(self._node.count_publishers(topic))

    def subscribe(self, topic: str, kinds: Sequence[str], seconds: float,
                  take: Callable[[Any], None]) -> str:
        """Subscribes once somebody publishes the topic, with a type of these and the publisher's
        reliability. Returns the type. Raises Error if nobody does within the time, and for other
        types."""
        self.spin(time.monotonic() + seconds, lambda: self.publishers_of(topic) > 0)
        infos = self._node.get_publishers_info_by_topic(topic)
        if not infos:
            raise core.Error(f"{topic}: no node publishes it (waited {seconds:g} s): is the system "
                             f"running, with the same ROS_DOMAIN_ID, and its topic remapped?")
        found = sorted({info.topic_type for info in infos})
        if len(found) > 1 or found[0] not in kinds:
            raise core.Error(f"{topic}: expected {' or '.join(kinds)}, found "
                             f"{' and '.join(found)}")
        from rclpy.qos import QoSProfile, ReliabilityPolicy
        quality = QoSProfile(depth=_USUAL_DEPTH)
        if any(info.qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT for info in infos):
            quality.reliability = ReliabilityPolicy.BEST_EFFORT
        self._node.create_subscription(_required_type(found[0]), topic, take, quality)
        return str(found[0])

    def expect_subscribers(self, seconds: float) -> None:
        """Waits until somebody subscribes to our topics, and for a while nobody more does. Raises
        Error if nobody does."""
        end = time.monotonic() + seconds
        count = self._subscriptions()
        while not self._interrupted():
            changed = self.spin(min(time.monotonic() + _SETTLED, max(end, time.monotonic())),
                                lambda: self._subscriptions() != count)
            count = self._subscriptions()
            if not changed and count > 0:
                return
            if time.monotonic() >= end:
                raise core.Error(f"no node subscribes to sensor data (waited {seconds:g} s): "
                                 f"{' '.join(self._sensors())}")

    def _sensors(self) -> list[str]:
        return [topic for topic in self._publishers
                if topic not in ("/clock", "/tf", "/tf_static", "/ground_truth")]

    def _subscriptions(self) -> int:
        return sum(self._publishers[topic].get_subscription_count() for topic in self._sensors())


def pose_types(wanted: Optional[str]) -> Sequence[str]:
    """All that are understood, or the one that is named, such as "Odometry"."""
    if wanted is None:
        return TYPES
    return [name for name in TYPES if name.rsplit("/", 1)[1] == wanted]


def tell(text: str) -> None:
    """A notice on standard error."""
    print(f"vinebench.ros2: {text}", file=sys.stderr, flush=True)

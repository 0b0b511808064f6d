#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""A localisation node for ROS 2, by the wheels alone: answers each image of a camera with the pose of
the body at its stamp. The shape of a SLAM node, in some lines.

    wheel_odometry.py &
    python -m vinebench.ros2 quick-loop

Parameters (--ros-args -p NAME:=VALUE): camera, image; type (PoseStamped, PoseWithCovarianceStamped,
Odometry); wheel_rate, Hz; radius, lever: of the wheels, m.
"""
import bisect
import math

import rclpy
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile
from sensor_msgs.msg import Image, JointState

TYPES = {kind.__name__: kind for kind in (PoseStamped, PoseWithCovarianceStamped, Odometry)}
READINGS = QoSProfile(depth=1000)  # those since the frame before come at once


def nanoseconds(header):
    return header.stamp.sec * 10**9 + header.stamp.nanosec


class WheelOdometry(Node):
    """Integrates the wheels' angles: front left, front right, rear left, rear right."""

    def __init__(self):
        super().__init__("wheel_odometry")
        self.type = TYPES[self.declare_parameter("type", "PoseStamped").value]
        self.radius = self.declare_parameter("radius", 0.1).value
        self.lever = self.declare_parameter("lever", 0.34).value  # half track + half wheelbase
        self.period = int(1e9 / self.declare_parameter("wheel_rate", 100.0).value)  # ns
        camera = self.declare_parameter("camera", "front_left").value
        image = self.declare_parameter("image", "image_rect").value
        self.pose = (0.0, 0.0, 0.0)  # x, y, heading in the map
        self.before, self.begun, self.latest = None, False, 0
        self.images, self.readings = [], []  # headers; stamps and angles, that wait for each other
        self.publisher = self.create_publisher(self.type, "/slam/pose", 10)
        self.create_subscription(JointState, "/joint_states", self.on_wheels, READINGS)
        self.create_subscription(Image, f"/{camera}/{image}", self.on_image, 10)

    def on_wheels(self, message):
        self.latest = nanoseconds(message.header)
        self.readings.append((self.latest, list(message.position)))
        self.answer()

    def on_image(self, message):
        self.images.append(message.header)
        self.answer()

    def answer(self):
        """Topics come in any order: an image waits for the wheels' last reading until its stamp,
        after which the next one would be later. The first image begins the map."""
        while self.images:
            stamp = nanoseconds(self.images[0])
            if self.begun and self.latest + self.period <= stamp:
                return
            self.begun = True
            count = bisect.bisect_right([time for time, _ in self.readings], stamp)
            for _, angles in self.readings[:count]:
                self.integrate(angles)
            del self.readings[:count]
            self.publish(self.images.pop(0))

    def integrate(self, angles):
        before, self.before = self.before or angles, angles
        fl, fr, rl, rr = (self.radius / 4 * (now - then) for now, then in zip(angles, before))
        forward, left = fl + fr + rl + rr, -fl + fr + rl - rr
        turn = (-fl + fr - rl + rr) / self.lever
        x, y, heading = self.pose
        chord = heading + turn / 2  # the chord of an arc is turned by half the angle
        self.pose = (x + forward * math.cos(chord) - left * math.sin(chord),
                     y + forward * math.sin(chord) + left * math.cos(chord), heading + turn)

    def publish(self, header):
        message = self.type()
        message.header.stamp, message.header.frame_id = header.stamp, "map"
        if isinstance(message, Odometry):
            message.child_frame_id = "base_link"
        pose = message.pose if isinstance(message, PoseStamped) else message.pose.pose
        pose.position.x, pose.position.y = self.pose[:2]
        pose.orientation.z = math.sin(self.pose[2] / 2)
        pose.orientation.w = math.cos(self.pose[2] / 2)
        self.publisher.publish(message)


def main():
    rclpy.init()
    try:
        rclpy.spin(WheelOdometry())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == "__main__":
    main()

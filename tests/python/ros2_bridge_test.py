# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The bridge with rclpy: `python -m vinebench.ros2` in one process, a node in another one. Skipped
where rclpy is not installed (python/ros2-requirements.txt)."""
import contextlib
import hashlib
import importlib.util
import json
import math
import os
import re
import signal
import subprocess
import sys
import time
from types import SimpleNamespace as Fields

import numpy as np

import vinebench as vb
from support import FRAMES, ROOT, CourtTest, main
from vinebench._ros_poses import matrix_of

# Of this test alone, if several run on the machine.
os.environ["ROS_DOMAIN_ID"] = str(1 + os.getpid() % 100)
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
NODE = ROOT / "examples/ros2/wheel_odometry.py"
WAIT = 60  # s, for what comes at once if it comes

# Publishes another type than a pose's.
TALKER = """import rclpy, std_msgs.msg
rclpy.init()
node = rclpy.create_node("talker")
publisher = node.create_publisher(std_msgs.msg.String, "/slam/pose", 10)
rclpy.spin(node)
"""

# Writes each image's hash, and the true positions, to standard output.
WATCHER = """import hashlib, rclpy
from nav_msgs.msg import Odometry
from rclpy.qos import QoSProfile
from sensor_msgs.msg import Image
rclpy.init()
node = rclpy.create_node("watcher")
deep = QoSProfile(depth=1000)
for name in ("left", "right"):
    node.create_subscription(Image, f"/{name}/image_rect", lambda m, name=name: print(
        "image", name, m.header.stamp.sec * 10**9 + m.header.stamp.nanosec, m.encoding,
        hashlib.sha256(m.data).hexdigest(), flush=True), deep)
node.create_subscription(Odometry, "/ground_truth", lambda m: print(
    "truth", m.pose.pose.position.x, flush=True), deep)
node.create_timer(0.2, lambda: print("topics", *[t for t, _ in node.get_topic_names_and_types()],
                                     flush=True))
rclpy.spin(node)
"""


@contextlib.contextmanager
def process(*arguments):
    """A node that is ended by ^C; its output is in `text` then."""
    started = subprocess.Popen([sys.executable, *map(str, arguments)], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    try:
        yield started
    finally:
        started.send_signal(signal.SIGINT)
        started.text, started.errors = started.communicate(timeout=WAIT)


def odometry_node(**parameters):
    given = {"camera": "left", **parameters}
    options = [word for name, value in given.items() for word in ("-p", f"{name}:={value}")]
    return process(NODE, "--ros-args", *options)


class Direct:
    """The node's algorithm in this process."""

    def __init__(self):
        spec = importlib.util.spec_from_file_location("wheel_odometry", NODE)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        self.integrate = module.WheelOdometry.integrate
        self.state = Fields(radius=0.1, lever=0.34, before=None, pose=(0.0, 0.0, 0.0))

    def process(self, frame):
        for reading in frame.wheels:
            self.integrate(self.state, reading[1:5].tolist())
        x, y, heading = self.state.pose
        return matrix_of(Fields(position=Fields(x=x, y=y, z=0.0),
                                orientation=Fields(x=0.0, y=0.0, z=math.sin(heading / 2),
                                                   w=math.cos(heading / 2))))


class BridgeTest(CourtTest):
    def bridge(self, *arguments):
        return subprocess.run([sys.executable, "-m", "vinebench.ros2", self.court, "--timeout", "30",
                               *map(str, arguments)], capture_output=True, text=True, timeout=300)

    def passed(self, *arguments):
        done = self.bridge(*arguments)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, rf"court \(seed 5\): PASSED, {FRAMES} frames, hash [0-9a-f]+\n")
        return re.search(r"hash (\w+)", done.stdout)[1]

    def refused(self, words, *arguments):
        done = self.bridge(*arguments)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        notices = ("tf2_msgs of ROS 2", "/slam/pose: geometry_msgs/msg/PoseStamped")
        told = [line for line in done.stderr.splitlines()
                if not line.startswith(tuple(f"vinebench.ros2: {notice}" for notice in notices))]
        self.assertEqual(len(told), 1, told)
        self.assertRegex(told[0], rf"^vinebench.ros2: {words}")

    def test_lockstep_has_the_same_hash_twice_and_that_of_the_system_in_python(self):
        with odometry_node():
            first = self.passed("--out", self.folder / "first")
        with odometry_node():
            again = self.passed()
        report = vb.run(self.court, slam=Direct())
        self.assertEqual({first, again}, {report.hash})
        metrics = json.loads((self.folder / "first/metrics.json").read_text())
        self.assertEqual(metrics["hash"], report.hash)
        live = vb.read_tum(self.folder / "first/estimate_live.tum")
        np.testing.assert_allclose(live, report.trajectories.live, rtol=0, atol=1e-9)

    def test_all_types_and_paces(self):
        for kind in ("Odometry", "PoseWithCovarianceStamped"):
            with odometry_node(type=kind):
                self.passed("--pose-type", kind)
        with odometry_node():
            self.passed("--rate", 2)
        with odometry_node():
            self.passed("--lag", 1, "--map-frame", "map")

    # What a node receives is what the bench made, and the truth where it is asked for.
    def test_messages_arrive_whole_and_the_truth_only_on_request(self):
        expected = {}
        scenario = vb.Scenario(self.court)
        frames = list(scenario)
        for frame in frames:
            for name, image in frame.images.items():
                expected[(name, str(10**9 + frame.stamp))] = (
                    "rgb8", hashlib.sha256(np.ascontiguousarray(image)).hexdigest())
        for truth in ([], ["--truth"]):
            with process("-c", WATCHER) as watcher, odometry_node():
                self.passed("--colour", *truth)
                time.sleep(0.5)  # the last truth
            lines = [line.split() for line in watcher.text.splitlines()]
            images = {tuple(line[1:3]): tuple(line[3:]) for line in lines if line[0] == "image"}
            self.assertEqual(images, expected)
            found = [float(line[1]) for line in lines if line[0] == "truth"]
            told = {topic for line in lines if line[0] == "topics" for topic in line[1:]}
            self.assertIn("/imu", told)
            self.assertNotIn("/tf" if not truth else "", told)
            wanted = [frame.T_world_body[0, 3] for frame in frames] if truth else []
            self.assertEqual(found, wanted)

    def test_errors_are_one_line(self):
        self.refused("/slam/pose: no node publishes it", "--wait", 0.5)
        with process("-c", TALKER):
            self.refused("/slam/pose: expected geometry_msgs/msg/PoseStamped or .*, found "
                         "std_msgs/msg/String", "--wait", WAIT)
        with odometry_node(camera="none"):  # it waits for images that nobody publishes
            self.refused("/slam/pose: expected nav_msgs/msg/Odometry, found geometry_msgs",
                         "--pose-type", "Odometry", "--wait", WAIT)
        self.refused("--pose-of: expected one of base_link, left, right, found 'top'",
                     "--pose-of", "top")
        with odometry_node():
            (self.folder / "file").write_text("")
            self.refused(".*file", "--out", self.folder / "file")

    def test_a_node_that_answers_nothing_fails(self):
        with odometry_node(camera="none"):
            done = self.bridge("--timeout", 0.2, "--give-up", 0.5)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"Ros2System: /slam/pose: no pose ever came in \d+ s")

    def test_an_interrupt_leaves_what_there_is(self):
        out = self.folder / "stopped"
        with odometry_node():
            started = subprocess.Popen(
                [sys.executable, "-m", "vinebench.ros2", self.court, "--timeout", "30", "--out", out,
                 "--set", "duration=60", "--rate", "1"],
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            for line in started.stderr:
                if re.search(r"frame [5-9]\d?/", line):
                    break
            started.send_signal(signal.SIGINT)
            text, errors = started.communicate(timeout=WAIT)
        self.assertEqual(started.returncode, 130, text + errors)
        self.assertRegex(errors, r"stopped after \d+ frames; what there is of them is in ")
        self.assertGreater(len(vb.read_tum(out / "estimate.tum")), 3)
        self.assertFalse((out / "metrics.json").exists())


if __name__ == "__main__":
    if importlib.util.find_spec("rclpy") is None:
        print("rclpy is not installed: skipped")
        sys.exit(77)
    main()

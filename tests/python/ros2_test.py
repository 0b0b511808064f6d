# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The bridge to ROS 2 without ROS: messages of frames, poses of messages, waiting for poses."""
import math
import struct
import subprocess
import sys
import time
from types import SimpleNamespace as Fields

import numpy as np

import vinebench as vb
from support import FRAMES, CourtTest, main
from vinebench import _core
from vinebench._ros_poses import PoseFrames, body_covariance, matrix_of, pose_of, received
from vinebench._ros_system import Pace, Ros2System
from vinebench.ros2 import arguments_parser, pose_frames

START = 10**9  # ns, of stamp 0
HALF = math.sqrt(0.5)


def transform(x=0.0, y=0.0, z=0.0, R=np.eye(3)):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, (x, y, z)
    return T


QUARTER = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])  # a quarter turn to the left
OPTICAL = np.array([[0.0, 0, 1], [-1, 0, 0], [0, -1, 0]])  # looks ahead


def header(stamp, frame="map"):
    return Fields(stamp=Fields(sec=(START + stamp) // 10**9, nanosec=(START + stamp) % 10**9),
                  frame_id=frame)


def pose(x=0.0, y=0.0, z=0.0, q=(0.0, 0.0, 0.0, 1.0)):
    return Fields(position=Fields(x=x, y=y, z=z),
                  orientation=Fields(x=q[0], y=q[1], z=q[2], w=q[3]))


def stamped(stamp, *args, frame="map", **named):
    return Fields(header=header(stamp, frame), pose=pose(*args, **named))


def odometry(stamp, child="base_link", covariance=np.zeros(36)):
    return Fields(header=header(stamp), child_frame_id=child,
                  pose=Fields(pose=pose(1.0), covariance=covariance))


class PosesTest(CourtTest):
    def test_a_pose_is_a_transform(self):
        np.testing.assert_allclose(matrix_of(pose(1.0, 2.0, 3.0, q=(0, 0, HALF, HALF))),
                                   transform(1, 2, 3, QUARTER), atol=1e-15)
        position, orientation = pose_of(transform(1, 2, 3, QUARTER))
        self.assertEqual(position, [1, 2, 3])
        np.testing.assert_allclose(orientation, [0, 0, HALF, HALF], atol=1e-15)

    def test_not_a_number_is_no_pose(self):
        answer = received(stamped(5, math.nan), PoseFrames(np.eye(4)))
        self.assertIsNone(answer.T_map_body)
        self.assertEqual(answer.time, START + 5)

    def test_a_quaternion_has_unit_length(self):
        with self.assertRaisesRegex(vb.SystemFailed, r"unit length, found \(0, 0, 0, 0\)"):
            matrix_of(pose(q=(0, 0, 0, 0)))
        np.testing.assert_allclose(matrix_of(pose(q=(0, 0, 0, 1.0001))), np.eye(4), atol=1e-15)

    # The camera is 0.3 m ahead of the body's origin. It is at (0, 1.3), looking along +y: the body
    # is at (0, 1), turned by a quarter.
    def test_the_pose_of_a_camera_becomes_the_bodys(self):
        T_body_camera = transform(0.3, R=OPTICAL)
        T_map_camera = transform(0, 1.3, R=QUARTER @ OPTICAL)
        position, q = pose_of(T_map_camera)
        answer = received(stamped(0, *position, q=q), PoseFrames(T_body_camera))
        np.testing.assert_allclose(answer.T_map_body, transform(0, 1, R=QUARTER), atol=1e-12)

    def test_frames_are_checked(self):
        frames = PoseFrames(np.eye(4), map="map")
        with self.assertRaisesRegex(vb.SystemFailed, "frame 'map', found 'odom'"):
            received(stamped(0, frame="odom"), frames)
        received(odometry(0), frames)
        with self.assertRaisesRegex(vb.SystemFailed,
                                    "poses of 'base_link', found child_frame_id 'left_optical"):
            received(odometry(0, "left_optical_frame"), frames)

    # Along the map's axes, with the body turned to the left: its x axis is the map's y.
    def test_a_covariance_is_turned_to_the_body(self):
        C = np.diag([1.0, 4, 9, 16, 25, 36]).ravel()
        told = body_covariance(C, QUARTER, np.eye(4))
        np.testing.assert_allclose(told, np.diag([4, 1, 9, 25, 16, 36]), atol=1e-12)

    # A camera 2 m ahead whose heading has the variance 1: the body's origin swings by 2 m/rad.
    def test_a_cameras_covariance_becomes_the_bodys(self):
        told = body_covariance(np.diag([0.0, 0, 0, 0, 0, 1]).ravel(), np.eye(3), transform(2))
        self.assertAlmostEqual(told[1, 1], 4)
        self.assertAlmostEqual(told[5, 5], 1)

    def test_what_is_no_covariance_is_not_known(self):
        for numbers in (np.zeros(36), np.full(36, np.nan), np.full(36, -1.0)):
            self.assertIsNone(received(odometry(0, covariance=numbers),
                                       PoseFrames(np.eye(4))).covariance)

    def test_options_name_the_child(self):
        rig = vb.Scenario(self.court).rig
        parse = arguments_parser().parse_args
        self.assertEqual(pose_frames(parse(["x"]), rig).children, {"base_link", ""})
        camera = pose_frames(parse(["x", "--pose-of", "right"]), rig)
        self.assertEqual(camera.children, {"right_optical_frame", ""})
        np.testing.assert_allclose(camera.T_body_child[:3, 3], [0.15, -0.06, 0.5])
        named = pose_frames(parse(["x", "--child-frame", "chassis"]), rig)
        self.assertEqual(named.children, {"chassis", ""})
        with self.assertRaisesRegex(vb.Error, "one of base_link, left, right, found 'top'"):
            pose_frames(parse(["x", "--pose-of", "top"]), rig)


def messages_of(court, colour=False, images="raw"):
    return _core.RosMessages(court, seed=None, set={}, randomise=None, colour=colour, images=images,
                             tags=False)


class MessagesTest(CourtTest):
    def frames(self, **options):
        messages = messages_of(self.court, **options)
        return [(frame, messages.of_frame(frame.sensors))
                for frame in vb.Scenario(self.court, frames=(0, 3))]

    def test_topics_are_the_bags(self):
        topics = {topic: (kind, latched) for topic, kind, latched in messages_of(self.court).topics}
        self.assertEqual(topics, {
            "/clock": ("rosgraph_msgs/msg/Clock", False),
            "/tf_static": ("tf2_msgs/msg/TFMessage", True),
            "/imu": ("sensor_msgs/msg/Imu", False),
            "/joint_states": ("sensor_msgs/msg/JointState", False),
            "/left/image_rect": ("sensor_msgs/msg/Image", False),
            "/left/camera_info": ("sensor_msgs/msg/CameraInfo", False),
            "/right/image_rect": ("sensor_msgs/msg/Image", False),
            "/right/camera_info": ("sensor_msgs/msg/CameraInfo", False),
            "/ground_truth": ("nav_msgs/msg/Odometry", False),
            "/tf": ("tf2_msgs/msg/TFMessage", False)})
        compressed = [topic for topic, _, _ in messages_of(self.court, images="png").topics]
        self.assertIn("/left/image_rect/compressed", compressed)

    def test_a_frame_has_its_messages_in_order_of_time_and_no_truth(self):
        for frame, messages in self.frames():
            times = [time for _, time, _ in messages]
            self.assertEqual(times, sorted(times))
            self.assertEqual(times[-1], START + frame.stamp)
            topics = [topic for topic, _, _ in messages]
            self.assertEqual(topics.count("/imu"), len(frame.imu))
            self.assertEqual(topics.count("/joint_states"), len(frame.wheels))
            self.assertEqual(topics.count("/clock"), len(set(times)))
            self.assertEqual(topics.count("/left/image_rect"), 1)
            self.assertEqual(topics.count("/tf_static"), 1 if frame.index == 0 else 0)
            self.assertNotIn("/ground_truth", topics)
            self.assertNotIn("/tf", topics)

    def test_the_clock_comes_before_what_has_its_time(self):
        for _, messages in self.frames():
            clock = 0
            for topic, time_, message in messages:
                if topic == "/clock":
                    seconds, nanoseconds = struct.unpack_from("<iI", message, 4)
                    clock = seconds * 10**9 + nanoseconds
                self.assertEqual(time_, clock)

    # CDR: 4 bytes of encapsulation, the header (stamp, length and text of the frame), then height,
    # width, encoding, is_bigendian, step, length and data, numbers aligned to their size.
    def test_an_image_is_the_frames(self):
        for colour, channels in ((True, 3), (False, 1)):
            frame, messages = self.frames(colour=colour)[1]
            message = next(m for topic, _, m in messages if topic == "/left/image_rect")
            self.assertEqual(struct.unpack_from("<iI", message, 4), (1, frame.stamp))
            self.assertIn(b"left_optical_frame\0", message)
            self.assertIn(b"rgb8\0" if colour else b"mono8\0", message)
            image = frame.images["left"]
            size = 376 * 240 * channels
            pixels = np.frombuffer(message[-size:], np.uint8).reshape(240, 376, channels)
            self.assertEqual(struct.unpack("<I", message[-size - 4:-size]), (size,))
            if colour:
                np.testing.assert_array_equal(pixels, image)
            else:  # ITU-R BT.601, rounded
                grey = image @ np.array([0.299, 0.587, 0.114])
                self.assertLessEqual(np.abs(pixels[..., 0] - grey).max(), 0.51)

    def test_the_truth_is_a_message_of_its_own(self):
        messages = messages_of(self.court)
        told = messages.of_truth(5, transform(1, 2, 3))
        self.assertEqual([topic for topic, _, _ in told], ["/clock", "/tf_static", "/tf",
                                                           "/ground_truth"])
        self.assertIn(struct.pack("<3d", 1, 2, 3), told[-1][2])


class FakeNode:
    """Calls `answer(system, topic, stamp)` at each message, before the system waits for it."""

    def __init__(self, answer, publishers=1):
        self.answer, self.publishers, self.system = answer, publishers, None
        self.topics = []

    def publish(self, topic, message):
        self.topics.append(topic)
        if topic == "/left/image_rect":
            seconds, nanoseconds = struct.unpack_from("<iI", message, 4)
            self.answer(self.system, seconds * 10**9 + nanoseconds - START)

    def spin(self, until, done=lambda: False):
        while not done() and time.monotonic() < until:
            time.sleep(0.001)
        return done()

    def publishers_of(self, topic):
        return self.publishers


def here(system, stamp):
    system.take(stamped(stamp))


class SystemTest(CourtTest):
    def run_with(self, answer, frames=PoseFrames(np.eye(4)), publishers=1, **pace):
        pace = Pace(**{"timeout": 0.02, **pace})
        node = FakeNode(answer, publishers)
        node.system = Ros2System(node, messages_of(self.court), "/slam/pose", frames, pace)
        report = vb.run(self.court, slam=node.system)
        return report, node

    def failure_of(self, answer, **options):
        report, _ = self.run_with(answer, **options)
        self.assertIsNotNone(report.failure)
        return report.failure.cause

    def test_lockstep_is_the_same_system_in_python(self):
        class Standing:
            def process(self, frame):
                return np.eye(4)

        report, node = self.run_with(here)
        self.assertEqual(report.hash, vb.run(self.court, slam=Standing()).hash)
        self.assertEqual(report.metrics.coverage, 1)
        self.assertEqual(node.topics.count("/right/image_rect"), FRAMES)
        self.assertEqual(len(node.system.latencies), FRAMES)

    def test_a_frame_without_an_answer_is_lost(self):
        def answer(system, stamp):
            if stamp // 10**6 != 200:
                here(system, stamp)

        report, _ = self.run_with(answer)
        self.assertIsNone(report.failure)
        self.assertEqual(report.metrics.lost_frames, 1)

    # 50 us beside the frame's stamp are its, 1 ms beside it is another instant.
    def test_stamps_are_matched_closely(self):
        report, _ = self.run_with(lambda system, stamp: here(system, stamp + 50_000))
        self.assertEqual(report.metrics.coverage, 1)
        cause = self.failure_of(lambda system, stamp: here(system, stamp + 1_000_000))
        self.assertIn("/slam/pose: no pose of a frame ever came in", cause)

    def test_a_pose_that_is_late_counts_in_the_final_trajectory(self):
        def answer(system, stamp):
            system.take(stamped(stamp, math.nan))
            if stamp > 0:
                system.take(stamped(0, 7.0))
            if stamp // 10**6 > 300:
                here(system, stamp)

        report, _ = self.run_with(answer)
        self.assertEqual(report.trajectories.estimate[0, 1], 7)
        self.assertEqual(report.trajectories.live[0, 1], 0)

    def test_a_system_may_lag_behind(self):
        waiting = []

        def answer(system, stamp):
            waiting.append(stamp)
            if len(waiting) > 1:
                here(system, waiting[-2])

        report, node = self.run_with(answer, lag=1)
        self.assertEqual(len(report.trajectories.estimate), FRAMES - 1)
        self.assertAlmostEqual(report.metrics.coverage, 1 - 1 / FRAMES)
        self.assertEqual(len(node.system.latencies), FRAMES - 1)

    # 0.6 s at 4 times real time last 0.15 s.
    def test_at_a_rate_frames_come_at_their_times(self):
        times = []

        def answer(system, stamp):
            times.append((time.monotonic(), stamp))
            here(system, stamp)

        report, node = self.run_with(answer, rate=4.0)
        self.assertEqual(report.metrics.coverage, 1)
        begin, _ = node.system._begin
        for now, stamp in times:
            self.assertGreaterEqual(now - begin, stamp * 1e-9 / 4 - 1e-6)

    def test_the_path_is_the_final_trajectory(self):
        def answer(system, stamp):
            here(system, stamp)
            system.take_path(Fields(header=header(stamp), poses=[stamped(0, 3.0), stamped(5_000_000)]))

        report, _ = self.run_with(answer)
        self.assertEqual(report.trajectories.estimate[:, 1].tolist(), [3])
        self.assertEqual(len(report.trajectories.live), FRAMES)

    def test_no_pose_for_long_is_a_failure(self):
        cause = self.failure_of(lambda system, stamp: None, give_up=0.05)
        self.assertRegex(cause, r"^Ros2System: /slam/pose: no pose ever came in 0 s \(\d frames were")

    def test_a_node_that_ends_is_a_failure(self):
        cause = self.failure_of(lambda system, stamp: None, publishers=0, timeout=30)
        self.assertEqual(cause, "Ros2System: /slam/pose: its publisher is gone")

    def test_a_frame_that_changes_is_a_failure(self):
        def answer(system, stamp):
            system.take(stamped(stamp, frame="map" if stamp == 0 else "odom"))

        self.assertIn("expected poses in frame 'map' as before, found 'odom'",
                      self.failure_of(answer))

    def test_it_may_end_the_run(self):
        def answer(system, stamp):
            here(system, stamp)
            system.stopped = stamp // 10**6 == 200

        report, _ = self.run_with(answer)
        self.assertEqual(report.frames, 4)
        self.assertEqual(len(report.trajectories.estimate), 4)
        self.assertIsNone(report.failure)


class CommandTest(CourtTest):
    def run_without_ros(self, *arguments):
        code = ("import sys\nsys.modules['rclpy'] = None\nfrom vinebench.ros2 import main\n"
                "sys.exit(main(sys.argv[1:]))")
        return subprocess.run([sys.executable, "-c", code, *map(str, arguments)],
                              capture_output=True, text=True)

    def test_without_rclpy_it_says_what_to_install(self):
        done = self.run_without_ros(self.court)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"^vinebench.ros2: rclpy cannot be imported \(.*\): source the "
                                      r"setup.bash of ROS 2, or install python/ros2-requirements.txt")
        self.assertEqual(done.stderr.count("\n"), 1)

    def test_a_scenario_that_is_none(self):
        done = self.run_without_ros("quick-lop")
        self.assertEqual(done.returncode, 2)
        self.assertIn("quick-lop", done.stderr)
        self.assertIn("quick-loop", done.stderr)  # the nearest
        self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    main()

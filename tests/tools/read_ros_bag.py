# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Reads what ros_test.sh recorded with ROS's own library and holds it against the same recordings in
other formats. Usage: read_ros_bag.py FOLDER"""
import rosbag

import ros_bag_checks as checks
from ros_bag_checks import IMAGES, START, rows, work


def read(name):
    """Messages by topic, in the order of the file; all have their header's stamp."""
    by_topic, clock = {}, 0
    with rosbag.Bag(str(work / name)) as bag:
        for topic, message, time in bag.read_messages():
            if topic == "/clock":
                assert message.clock == time and time.to_nsec() > clock
                clock = time.to_nsec()
            for header in [getattr(message, "header", None)] + [
                    transform.header for transform in getattr(message, "transforms", [])]:
                assert header is None or header.stamp == time, topic
            assert time.to_nsec() == clock, (topic, "before the clock")
            by_topic.setdefault(topic, []).append((time.to_nsec() - START, message))
    return by_topic


def check_types(topics):
    with rosbag.Bag(str(work / "data/ros/run.bag")) as bag:
        types = {name: info.msg_type for name, info in bag.get_type_and_topic_info().topics.items()}
        latched = [c.topic for c in bag._get_connections() if c.header.get("latching") == b"1" or
                   c.header.get("latching") == "1"]
    expected = {"/clock": "rosgraph_msgs/Clock", "/tf": "tf2_msgs/TFMessage",
                "/tf_static": "tf2_msgs/TFMessage", "/ground_truth": "nav_msgs/Odometry",
                "/imu": "sensor_msgs/Imu", "/joint_states": "sensor_msgs/JointState",
                "/tags": "tf2_msgs/TFMessage"}
    for camera, topic in IMAGES.items():
        expected[topic] = "sensor_msgs/Image"
        expected[f"/{camera}/camera_info"] = "sensor_msgs/CameraInfo"
    assert types == expected, types
    assert latched == ["/tf_static"], latched
    assert set(topics) == set(expected)


def check_interrupted():
    """All frames that are listed are in the bag, also after an abrupt end."""
    (work / "killed/ros/run.bag.active").rename(work / "killed/ros/run.bag")
    with rosbag.Bag(str(work / "killed/ros/run.bag"), "a", allow_unindexed=True) as bag:
        for _ in bag.reindex():
            pass
    for kind in ("stopped", "killed", "full"):
        frames = [int(row[2]) for row in rows(f"{kind}/frames.csv")]
        topics = read(f"{kind}/ros/run.bag")
        for topic in ("/left/image_rect", "/side/camera_info", "/ground_truth", "/tf"):
            assert len(frames) > 1 and frames == [t for t, _ in topics[topic]][:len(frames)], kind


recorded = read("data/ros/run.bag")
listed = rows("data/frames.csv")
assert len(listed) == 7
check_types(recorded)
checks.check_images(recorded, [int(row[2]) for row in listed])
checks.check_readings(recorded)
checks.check_truth(recorded, listed)
checks.check_rig(recorded)
checks.check_tags(recorded)
checks.check_compressed(read("colour/ros/run.bag"))
check_interrupted()
print("bags read")

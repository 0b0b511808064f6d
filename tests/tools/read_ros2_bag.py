# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Reads what ros2_test.sh recorded with PyPI's mcap and rosbags and holds it against the same recordings
in other formats. Usage: read_ros2_bag.py FOLDER"""
import warnings

from mcap.reader import make_reader
from mcap.stream_reader import StreamReader
from mcap.records import Chunk, Message
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader

import ros_bag_checks as checks
from ros_bag_checks import IMAGES, START, rows, work

TYPES = {"/clock": "rosgraph_msgs/msg/Clock", "/tf": "tf2_msgs/msg/TFMessage",
         "/tf_static": "tf2_msgs/msg/TFMessage", "/ground_truth": "nav_msgs/msg/Odometry",
         "/imu": "sensor_msgs/msg/Imu", "/joint_states": "sensor_msgs/msg/JointState",
         "/tags": "tf2_msgs/msg/TFMessage"}


def nanoseconds(stamp):
    return stamp.sec * 10**9 + stamp.nanosec


def expect_times(topic, message, time, clock):
    """A message has its header's stamp, and none comes before the clock."""
    headers = [getattr(message, "header", None)]
    headers += [transform.header for transform in getattr(message, "transforms", [])]
    for header in headers:
        assert header is None or nanoseconds(header.stamp) == time, topic
    if topic == "/clock":
        assert nanoseconds(message.clock) == time > clock
        return time
    assert time == clock, (topic, "before the clock")
    return clock


def read(name):
    """Messages by topic, by the index and the embedded schemas; checksums are compared."""
    by_topic, clock = {}, 0
    with (work / name).open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for _, channel, raw, message in reader.iter_decoded_messages():
            assert raw.log_time == raw.publish_time
            clock = expect_times(channel.topic, message, raw.log_time, clock)
            by_topic.setdefault(channel.topic, []).append((raw.log_time - START, message))
    return by_topic


def check_container(topics):
    with (work / "data/mcap/run.mcap").open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        header, summary = reader.get_header(), reader.get_summary()
        assert header.profile == "ros2" and header.library.startswith("vinebench ")
        expected = dict(TYPES)
        for camera, topic in IMAGES.items():
            expected[topic] = "sensor_msgs/msg/Image"
            expected[f"/{camera}/camera_info"] = "sensor_msgs/msg/CameraInfo"
        found = {channel.topic: summary.schemas[channel.schema_id].name
                 for channel in summary.channels.values()}
        assert found == expected, found
        assert set(topics) == set(expected)
        statistics = summary.statistics
        assert statistics.message_count == sum(len(messages) for messages in topics.values())
        assert statistics.chunk_count == len(summary.chunk_indexes) == 7  # one a frame
        assert {chunk.compression for chunk in summary.chunk_indexes} == {"zstd"}
        # Seeking: one topic from a time on.
        with warnings.catch_warnings():  # the argument has another name from mcap 1.6 on
            warnings.simplefilter("ignore")
            later = list(reader.iter_messages(topics=["/imu"], start_time=START + 300_000_000))
        assert [m.log_time - START for _, _, m in later] == [
            stamp for stamp, _ in topics["/imu"] if stamp >= 300_000_000]
        metadata = {record.name: record.metadata for record in reader.iter_metadata()}
        assert metadata == {"vinebench": {"time_of_stamp_0": str(START)}}, metadata
    # The same records without the summary, whose checksums are compared likewise.
    with (work / "data/mcap/run.mcap").open("rb") as file:
        records = list(StreamReader(file, validate_crcs=True).records)
        assert len([r for r in records if isinstance(r, Message)]) == statistics.message_count


def check_rosbags(topics):
    """The folder as a bag of ROS 2, decoded by the types that rosbags knows."""
    with AnyReader([work / "data/mcap"]) as reader:
        by_topic = {}
        for connection, time, raw in reader.messages():
            message = reader.deserialize(raw, connection.msgtype)
            by_topic.setdefault(connection.topic, []).append((time - START, message))
        static, = [c for c in reader.connections if c.topic == "/tf_static"]
        assert static.ext.offered_qos_profiles[0].durability.name == "TRANSIENT_LOCAL"
    assert {t: len(m) for t, m in by_topic.items()} == {t: len(m) for t, m in topics.items()}
    checks.check_readings(by_topic)
    checks.check_truth(by_topic, rows("data/frames.csv"))
    checks.check_rig(by_topic)


def messages_of_chunks(name):
    """Of a file that was never closed."""
    stamps = []
    with (work / name).open("rb") as file:
        try:
            for record in StreamReader(file, emit_chunks=True).records:
                if isinstance(record, Chunk):
                    stamps.append(record.message_end_time - START)
        except Exception as error:  # the end of the file
            assert "EndOfFile" in type(error).__name__, error
    return stamps


def check_interrupted():
    """All frames that are listed are in the bag, also after an abrupt end."""
    for kind in ("stopped", "full"):
        frames = [int(row[2]) for row in rows(f"{kind}/frames.csv")]
        topics = read(f"{kind}/mcap/run.mcap")
        for topic in ("/left/image_rect", "/side/camera_info", "/ground_truth", "/tf"):
            assert len(frames) > 1 and frames == [t for t, _ in topics[topic]][:len(frames)], kind
    frames = [int(row[2]) for row in rows("killed/frames.csv")]
    assert frames == messages_of_chunks("killed/mcap/run.mcap")[:len(frames)]


recorded = read("data/mcap/run.mcap")
listed = rows("data/frames.csv")
assert len(listed) == 7
check_container(recorded)
checks.check_images(recorded, [int(row[2]) for row in listed])
checks.check_readings(recorded)
checks.check_truth(recorded, listed)
checks.check_rig(recorded)
checks.check_tags(recorded)
checks.check_compressed(read("colour/mcap/run.mcap"))
check_rosbags(recorded)
check_interrupted()
print("bags read")

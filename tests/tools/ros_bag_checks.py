# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""What read_ros_bag.py and read_ros2_bag.py have in common: messages of a bag, by topic and in order as
(stamp in ns, message), against the same recording in other formats."""
import csv
import pathlib
import sys

import cv2
import numpy as np
import yaml

START = 1_000_000_000  # ns, of stamp 0
IMAGES = {"left": "/left/image_rect", "right": "/right/image_rect", "side": "/side/image_raw"}
work = pathlib.Path(sys.argv[1])


def rows(name):
    with (work / name).open() as file:
        return [row for row in csv.reader(file) if not row[0].startswith("#")]


def matrix(translation, rotation):
    x, y, z, w = rotation.x, rotation.y, rotation.z, rotation.w
    T = np.eye(4)
    T[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                 [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                 [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    T[:3, 3] = translation.x, translation.y, translation.z
    return T


def vector(v):
    return [v.x, v.y, v.z]


def matrices(info):
    """Of a CameraInfo: D, K, R, P, whose names are small in ROS 2."""
    return [list(getattr(info, name, None) or getattr(info, name.lower())) for name in "DKRP"]


def check_images(topics, stamps):
    for number, (camera, topic) in enumerate(IMAGES.items()):
        euroc = work / f"data/euroc/mav0/cam{number}"
        sensor = yaml.safe_load((euroc / "sensor.yaml").read_text())
        files = {int(row[0]): row[1].strip() for row in rows(euroc / "data.csv")}
        fx, fy, cx, cy = sensor["intrinsics"]
        infos = topics[f"/{camera}/camera_info"]
        assert [t for t, _ in topics[topic]] == stamps == [t for t, _ in infos]
        for (stamp, image), (_, info) in zip(topics[topic], infos):
            wanted = cv2.imread(str(euroc / "data" / files[stamp]), -1)
            got = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)
            assert image.encoding == "mono8" and image.step == image.width
            assert got.std() > 5 and np.array_equal(got, wanted), (camera, stamp)
            frame = f"{camera}_optical_frame"
            assert image.header.frame_id == info.header.frame_id == frame
            assert [info.width, info.height] == sensor["resolution"] == [image.width, image.height]
            assert info.distortion_model == "plumb_bob"
            D, K, R, P = matrices(info)
            assert D == sensor["distortion_coefficients"] + [0]
            assert K == [fx, 0, cx, 0, fy, cy, 0, 0, 1]
            assert R == [1, 0, 0, 0, 1, 0, 0, 0, 1]
            shift = -60 * 0.12 if camera == "right" else 0
            assert np.allclose(P, [fx, 0, cx, shift, 0, fy, cy, 0, 0, 0, 1, 0], 0, 1e-9)


def check_readings(topics):
    for kind, name in (("/imu", "imu0"), ("/joint_states", "wheels0")):
        wanted = rows(f"data/euroc/mav0/{name}/data.csv")
        assert len(wanted) > 20 and [t for t, _ in topics[kind]] == [int(row[0]) for row in wanted]
        for row, (_, m) in zip(wanted, topics[kind]):
            if kind == "/imu":
                assert m.header.frame_id == "base_link" and m.orientation_covariance[0] == -1
                assert m.linear_acceleration_covariance[4] > m.angular_velocity_covariance[4] > 0
                got = vector(m.angular_velocity) + vector(m.linear_acceleration)
            else:
                assert m.name[1] == "front_right_wheel" and m.name[2] == "rear_left_wheel"
                got = list(m.position) + list(m.velocity)
            assert got == [float(field) for field in row[1:]]


def check_truth(topics, frames):
    moved = 0
    for name in ("/ground_truth", "/tf"):
        assert [t for t, _ in topics[name]] == [int(row[2]) for row in frames]
    for i, (row, (stamp, m), (_, tf)) in enumerate(
            zip(frames, topics["/ground_truth"], topics["/tf"])):
        p, q = m.pose.pose.position, m.pose.pose.orientation
        assert vector(p) + vector(q) + [q.w] == [float(field) for field in row[3:]]
        assert (m.header.frame_id, m.child_frame_id) == ("world", "ground_truth")
        T = tf.transforms[0]
        assert (T.header.frame_id, T.child_frame_id) == ("world", "ground_truth")
        assert vector(T.transform.translation) == vector(p)
        assert vector(T.transform.rotation) + [T.transform.rotation.w] == vector(q) + [q.w]
        if i > 0:
            R = matrix(p, q)[:3, :3]
            way = np.subtract(vector(p), vector(before[1]))
            seconds = (stamp - before[0]) * 1e-9
            assert np.allclose(R @ vector(m.twist.twist.linear) * seconds, way, 0, 1e-9)
            moved += way[0]
        before = stamp, p
    assert moved > 0.03, moved  # m ahead


def check_rig(topics):
    (_, static), = topics["/tf_static"]
    parents = {"ground_truth": "world"}
    for number, camera in enumerate(IMAGES):
        mount = static.transforms[number]
        euroc = work / f"data/euroc/mav0/cam{number}"
        sensor = yaml.safe_load((euroc / "sensor.yaml").read_text())
        files = {int(row[0]): row[1].strip() for row in rows(euroc / "data.csv")}
        T_BS = np.reshape(sensor["T_BS"]["data"], (4, 4))
        assert np.allclose(matrix(mount.transform.translation, mount.transform.rotation), T_BS, 0,
                           1e-12)
        assert mount.child_frame_id == f"{camera}_optical_frame"
        assert mount.header.frame_id == "base_link" and mount.child_frame_id not in parents
        parents[mount.child_frame_id] = mount.header.frame_id
    assert len(parents) == 1 + len(IMAGES) and "base_link" not in parents


def check_tags(topics):
    """Detections are near the truth, and not the truth itself."""
    truth = rows("data/dcvslam/tags.csv")
    found = {stamp: m.transforms for stamp, m in topics["/tags"]}
    assert len(found) >= len(truth) - 1 > 2
    for row in truth:
        if int(row[0]) not in found:
            continue
        tag, = found[int(row[0])]
        assert tag.header.frame_id == "side_optical_frame" and tag.child_frame_id == "tag36h11_3"
        apart = np.subtract(vector(tag.transform.translation), [float(v) for v in row[6:9]])
        assert 0 < np.linalg.norm(apart) < 0.02, apart
        q = tag.transform.rotation
        turned = abs(np.dot(vector(q) + [q.w], [float(v) for v in row[9:13]]))
        assert turned > np.cos(np.radians(5) / 2), turned


def check_compressed(topics):
    for camera in ("left", "right", "side"):
        kind = "raw" if camera == "side" else "rect"
        images = topics[f"/{camera}/image_{kind}/compressed"]
        assert len(images) == len(topics[f"/{camera}/camera_info"]) == len(rows("colour/frames.csv"))
        for number, (_, image) in enumerate(images):
            assert image.format == "jpeg"
            assert bytes(image.data) == (work / f"colour/rgb/{camera}/{number:06}.jpg").read_bytes()

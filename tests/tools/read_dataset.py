# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Reads a data set in every format with Python's stock readers. Usage: read_dataset.py FOLDER"""
import csv
import json
import pathlib
import sys

import cv2
import numpy as np
import yaml
from PIL import Image

root = pathlib.Path(sys.argv[1])
card = yaml.safe_load((root / "dataset.yaml").read_text())
frames = card["frames"]
assert card["complete"] and frames == 4, card
calibration = yaml.safe_load((root / "calibration.yaml").read_text())
left = calibration["cameras"][0]
shape = (left["height"], left["width"])


def image(name, kind):
    """By OpenCV and by PIL, which must agree."""
    file = root / name
    by_cv = cv2.imread(str(file), cv2.IMREAD_UNCHANGED)
    assert by_cv is not None and by_cv.dtype == kind, name
    if kind == np.uint16 and by_cv.ndim == 3:
        return by_cv[..., ::-1]  # PIL does not support 16-bit RGB
    by_pil = np.asarray(Image.open(file))
    turned = by_cv[..., ::-1] if by_cv.ndim == 3 else by_cv
    assert np.array_equal(turned, by_pil.astype(turned.dtype)), name
    return turned


# Images and labels of one camera.
rgb = image("rgb/left/000001.png", np.uint8)
assert rgb.shape == shape + (3,) and rgb.std() > 5
grey = image("kitti/image_0/000001.png", np.uint8)
assert np.abs(cv2.cvtColor(rgb, cv2.COLOR_RGB2GRAY).astype(int) - grey).max() == 0
depth = np.load(root / "depth32/left/000001.npy")
assert depth.dtype == np.float32 and depth.shape == shape
millimetres = image("depth/left/000001.png", np.uint16)
near = (depth > 0) & (depth < 65)
assert np.abs(millimetres[near] - 1000.0 * depth[near]).max() <= 0.51
disparity = image("disparity/left/000001.png", np.uint16) / 256.0
baseline = np.linalg.norm(
    np.subtract(calibration["cameras"][1]["position"], left["position"]))
assert np.abs(disparity[near] - left["fx"] * baseline / depth[near]).max() < 0.05
flow = cv2.readOpticalFlow(str(root / "flo/left/000001.flo"))
code = image("flow/left/000001.png", np.uint16)
valid = code[..., 2] == 1
assert valid.mean() > 0.9
assert np.abs((code[..., :2].astype(float) - 32768) / 64 - flow)[valid].max() < 0.02
normals = image("normals/left/000001.png", np.uint8).astype(float) / 127.5 - 1
lengths = np.linalg.norm(normals, axis=2)[depth > 0]
assert np.abs(lengths - 1).max() < 0.02  # of eight bits
labels = yaml.safe_load((root / "semantic/labels.yaml").read_text())["labels"]
names = {label["id"]: label["name"] for label in labels}
semantic = image("semantic/left/000001.png", np.uint8)
assert set(np.unique(semantic)) <= set(names)
sky = next(i for i, name in names.items() if name == "sky")
assert np.array_equal(semantic == sky, depth == 0)
numbers = image("instances/left/000001.png", np.uint8).astype(int) @ [1, 256, 65536]
table = {int(row[0]) for row in csv.reader((root / "instances/instances.csv").open())
         if not row[0].startswith("#")}
assert set(np.unique(numbers)) - {0} <= table

# COCO, with its masks decompressed here.
coco = json.loads((root / "coco/instances.json").read_text())
images = {image["id"]: image for image in coco["images"]}
assert all((root / "coco/images" / image["file_name"]).is_file() for image in coco["images"])
assert len(images) == 2 * frames


def mask_of(segmentation):
    counts, at, text = [], 0, segmentation["counts"]
    while at < len(text):
        value, shift, more = 0, 0, True
        while more:
            group = ord(text[at]) - 48
            value |= (group & 0x1F) << shift
            more, at, shift = group & 0x20, at + 1, shift + 5
            if not more and group & 0x10:
                value |= -1 << shift
        counts.append(value + (counts[-2] if len(counts) > 2 else 0))
    height, width = segmentation["size"]
    flat = np.repeat(np.arange(len(counts)) % 2, counts)
    return flat.reshape(width, height).T.astype(bool)


for annotation in coco["annotations"]:
    mask = mask_of(annotation["segmentation"])
    assert mask.sum() == annotation["area"]
    ys, xs = np.nonzero(mask)
    x, y, w, h = annotation["bbox"]
    assert (xs.min(), ys.min(), xs.max() + 1, ys.max() + 1) == (x, y, x + w, y + h)
    assert annotation["iscrowd"] in (0, 1) and annotation["category_id"] >= 1
try:
    from pycocotools.coco import COCO
    reader = COCO(str(root / "coco/instances.json"))
    for annotation in coco["annotations"]:
        assert reader.annToMask(annotation).sum() == annotation["area"]
except ImportError:
    print("pycocotools is not there: its reader was left out")

# Trajectories and lists.
body = np.loadtxt(root / "tum/body.txt")
assert body.shape == (frames, 8)
poses = np.loadtxt(root / "kitti/poses.txt").reshape(-1, 3, 4)
assert poses.shape[0] == frames and np.allclose(poses[0], np.eye(4)[:3])
truth = np.genfromtxt(root / "euroc/mav0/state_groundtruth_estimate0/data.csv", delimiter=",")
truth = truth[~np.isnan(truth[:, 0])]  # the header
assert truth.shape[1] == 17 and len(truth) > 10 * frames  # at the inertial unit's rate
assert np.all(np.diff(truth[:, 0]) > 0)
truth = truth[np.searchsorted(truth[:, 0], np.round(1e9 * body[:, 0]))]
assert np.allclose(truth[:, 1:4], body[:, 1:4], atol=1e-8)
assert np.allclose(truth[:, 4], body[:, 7], atol=1e-8)  # w first here, last there
sensor = yaml.safe_load((root / "euroc/mav0/cam1/sensor.yaml").read_text())
assert len(sensor["T_BS"]["data"]) == 16 and len(sensor["distortion_coefficients"]) == 4
settings = cv2.FileStorage(str(root / "euroc/settings/orbslam3_rectified.yaml"),
                           cv2.FILE_STORAGE_READ)
assert settings.getNode("Camera2.fx").isReal() and settings.getNode("Camera.fps").isInt()
basalt = json.loads((root / "euroc/settings/basalt_calib.json").read_text())["value0"]
assert len(basalt["T_imu_cam"]) == 2
dcvslam = yaml.safe_load((root / "dcvslam/config.yaml").read_text())
assert dcvslam["numOfFrames"] == frames
print("all formats read")

# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""A run of four frames and its recording, made by hand, for the tests of vinebench.rerun.

The rover begins at (1, 2, 0), looks north and drives 0.5 m a frame. The map begins at its first
pose: T_world_map is (1, 2, 0) with a quarter turn to the left. The third frame has no live pose. In
the last one the corrected estimate is 10 mm and the live one 20 mm too far to the left.
"""
import json
import math
import pathlib

from support import RIG

FRAMES = (0, 1, 2, 3)
STAMPS = (0, 66666667, 133333333, 200000000)  # ns
STEP = 0.5  # m
HALF = math.sqrt(0.5)  # sine and cosine of half a quarter turn

# Variances of 1, 4 and 9 mm²: three standard deviations are 3, 6 and 9 mm.
COVARIANCE = "1e-06,0,0,4e-06,0,9e-06"
TIMELINE = f"""t,frame,status,keyframe,xx,xy,xz,yy,yz,zz,features:left,features:right,inliers:left,inliers:right,occluded:left,occluded:right
0.000000000,0,tracked,1,{COVARIANCE},900,300,200,0,0,0
0.066666667,1,tracked,0,{COVARIANCE},910,310,210,0,0,0
0.133333333,2,lost,0,nan,nan,nan,nan,nan,nan,20,5,nan,nan,0.9,0
0.200000000,3,tracked,1,{COVARIANCE},930,330,230,0,0,0
"""

EVENTS = ({"t": 0.0, "frame": 0, "event": "initialised"},
          {"t": 0.133333333, "frame": 2, "event": "lost", "dead_reckoning": False},
          {"t": 0.2, "frame": 3, "event": "loop_closure", "tag": 3, "earlier_t": 0.0, "later_t": 0.2,
           "correction_m": 0.0104, "correct": False})

SITE = {"name": "court", "rows": [[0, -1, 4, -1]], "vines": [], "posts": [[0, -1]],
        "objects": [{"class": "carton", "centre": [3, 1], "size": [0.4, 0.2, 0.6], "foot": 0,
                     "yaw_deg": 90, "colour": [0.4, 0.3, 0.2], "moves": False}],
        "tags": [{"family": "tag36h11", "id": 3, "size": 0.16, "registered": True,
                  "T_world_tag": [0.5, 1.5, 0.5, -HALF, 0, 0, HALF]}],
        "post": [0.035, 1.6], "rate_hz": 15,
        # x right, y down, z ahead in x ahead, y left, z up
        "cameras": [{"name": name, "width": 376, "height": 240, "fx": 130, "fy": 130,
                     "T_body_cam": [0.15, y, 0.5, 0.5, -0.5, 0.5, -0.5]}
                    for name, y in (("left", 0.06), ("right", -0.06))]}

CLOUD = """ply
format ascii 1.0
element vertex 2
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
end_header
1 0.5 0.25 10 20 30
-90 0 0 40 50 60
"""


def tum(rows):
    """Of (stamp, x, y, quaternion's z and w)."""
    return "".join(f"{stamp / 1e9:.9f} {x:.9f} {y:.9f} 0 0 0 {z:.9f} {w:.9f}\n"
                   for stamp, x, y, z, w in rows)


def write_run(folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True)
    for name, text in {
            "groundtruth.tum": tum((t, 1, 2 + STEP * k, HALF, HALF) for k, t in enumerate(STAMPS)),
            "estimate.tum": tum((t, STEP * k, 0.01 * (k == 3), 0, 1) for k, t in enumerate(STAMPS)),
            "estimate_live.tum": tum((STAMPS[k], STEP * k, 0.02 * (k == 3), 0, 1) for k in (0, 1, 3)),
            "keyframes.tum": tum((STAMPS[k], STEP * k, 0, 0, 1) for k in (0, 3)),
            "timeline.csv": TIMELINE,
            "events.jsonl": "".join(json.dumps(event) + "\n" for event in EVENTS),
            "site.json": json.dumps(SITE),
            "metrics.json": json.dumps({"scenario": "court", "seed": 5, "frames": 4}),
            "summary.txt": "no degraded segment\n",
            "landmarks.ply": CLOUD}.items():
        (folder / name).write_text(text)
    return folder


def write_recording(folder, image=None):
    """image(k) writes the k-th frame's image to a file; the right camera lacks that of frame 2."""
    euroc = pathlib.Path(folder) / "euroc"
    for i in (0, 1):
        frames = [k for k in FRAMES if i == 0 or k != 2]
        images = euroc / f"mav0/cam{i}/data"
        images.mkdir(parents=True)
        (images.parent / "data.csv").write_text("#timestamp [ns],filename\n" + "".join(
            f"{STAMPS[k]:019d},{STAMPS[k]:019d}.png\n" for k in frames))
        for k in frames:
            (image or (lambda file: file.write_bytes(b"")))(images / f"{STAMPS[k]:019d}.png")
    (euroc / "rig.yaml").write_text(RIG)
    for name, columns, rows in (
            ("imu0", 7, [[5000000 * k, 0, 0, 0.1, 0, 0, 9.81] for k in range(41)]),
            ("state_groundtruth_estimate0", 8, [[t, 1, 2 + STEP * k, 0, HALF, 0, 0, HALF]
                                                for k, t in enumerate(STAMPS)])):
        (euroc / "mav0" / name).mkdir()
        (euroc / "mav0" / name / "data.csv").write_text("#" + "," * (columns - 1) + "\n" + "".join(
            ",".join(map(str, row)) + "\n" for row in rows))
    return euroc.parent

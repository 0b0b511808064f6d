#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Trains a vocabulary for ORB-SLAM3 on the images of a recording, where ORBvoc.txt is not at hand.

A tree of binary ORB descriptors: each node's are divided into up to BRANCHES clusters by k-majority
(the centre's bits are those of most members, distances are Hamming's; Grana et al., "A fast
approach for integrating ORB descriptors in the bag of words model", 2013), LEVELS deep. Written in
DBoW2's text format; a word's weight is its inverse document frequency, ln(images / images with it).
The same images and versions give the same file.
"""
import argparse
import sys
from pathlib import Path

BRANCHES, LEVELS = 8, 5
ITERATIONS = 12


def descriptors_of(files, features):
    """Packed descriptors (n x 32, uint8) of all images, and the image of each."""
    import cv2
    import numpy as np

    cv2.setNumThreads(1)
    orb = cv2.ORB_create(nfeatures=features, scaleFactor=1.2, nlevels=8, fastThreshold=10)
    rows, images = [], []
    for i, file in enumerate(files):
        image = cv2.imread(str(file), cv2.IMREAD_GRAYSCALE)
        if image is None:
            sys.exit(f"train_vocabulary.py: {file}: cannot be read")
        found = orb.detectAndCompute(image, None)[1]
        if found is not None:
            rows.append(found)
            images.append(np.full(len(found), i))
    if not rows:
        sys.exit("train_vocabulary.py: no features in these images")
    return np.concatenate(rows), np.concatenate(images)


def distances(signs, centres):
    """Hamming distances (n x k) of vectors of -1 and 1: their products are 256 - 2 distance."""
    return (signs.shape[1] - signs @ centres.T) / 2


def clusters(signs, draw):
    """Centres (k x 256, -1 and 1) and each descriptor's cluster; none is empty."""
    import numpy as np

    # Centres far from each other are likely (k-means++).
    centres = signs[[draw.integers(len(signs))]]
    while len(centres) < BRANCHES:
        nearest = distances(signs, centres).min(axis=1).astype(np.float64) ** 2
        if nearest.sum() == 0:
            break
        centres = np.vstack([centres, signs[draw.choice(len(signs), p=nearest / nearest.sum())]])
    owner = None
    for _ in range(ITERATIONS):
        new = distances(signs, centres).argmin(axis=1)
        if owner is not None and (new == owner).all():
            break
        kept, owner = np.unique(new, return_inverse=True)
        sums = np.stack([signs[owner == c].sum(axis=0) for c in range(len(kept))])
        centres = np.where(sums >= 0, 1, -1).astype(np.float32)
    return centres, owner


def tree(descriptors, images, seed):
    """Nodes in the order of their ids, from 1: parent, is leaf, packed centre, weight."""
    import numpy as np

    draw = np.random.default_rng(seed)
    total = len(np.unique(images))
    nodes, level = [], [(0, np.arange(len(descriptors)))]
    for depth in range(1, LEVELS + 1):
        following = []
        for parent, members in level:
            signs = np.unpackbits(descriptors[members], axis=1).astype(np.float32) * 2 - 1
            centres, owner = clusters(signs, draw)
            for c, centre in enumerate(np.packbits(centres > 0, axis=1)):
                mine = members[owner == c]
                leaf = depth == LEVELS or len(np.unique(descriptors[mine], axis=0)) == 1
                weight = np.log(total / len(np.unique(images[mine]))) if leaf else 0.0
                nodes.append((parent, leaf, centre, weight))
                if not leaf:
                    following.append((len(nodes), mine))
        level = following
    return nodes


def write(file, nodes):
    lines = [f"{BRANCHES} {LEVELS} 0 0"]  # L1 norm, term frequency times inverse document frequency
    for parent, leaf, centre, weight in nodes:
        lines.append(f"{parent} {int(leaf)} {' '.join(map(str, centre))} {weight:.6g}")
    partial = file.with_name(file.name + ".partial")
    partial.write_text("\n".join(lines))  # an empty line at the end would be read as a node
    partial.replace(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("recording", type=Path, help="the folder above mav0")
    parser.add_argument("vocabulary", type=Path, help="the file to write")
    parser.add_argument("--images", type=int, default=120, help="of all cameras of the first pair")
    parser.add_argument("--features", type=int, default=1000, help="for each image")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    files = sorted(file for camera in ("cam0", "cam1")
                   for file in (options.recording / "mav0" / camera / "data").glob("*.png"))
    if not files:
        sys.exit(f"train_vocabulary.py: {options.recording}: no images in mav0/cam0/data")
    step = max(1, len(files) // options.images)
    try:
        nodes = tree(*descriptors_of(files[::step], options.features), options.seed)
    except ImportError as error:
        sys.exit(f"train_vocabulary.py: {error.name}: cannot be imported; numpy and OpenCV are needed")
    options.vocabulary.parent.mkdir(parents=True, exist_ok=True)
    write(options.vocabulary, nodes)
    words = sum(leaf for _, leaf, _, _ in nodes)
    print(f"{options.vocabulary}: {words} words of {len(files[::step])} images")


if __name__ == "__main__":
    main()

# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""What the network is trained on: square crops, each a function of seed, step and place."""
import cv2
import numpy as np

SIZE = 256  # px
SCALES = 0.75  # octaves, up and down
BRIGHTNESS = 0.6  # octaves, up and down
TINT = 0.15  # octaves of each channel, up and down
JITTER = 64  # px of the picture, from a bunch's pixel to the crop's middle


def middle(random, mask, half):
    """Where the crop's middle lies: half of all crops are about a pixel of a bunch."""
    height, width = mask.shape
    point = random.uniform(0, width), random.uniform(0, height)
    about_bunch = random.random() < 0.5
    place, shift = random.random(), random.uniform(-JITTER, JITTER, 2)
    bunches = np.flatnonzero(mask)
    if about_bunch and len(bunches):
        at = bunches[int(place * len(bunches))]
        point = at % width + shift[0], at // width + shift[1]
    # Inside of the picture where it is large enough.
    return [float(np.clip(value, min(half, extent / 2), max(extent - half, extent / 2)))
            for value, extent in zip(point, (width, height))]


def crop(picture, random):
    """Turned left to right or not, larger or smaller, brighter or darker, tinted."""
    image, mask = picture
    scale = 2 ** random.uniform(-SCALES, SCALES)
    gain = 2 ** (random.uniform(-BRIGHTNESS, BRIGHTNESS) + random.uniform(-TINT, TINT, 3))
    turned = -1 if random.random() < 0.5 else 1
    x, y = middle(random, mask, scale * SIZE / 2)
    centre = (SIZE - 1) / 2
    into = np.float64([[turned * scale, 0, x - 0.5 - turned * scale * centre],
                       [0, scale, y - 0.5 - scale * centre]])
    how = {"flags": cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP, "borderMode": cv2.BORDER_REFLECT_101}
    warped = [cv2.warpAffine(layer, into, (SIZE, SIZE), **how)
              for layer in (image, mask.astype(np.float32))]
    return np.clip(warped[0] * gain, 0, 255).astype(np.float32), warped[1] >= 0.5


def batch(sets, seed, step, count):
    """`count` crops, of the sets in turn, so that a small set has as many as a large one."""
    crops = []
    for place in range(count):
        random = np.random.default_rng([seed, step + 1, place])
        chosen = sets[place % len(sets)]
        crops.append(crop(chosen.read(int(random.integers(len(chosen)))), random))
    return np.stack([image for image, _ in crops]), np.stack([mask for _, mask in crops])

# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Sets of labelled pictures: recordings (COCO) and folders of photographs with masks."""
import collections
import dataclasses
import hashlib
import json
import math
import re
import zipfile
from pathlib import Path

import cv2
import numpy as np

PHOTOGRAPHS = {".jpg", ".jpeg", ".png"}
MASK = "_mask"
BUNCH = "bunch"
KEPT = 400  # pictures in memory: 0.6 GB at 752 px


class Problem(Exception):
    """Something that the user can mend, in one line."""


@dataclasses.dataclass(frozen=True)
class Item:
    name: str
    image: Path
    mask: Path = None  # .png or .npz; None: `regions`
    regions: tuple = ()  # COCO's segmentations of this picture's bunches


def folder_items(folder):
    """NAME.jpg with NAME_mask.png or NAME.npz, in order of name."""
    files = sorted(path for path in folder.iterdir() if path.is_file())
    images = [path for path in files
              if path.suffix.lower() in PHOTOGRAPHS and not path.stem.endswith(MASK)]
    stems = collections.Counter(path.stem for path in images)
    items = []
    for image in images:
        masks = [folder / f"{image.stem}{MASK}.png", folder / f"{image.stem}.npz"]
        found = [mask for mask in masks if mask.is_file()]
        if not found:
            raise Problem(f"{image}: has neither {masks[0].name} nor {masks[1].name} beside it")
        if len(found) > 1 or stems[image.stem] > 1:
            raise Problem(f"{image}: {image.stem} has more than one picture or mask")
        items.append(Item(image.name, image, found[0]))
    return items


def coco_items(file, images):
    """Of a recording: every picture of the list, with its bunches."""
    try:
        listed = json.loads(file.read_text())
        numbers = {entry["id"] for entry in listed["categories"] if entry["name"] == BUNCH}
        if not numbers:
            raise Problem(f"{file}: has no category '{BUNCH}'")
        regions = collections.defaultdict(list)
        for entry in listed["annotations"]:
            if entry["category_id"] in numbers:
                regions[entry["image_id"]].append(entry["segmentation"])
        entries = sorted((entry["file_name"], entry["id"]) for entry in listed["images"])
        return [Item(name, images / name, None, tuple(regions[number])) for name, number in entries]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise Problem(f"{file}: is no list of COCO annotations ({error!r})") from None


def find_items(folder):
    recorded = (folder / "dataset.yaml").is_file()
    for file, images in ((folder / "coco/instances.json", folder / "coco/images"),
                         (folder / "instances.json", folder if recorded else folder / "images")):
        if file.is_file():
            items = coco_items(file, images)
            break
    else:
        if recorded:
            raise Problem(f"{folder}: is a recording without instances.json: record it with "
                          f"--format coco, and wait until it is complete")
        items = folder_items(folder)
    if not items:
        raise Problem(f"{folder}: has no picture ({', '.join(sorted(PHOTOGRAPHS))})")
    return items


def ends_early(data):
    """Whether a JPEG or PNG file lacks its end, which OpenCV fills with grey."""
    if data.startswith(b"\x89PNG"):
        return data.find(b"IEND") < 0
    if not data.startswith(b"\xff\xd8"):
        return False
    at = 2
    while at + 4 <= len(data):
        if data[at] != 0xFF:
            return True
        if data[at + 1] == 0xD9:
            return False
        start_of_scan = data[at + 1] == 0xDA
        at += 1 if data[at + 1] == 0xFF else 2 + int.from_bytes(data[at + 2:at + 4], "big")
        if start_of_scan:  # to the next marker that is no restart
            marker = re.compile(b"\xff[^\x00\xff\xd0-\xd7]").search(data, at)
            at = marker.start() if marker else len(data)
    return data[at:at + 2] != b"\xff\xd9"


def decoded(path, flags):
    """The pixels as they are stored, which is what masks refer to: Exif does not turn them."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise Problem(f"{path}: {error.strerror}") from None
    image = cv2.imdecode(np.frombuffer(data, np.uint8), flags) if data else None
    if image is None or ends_early(data):
        raise Problem(f"{path}: is no picture, or a broken one")
    return image


def png_mask(path):
    mask = decoded(path, cv2.IMREAD_UNCHANGED)
    if mask.ndim == 3:  # any colour but black; transparency says nothing
        mask = mask[..., :3].max(axis=2)
    return mask > 0


def npz_mask(path):
    """As in WGISD: one array of height × width × bunches, or of height × width."""
    try:
        with np.load(path) as arrays:
            if len(arrays.files) != 1:
                raise Problem(f"{path}: has {len(arrays.files)} arrays, expected one")
            array = arrays[arrays.files[0]]
    except (OSError, ValueError, EOFError, zipfile.BadZipFile) as error:
        raise Problem(f"{path}: is no mask ({error})") from None
    if array.ndim not in (2, 3):
        raise Problem(f"{path}: has {array.ndim} dimensions, expected height × width × bunches")
    return array.reshape(*array.shape[:2], -1).any(axis=2)


def run_lengths(text):
    """COCO's compressed counts: five bits a character, differences from the last but one."""
    counts, value, shift = [], 0, 0
    for character in text:
        code = ord(character) - 48
        value |= (code & 31) << shift
        shift += 5
        if code & 32:
            continue
        if code & 16:  # negative
            value -= 1 << shift
        counts.append(value + (counts[-2] if len(counts) > 2 else 0))
        value = shift = 0
    return counts


def region_mask(segmentation, where):
    if not isinstance(segmentation, dict):
        raise Problem(f"{where}: has a polygon; masks are read as run lengths (RLE)")
    height, width = segmentation["size"]
    counts = segmentation["counts"]
    counts = run_lengths(counts) if isinstance(counts, str) else counts
    if min(counts, default=0) < 0 or sum(counts) != height * width:
        raise Problem(f"{where}: a mask's run lengths do not add up to {width} × {height}")
    values = np.repeat(np.arange(len(counts)) % 2 == 1, counts)
    return values.reshape(width, height).T


def full_mask(item, shape):
    """True for pixels of bunches; of the picture's size."""
    where = item.mask or item.image
    if item.mask:
        masks = [npz_mask(item.mask) if item.mask.suffix == ".npz" else png_mask(item.mask)]
    else:
        masks = [region_mask(region, where) for region in item.regions]
    union = np.zeros(shape, bool)
    for mask in masks:
        if mask.shape != shape:
            raise Problem(f"{where}: the mask has {mask.shape[1]} × {mask.shape[0]} pixels, "
                          f"the picture {shape[1]} × {shape[0]}")
        union |= mask
    return union


def scaled(image, mask, width):
    if image.shape[1] == width:
        return image, mask
    size = width, max(1, round(image.shape[0] * width / image.shape[1]))
    how = cv2.INTER_AREA if width < image.shape[1] else cv2.INTER_LINEAR
    # A pixel is of a bunch if at least half of what it shows is.
    share = cv2.resize(mask.astype(np.float32), size, interpolation=how)
    return cv2.resize(image, size, interpolation=how), share >= 0.5


class PictureSet:
    """Pictures of one width with their masks, read when they are asked for."""

    def __init__(self, name, items, width):
        self.name, self.items, self.width = name, items, width
        self._kept = collections.OrderedDict()

    def __len__(self):
        return len(self.items)

    def read(self, index):
        """BGR and the mask of bunches."""
        if index in self._kept:
            self._kept.move_to_end(index)
            return self._kept[index]
        item = self.items[index]
        image = decoded(item.image, cv2.IMREAD_COLOR | cv2.IMREAD_IGNORE_ORIENTATION)
        self._kept[index] = scaled(image, full_mask(item, image.shape[:2]), self.width)
        if len(self._kept) > KEPT:
            self._kept.popitem(last=False)
        return self._kept[index]

    def part(self, share, seed):
        """A share of the pictures, at least one, drawn by the seed."""
        count = max(1, math.ceil(share * len(self.items) - 1e-9))
        chosen = np.random.default_rng([seed, 0]).permutation(len(self.items))[:count]
        return PictureSet(self.name, [self.items[i] for i in sorted(chosen)], self.width)

    def spread(self, most):
        """At most so many of them, evenly over the list."""
        count = min(most, len(self.items))
        chosen = [(2 * i + 1) * len(self.items) // (2 * count) for i in range(count)]
        return PictureSet(self.name, [self.items[i] for i in chosen], self.width)

    def verify(self):
        """Reads everything once; returns a hash of each picture, and of all with their masks."""
        whole, images = hashlib.blake2b(digest_size=16), {}
        pixels = 0
        for index, item in enumerate(self.items):
            pixels += int(self.read(index)[1].sum())
            images[hashlib.blake2b(item.image.read_bytes(), digest_size=16).hexdigest()] = item.name
            mask = item.mask.read_bytes() if item.mask else json.dumps(item.regions).encode()
            for part in (item.name.encode(), item.image.read_bytes(), mask):
                whole.update(len(part).to_bytes(8, "big") + part)
        if not pixels:
            raise Problem(f"{self.name}: none of its {len(self)} pictures shows a bunch")
        return images, whole.hexdigest()


def open_set(path, width, name=None):
    path = Path(path)
    return PictureSet(name or path.resolve().name, find_items(path), width)

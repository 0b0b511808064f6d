# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""tools/transfer on pictures made here: reading, crops, scores, table, messages; training where
PyTorch is installed. Usage: transfer_test.py ROOT

Exit code 77 (skipped) where numpy or OpenCV are not installed.
"""
import argparse
import importlib.util
import json
import subprocess
import sys
import tempfile
from pathlib import Path

for needed in ("numpy", "cv2"):
    if not importlib.util.find_spec(needed):
        print(f"{needed} is not installed: skipped")
        sys.exit(77)
import cv2
import numpy as np

ROOT = Path(sys.argv[1]).resolve()
TOOL = ROOT / "tools/transfer"
sys.dont_write_bytecode = True
sys.path.insert(0, str(TOOL))
import crops
import experiment
import pictures
import scores

SIDE = 64
failures = 0


def check(name, good):
    global failures
    failures += not good
    if not good:
        print(f"FAILED: {name}")


def problem(call):
    """The message of a call that is to fail."""
    try:
        call()
    except pictures.Problem as error:
        return str(error)
    return "no error"


def write_photograph(folder, name, value, mask=None, side=SIDE):
    """A noisy picture, and a mask of its upper quarter unless another one is given."""
    folder.mkdir(parents=True, exist_ok=True)
    image = np.random.default_rng(value).integers(0, 256, (side, side, 3), np.uint8)
    cv2.imwrite(str(folder / f"{name}.jpg"), image)
    if mask is None:
        mask = np.zeros((side, side), np.uint8)
        mask[:side // 4] = 1
    cv2.imwrite(str(folder / f"{name}_mask.png"), mask)


def test_folders(out):
    folder = out / "folder"
    write_photograph(folder, "b", 1)
    (folder / "a.png").write_bytes((folder / "b_mask.png").read_bytes())
    # As WGISD's: height × width × bunches; the bunches of rows 0 to 2 and 2 to 4 share one.
    array = np.zeros((SIDE, SIDE, 2), np.uint8)
    array[0:3, :, 0] = array[2:5, :, 1] = 1
    np.savez_compressed(folder / "a.npz", array)
    (folder / "notes.txt").write_text("no picture")
    found = pictures.open_set(folder, SIDE)
    check("pairs", [item.name for item in found.items] == ["a.png", "b.jpg"])
    check("a mask of several bunches", found.read(0)[1].sum() == 5 * SIDE and found.read(0)[1][:5].all())
    check("a mask of any grey level", found.read(1)[1].sum() == SIDE * SIDE / 4)
    # To half the width: rows 0 to 4 of 64 are 2.5 of 32, and a half counts.
    image, mask = pictures.open_set(folder, SIDE // 2).read(0)
    check("scaled", image.shape == (32, 32, 3) and mask.sum() == 3 * 32 and mask[:3].all())


def test_broken_folders(out):
    def message(change):
        folder = Path(tempfile.mkdtemp(dir=out))
        write_photograph(folder, "a", 1)
        change(folder)
        return problem(lambda: pictures.open_set(folder, SIDE).verify())

    def cut(folder):
        whole = (folder / "a.jpg").read_bytes()
        (folder / "a.jpg").write_bytes(whole[:len(whole) // 2])

    blank = np.zeros((SIDE, SIDE), np.uint8)
    for change, expected in (
            (lambda f: [path.unlink() for path in f.iterdir()], "has no picture (.jpeg, .jpg, .png)"),
            (lambda f: (f / "a_mask.png").unlink(), "a.jpg: has neither a_mask.png nor a.npz beside it"),
            (lambda f: np.savez(f / "a.npz", blank), "a.jpg: a has more than one picture or mask"),
            (lambda f: write_photograph(f, "a", 1, blank[1:] + 1),
             "a_mask.png: the mask has 64 × 63 pixels, the picture 64 × 64"),
            (lambda f: write_photograph(f, "a", 1, blank), "none of its 1 pictures shows a bunch"),
            (cut, "a.jpg: is no picture, or a broken one"),
            (lambda f: (f / "a.jpg").write_bytes(b""), "a.jpg: is no picture, or a broken one"),
            (lambda f: (f / "a_mask.png").write_text("mask"), "a_mask.png: is no picture, or a broken"),
            (lambda f: ((f / "a_mask.png").unlink(), (f / "a.npz").write_text("mask")),
             "a.npz: is no mask"),
            (lambda f: ((f / "a_mask.png").unlink(), np.savez(f / "a.npz", blank, blank)),
             "a.npz: has 2 arrays, expected one"),
            (lambda f: ((f / "a_mask.png").unlink(), np.savez(f / "a.npz", blank[0])),
             "a.npz: has 1 dimensions, expected height × width × bunches"),
            (lambda f: (f / "dataset.yaml").write_text("complete: false"),
             "is a recording without instances.json")):
        found = message(change)
        check(f"'{expected}', found '{found}'", expected in found and "\n" not in found)


def write_recording(folder, segmentation):
    """A recording of several sequences: one bunch, and a leaf that does not count."""
    (folder / "seed_000001").mkdir(parents=True)
    (folder / "dataset.yaml").write_text("complete: true\n")
    cv2.imwrite(str(folder / "seed_000001/0.png"), np.full((4, 6, 3), 90, np.uint8))
    leaf = {"size": [4, 6], "counts": [0, 24]}
    (folder / "instances.json").write_text(json.dumps({
        "categories": [{"id": 1, "name": "bunch"}, {"id": 5, "name": "leaf"}],
        "images": [{"id": 7, "file_name": "seed_000001/0.png"}],
        "annotations": [{"image_id": 7, "category_id": 1, "segmentation": segmentation},
                        {"image_id": 7, "category_id": 5, "segmentation": leaf}]}))


def test_recordings(out):
    # A character holds five bits, lowest first, and 32 if more follow: 20 is 20 + 32 (its fifth bit
    # would be a sign), then 0. From the fourth on they are differences to the last but one.
    check("run lengths", pictures.run_lengths("d0") == [20])
    # 5 3 2 1 13 are 5, 3, 2, 1 − 3 = −2 (30 of five bits) and 13 − 2 = 11; characters from '0' on.
    check("differences", pictures.run_lengths("532N;") == [5, 3, 2, 1, 13])
    write_recording(out / "drive", {"size": [4, 6], "counts": "532N;"})
    found = pictures.open_set(out / "drive", 6)
    # Down the columns of 4: rows 1 to 3 of the second column, and row 2 of the third one.
    expected = np.zeros((4, 6), bool)
    expected[1:4, 1] = expected[2, 2] = True
    check("a recording's bunch", np.array_equal(found.read(0)[1], expected))
    for name, segmentation, expected in (
            ("polygon", [[0, 0, 1, 1]], "has a polygon; masks are read as run lengths (RLE)"),
            ("short", {"size": [4, 6], "counts": "532"}, "run lengths do not add up to 6 × 4"),
            ("size", {"size": [2, 2], "counts": "121"}, "has 2 × 2 pixels, the picture 6 × 4")):
        write_recording(out / name, segmentation)
        message = problem(lambda: pictures.open_set(out / name, 6).verify())
        check(f"'{expected}', found '{message}'", expected in message)
    (out / "size/instances.json").write_text("{}")
    check("no list", "is no list of COCO annotations" in problem(lambda: pictures.open_set(out / "size", 6)))


def test_parts(out):
    for number in range(24):
        write_photograph(out / "many", f"{number:02}", number)
    many = pictures.open_set(out / "many", SIDE)
    names = [[item.name for item in many.part(0.1, seed).items] for seed in (1, 1, 2)]
    check("a tenth of 24, upwards", len(names[0]) == 3)
    check("drawn by the seed", names[0] == names[1] != names[2])
    # The middles of 3 equal parts of 24: 4, 12, 20.
    check("spread", [item.name[:2] for item in many.spread(3).items] == ["04", "12", "20"])
    check("no more than there are", len(many.spread(100)) == 24)


def made_set(image, mask):
    one = pictures.PictureSet("made", [None], mask.shape[1])
    one.read = lambda index: (image, mask)
    return one


def test_crops():
    # A picture that is bright where a bunch is: crops must still agree, but for a pixel at edges.
    mask = np.zeros((480, 752), bool)
    mask[200:300, 300:380] = True
    bright = made_set(np.repeat(np.uint8(250 * mask)[..., None], 3, axis=2), mask)
    images, masks = crops.batch([bright], 1, 0, 40)
    check("size", images.shape == (40, crops.SIZE, crops.SIZE, 3) and images.dtype == np.float32)
    agree = [(image.max(axis=2) > image.max() / 2) == found for image, found in zip(images, masks)]
    check("masks follow pictures", min(one.mean() for one in agree) > 0.99)
    sizes = [found.sum() for found in masks if found.any()]
    # Scales of ±0.75 octaves: 8,000 px become at most 2.8 times as many, and a pixel at the edge.
    check("scales", 8000 < max(sizes) < 8000 * 2 ** 1.5 + 500)
    check("half are about a bunch", 0.5 < np.mean([found.any() for found in masks]))
    again = crops.batch([bright], 1, 0, 40)
    other = [crops.batch([bright], *where, 40)[0] for where in ((2, 0), (1, 1))]
    check("a function of seed and step", np.array_equal(images, again[0])
          and not any(np.array_equal(images, one) for one in other))
    dark = made_set(np.zeros((100, 100, 3), np.uint8), np.zeros((100, 100), bool))
    white = made_set(np.full((100, 100, 3), 255, np.uint8), np.ones((100, 100), bool))
    images, masks = crops.batch([white, dark], 1, 0, 4)
    check("sets in turn, pictures smaller than a crop",
          [found.all() for found in masks] == [True, False, True, False] and not images[1::2].any())


def test_scores():
    truth, found = np.zeros((2, 6), bool), np.zeros((2, 6), bool)
    truth[0, :4] = True  # 4 px, of which 3 are found, and 2 others
    found[0, 1:6] = True
    total = scores.counts(found, truth)
    check("counts", list(total) == [3, 2, 1])
    values = scores.scores(total)
    # IoU 3 / (3 + 2 + 1), F1 6 / (6 + 2 + 1), precision 3 / 5, recall 3 / 4.
    check("scores", np.allclose([values[key] for key in ("iou", "f1", "precision", "recall")],
                                [1 / 2, 2 / 3, 3 / 5, 3 / 4]))
    none = scores.scores([0, 0, 0])
    check("nothing to find and nothing found", none["iou"] is None and none["precision"] is None)
    check("medians", scores.median([0.3, None, 0.1]) == 0.1 and scores.median([None] * 3) is None)


def test_colour_rule():
    # CIELAB of green berries, black ones, a leaf, soil, an overcast sky.
    colours = [(55, -18, 30), (30, 2, -3), (40, -36, 38), (50, 8, 25), (95, 0, 0)]
    strip = np.repeat(np.float32(colours)[None], 40, axis=0).repeat(40, axis=1)
    image = np.round(255 * cv2.cvtColor(strip, cv2.COLOR_LAB2BGR)).astype(np.uint8)
    found = scores.colour_rule(image)[20, 20::40]
    check(f"the colour rule: {found}", list(found) == [True, True, False, False, False])


class Trainer:
    """Stands for the network: seed 1 finds all, 2 nothing, 3 the left half of the truth."""
    TORCH = "none"

    def __init__(self, interrupted_at=None):
        self.trained, self.interrupted_at = [], interrupted_at

    def train(self, sets, seed, steps, tell):
        if len(self.trained) == self.interrupted_at:
            raise KeyboardInterrupt
        self.trained.append(("+".join(one.name for one in sets), len(sets[-1]), seed))
        return seed

    def save(self, seed, file):
        file.write_text(str(seed))

    def load(self, file):
        return int(file.read_text())

    def finder(self, seed):
        found = np.zeros((SIDE, SIDE), bool)
        if seed == 1:
            found[:] = True
        elif seed == 3:
            found[:SIDE // 4, :SIDE // 2] = True
        return lambda image: found


def test_experiment(out):
    write_photograph(out / "photos", "a", 1)
    for number in range(2):
        write_photograph(out / "real", f"{number}", 10 + number)
        write_photograph(out / "ours", f"{number}", 20 + number)
    options = argparse.Namespace(test=str(out / "photos"), real=str(out / "real"), steps=5, width=SIDE,
                                 train=[str(out / "ours")], seeds=[1, 2, 3], out=out / "results",
                                 table=False)

    def run(trainer, **changes):
        changed = argparse.Namespace(**(vars(options) | changes))
        return experiment.Experiment(changed, lambda line: None, lambda: trainer).results()

    first = Trainer(interrupted_at=4)
    try:
        run(first)
        check("interrupted", False)
    except KeyboardInterrupt:
        pass
    second = Trainer()
    rows = run(second)
    check("the interrupted run's rows are kept", first.trained == [
        ("real", 2, 1), ("real", 2, 2), ("real", 2, 3), ("real", 1, 1)])
    check("only what is missing is trained", second.trained == [
        ("real", 1, 2), ("real", 1, 3), *(("ours", 2, seed) for seed in (1, 2, 3)),
        *(("ours+real", 1, seed) for seed in (1, 2, 3))])
    # The truth is a quarter. All: IoU 1/4, F1 2·1/(4 + 1), precision 1/4, recall 1. Half of it:
    # IoU 1/2, F1 2/3, 1, 1/2. Nothing: no precision, which counts as the least.
    cells = "| 1 2 3 | 0.250 | 0.250 0.000 0.500 | 0.400 | 0.400 0.000 0.667 | 0.250 | 0.500 |"
    lines = scores.table(rows).splitlines()[2:]
    trained = ["real (2)", "real, 10% (1)", "ours (2)", "ours (2) + real, 10% (1)"]
    expected = [f"| {name} | photos {cells}" for name in trained] + [f"| real (2) | ours {cells}"]
    rule = [line for line in lines if line.startswith("| nothing: colour rule")]
    check("the table:\n" + "\n".join(lines), [line for line in lines if line not in rule] == expected)
    check("the colour rule's rows", len(rule) == 2 and all("| – |" in line for line in rule))
    check("its file", (out / "results/table.md").read_text() == scores.table(rows))
    kept = json.loads((out / "results/transfer.json").read_text())
    check("each picture's counts", kept["rows"][1]["seeds"]["3"]["pictures"] == {"a.jpg": [512, 0, 512]})
    write_photograph(out / "ours", "0", 30)
    third = Trainer()
    run(third)
    check("another picture, another training", {name for name, _, _ in third.trained} == {"ours", "ours+real"})
    check("--table trains nothing", len(run(None, table=True)) == len(rows))
    check("--table of other settings", len(run(None, table=True, steps=6)) == 2)
    message = problem(lambda: run(None, real=options.test))
    check(message, "is to be tested on, and cannot be trained on" in message)
    write_photograph(out / "ours", "0", 1)
    message = problem(lambda: run(None))
    check(message, "ours: 0.jpg is also in " in message)


def transfer(*words):
    return subprocess.run([sys.executable, "-B", TOOL / "transfer.py", *map(str, words)],
                          capture_output=True, text=True)


def test_program(out):
    write_photograph(out / "test", "a", 1)
    write_photograph(out / "train", "b", 2)
    (out / "empty").mkdir()
    both = [out / "train", "--test", out / "test", "--table", "--out", out / "out"]
    for words, message in (([], "required: --test"),
                           (["--test", out / "test"], "expected a TRAIN or --real to train on"),
                           ([out / "none", "--test", out / "test"], "none: is no folder"),
                           ([*both, "--seeds", "1,x"], "--seeds: expected a whole number from 1 to"),
                           ([*both, "--seeds", "1,1"], "--seeds: expected each seed once, found '1,1'"),
                           ([*both, "--steps", "0"], "--steps: expected a whole number from 1 to"),
                           ([*both, "--width", "8"], "--width: expected a whole number from 64 to"),
                           ([out / "empty", *both[1:]], "empty: has no picture"),
                           ([*both, "--real", out / "test"], "test: is to be tested on")):
        done = transfer(*words)
        check(f"{message}: {done.stderr}", done.returncode == 2 and message in done.stderr
              and len(done.stderr.splitlines()) == 1)
    done = transfer(*both)
    check(f"a table without results: {done.stderr}", done.returncode == 0
          and len(done.stdout.splitlines()) == 2)


def test_training(out):
    """Short, and twice: the same bytes; a third time: nothing is trained."""
    words = [out / "train", "--test", out / "test", "--here", "--steps", 3, "--seeds", "1", "--width",
             SIDE, "--out"]
    tables = [transfer(*words, out / place) for place in ("first", "again", "first")]
    check(f"trained: {tables[0].stderr}", tables[0].returncode == 0 and "step 3 of 3" in tables[0].stderr)
    check("resumed", not tables[2].stderr)
    check("the same table", len({done.stdout for done in tables}) == 1)
    weights = [next((out / place / "results").glob("*/seed-1.pt")).read_bytes()
               for place in ("first", "again")]
    check("the same weights", weights[0] == weights[1])


def main():
    with tempfile.TemporaryDirectory() as name:
        out = Path(name)
        for number, test in enumerate((test_folders, test_broken_folders, test_recordings, test_parts,
                                       test_experiment)):
            (out / str(number)).mkdir()
            test(out / str(number))
        for test in (test_crops, test_scores, test_colour_rule):
            test()
        test_program(out)
        if importlib.util.find_spec("torch"):
            test_training(out)
        else:
            print("torch is not installed: training was left out")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

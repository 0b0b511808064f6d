# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Counts of pixels, what follows from them, the rule of colour, and the table."""
import statistics

import cv2
import numpy as np


def counts(found, truth):
    """Pixels found rightly, found wrongly, and missed."""
    return np.array([(found & truth).sum(), (found & ~truth).sum(), (~found & truth).sum()])


def ratio(part, whole):
    return float(part / whole) if whole else None


def scores(total):
    """Of the pixels of all pictures together."""
    right, wrong, missed = (int(value) for value in total)
    return {"iou": ratio(right, right + wrong + missed),
            "f1": ratio(2 * right, 2 * right + wrong + missed),
            "precision": ratio(right, right + wrong), "recall": ratio(right, right + missed),
            "right": right, "wrong": wrong, "missed": missed}


def evaluate(find, pictures):
    """`find` gives a picture's mask. Scores over all of them, and the counts of each."""
    each = {}
    for index, item in enumerate(pictures.items):
        image, truth = pictures.read(index)
        each[item.name] = counts(find(image), truth)
    return scores(sum(each.values())) | {
        "pictures": {name: [int(value) for value in found] for name, found in each.items()}}


# CIELAB; chosen by hand on photographs of WGISD that the table in docs/transfer.md is not tested on.
DARK = {"below": (45, np.inf, 2)}
GREEN = {"above": (35, -30, 20), "below": (75, -8, 45)}


def colour_rule(image):
    """A bunch is what is as yellow-green as green berries, or as dark and bluish as black ones."""
    smooth = cv2.GaussianBlur(image, (0, 0), 3).astype(np.float32) / 255
    lab = cv2.cvtColor(smooth, cv2.COLOR_BGR2LAB)
    dark = (lab < DARK["below"]).all(axis=2)
    green = ((lab > GREEN["above"]) & (lab < GREEN["below"])).all(axis=2)
    return dark | green


def median(values):
    """None counts as the least: nothing was found where nothing is."""
    found = statistics.median(-1 if value is None else value for value in values)
    return None if found < 0 else found


def number(value):
    return "–" if value is None else f"{value:.3f}"


COLUMNS = {"IoU": "iou", "F1": "f1"}


def table(rows):
    """Of rows with what was trained and tested on, and scores by seed (0: nothing is drawn)."""
    head = ["trained on", "tested on", "seeds"]
    for name in COLUMNS:
        head += [name, f"{name} of each seed"]
    lines = [f"| {' | '.join([*head, 'precision', 'recall'])} |",
             "|---|---|---|" + "---:|---|" * len(COLUMNS) + "---:|---:|"]
    for row in rows:
        found = row["seeds"]
        cells = [row["trained_on"], row["tested_on"],
                 " ".join(str(seed) for seed in found) if list(found) != [0] else "–"]
        for key in COLUMNS.values():
            values = [score[key] for score in found.values()]
            cells += [number(median(values)), " ".join(map(number, values)) if len(values) > 1 else "–"]
        cells += [number(median([score[key] for score in found.values()]))
                  for key in ("precision", "recall")]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"

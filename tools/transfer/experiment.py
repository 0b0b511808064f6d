# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""What is trained on what and tested on what; results that are there are kept."""
import hashlib
import json
import os
from pathlib import Path

import pictures
import scores

VERSION = 1  # of network, crops and scores: another one, and kept results no longer apply
TESTED = 100  # pictures of a recording that is tested on, evenly spread
SHARE = 0.1  # of the real pictures, where there are few


def written(file, write):
    """A file that is there whole or not at all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    unfinished = file.with_name(f"{file.name}.{os.getpid()}")
    try:
        write(unfinished)
        unfinished.replace(file)
    finally:
        unfinished.unlink(missing_ok=True)


def write_json(file, value):
    text = json.dumps(value, indent=1, ensure_ascii=False) + "\n"
    written(file, lambda path: path.write_text(text))


def key_of(value):
    return hashlib.blake2b(json.dumps(value, sort_keys=True).encode(), digest_size=8).hexdigest()


class Experiment:
    """Sets of pictures, and what was trained and tested on them. `trainer` gives the module
    network, which is not asked for before something is trained."""

    def __init__(self, options, say, trainer):
        self.options, self.say, self.trainer = options, say, trainer
        self.sets, self.prints = {}, {}
        tested = self.add(options.test)
        for path in dict.fromkeys([*filter(None, [options.real]), *options.train]):
            if Path(path).resolve() == Path(options.test).resolve():
                raise pictures.Problem(f"{path}: is to be tested on, and cannot be trained on")
            for found in self.add(path).items():
                if found[0] in tested:
                    raise pictures.Problem(
                        f"{path}: {found[1]} is also in {options.test}, which is to be tested on")

    def add(self, path):
        """Opens a set and reads it once; returns the hashes of its pictures."""
        names = {one.name for one in self.sets.values()}
        name = Path(path).resolve().name
        self.sets[path] = pictures.open_set(path, self.options.width, path if name in names else name)
        images, self.prints[path] = self.sets[path].verify()
        return images

    def rows(self):
        """What to train on, as parts of (set, share), and what to test on."""
        test, real = self.options.test, self.options.real
        rows = [((), test)]
        if real:
            rows += [(((real, 1.0),), test), (((real, SHARE),), test)]
        for ours in self.options.train:
            rows.append((((ours, 1.0),), test))
            if real:
                rows.append((((ours, 1.0), (real, SHARE)), test))
        tested = [((), ours) for ours in self.options.train]
        tested += [(((real, 1.0),), ours) for ours in self.options.train if real]
        return rows + [row for row in tested if row not in rows]

    def name(self, parts):
        names = []
        for path, share in parts:
            part = self.sets[path] if share == 1 else self.sets[path].part(share, 0)
            names.append(f"{part.name}{'' if share == 1 else f', {share:.0%}'} ({len(part)})")
        return " + ".join(names) or "nothing: colour rule"

    def tested(self, path):
        whole = self.sets[path]
        return whole if path == self.options.test else whole.spread(TESTED)

    def folder(self, parts):
        key = {"version": VERSION, "width": self.options.width,
               "sets": [[self.prints[path], share] for path, share in parts],
               "steps": self.options.steps if parts else 0}
        return self.options.out / "results" / key_of(key)

    def result_file(self, parts, test, seed):
        key = key_of([self.prints[test], len(self.tested(test))])
        return self.folder(parts) / f"seed-{seed}-on-{key}.json"

    def trained(self, parts, seed):
        """The mask of a picture by the network, which is trained unless it is there."""
        network = self.trainer()
        file = self.folder(parts) / f"seed-{seed}.pt"
        if file.is_file():
            return network.finder(network.load(file))
        name = f"{self.name(parts)}, seed {seed}"
        sets = [self.sets[path] if share == 1 else self.sets[path].part(share, seed)
                for path, share in parts]
        found = network.train(sets, seed, self.options.steps,
                              lambda line: self.say(f"{name}: {line}"))
        written(file, lambda path: network.save(found, path))
        return network.finder(found)

    def score(self, parts, test, seed):
        """The result of a row and seed; None with --table where it is not there."""
        file = self.result_file(parts, test, seed)
        if file.is_file():
            return json.loads(file.read_text())
        if self.options.table:
            return None
        if parts:
            find, torch = self.trained(parts, seed), self.trainer().TORCH
            result = scores.evaluate(find, self.tested(test)) | {"torch": torch}
        else:
            result = scores.evaluate(scores.colour_rule, self.tested(test))
        result = {"trained_on": self.name(parts), "tested_on": self.sets[test].name} | result
        write_json(file, result)
        return result

    def results(self):
        """Row by row; after each the files of results have what there is."""
        done = []
        for parts, test in self.rows():
            found = {}
            for seed in self.options.seeds if parts else [0]:
                result = self.score(parts, test, seed)
                if result:
                    found[seed] = result
            if found:
                done.append({"trained_on": self.name(parts), "tested_on": self.sets[test].name,
                             "tested_pictures": len(self.tested(test)), "seeds": found})
                write_results(self.options, done)
        return done


def write_results(options, rows):
    write_json(options.out / "transfer.json", {
        "version": VERSION, "steps": options.steps, "width_px": options.width, "rows": rows})
    written(options.out / "table.md", lambda path: path.write_text(scores.table(rows)))

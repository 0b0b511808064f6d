#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The house: which folder may include which, and how large one may be.

Usage: structure_test.py ROOT

Prints every include against the arrows, every cycle of components (a header and its source are
one), every folder of too many files, every source without a test that mirrors it, every type that
two headers define in one namespace, and what one of the two compilers does not know. The order of
sub-folders is read from docs/architecture.md, so that the document cannot be wrong about it.
"""

import collections
import pathlib
import re
import sys

# Folder: the folders it may include besides itself.
ARROWS = {
    "core": set(),
    "slam": {"core"},
    "sim": {"core"},
    "harness": {"core", "slam", "sim"},
    "tools": {"core", "harness"},
    "python": {"core", "harness", "slam"},
    "examples": {"core", "harness", "slam"},
}
# Where the truth may be known; `slam` is not among them.
KNOW_THE_TRUTH = {"core/truth", "sim", "harness", "tools", "python"}
MOST_FILES = 24
# clang 14, which builds the fuzzers, does not compile these with libstdc++ 12.
SUBRANGES = re.compile(
    r"std::ranges::(unique|remove|remove_if|partition|stable_partition|rotate|search|find_end|"
    r"equal_range)\(|std::(ranges::)?views::")
ORDER = re.compile(r"^order of `(\w+)/`: (.+)$", re.M)


def component(path):
    return re.sub(r"\.(h|cpp)$", "", path)


class Tree:
    def __init__(self, root):
        self.root = root
        self.problems = []
        self.includes = {}  # file: [(line, included file)]
        for top in [*ARROWS, "tests"]:
            for file in sorted((root / top).rglob("*")):
                if file.suffix in (".h", ".cpp"):
                    self.includes[file.relative_to(root).as_posix()] = self.read(file)

    def read(self, file):
        found = []
        for number, line in enumerate(file.read_text().splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*"([^"]+)"', line)
            if match:
                found.append((number, match.group(1)))
        return found

    def fail(self, text):
        self.problems.append(text)


def top_of(path):
    return path.split("/")[0]


def check_arrows(tree):
    for file, includes in tree.includes.items():
        own = top_of(file)
        for number, included in includes:
            other = top_of(included)
            where = f"{file}:{number}"
            if included.startswith("."):
                tree.fail(f"{where}: relative include {included}")
            elif own != "tests" and other == "tests":
                tree.fail(f"{where}: includes a test's {included}")
            elif own in ARROWS and other in ARROWS and other != own and other not in ARROWS[own]:
                tree.fail(f"{where}: {own} must not include {included}")
            elif included.startswith("core/truth/") and own != "tests":
                if not any(file.startswith(f"{folder}/") for folder in KNOW_THE_TRUTH):
                    tree.fail(f"{where}: {own} must not know the truth ({included})")


def sub_folder(path, order):
    """The sub-folder of a file that has a place in the order: the longest; "." is the top."""
    parent = str(pathlib.PurePosixPath(path).parent)
    parts = parent.split("/")[1:]
    while parts:
        name = "/".join(parts)
        if name in order:
            return name
        parts.pop()
    return "."


def check_order(tree, orders):
    for file, includes in tree.includes.items():
        top = top_of(file)
        if top not in orders:
            continue
        order = orders[top]
        own = sub_folder(file, order)
        for number, included in includes:
            if top_of(included) != top:
                continue
            other = sub_folder(included, order)
            if order.index(other) > order.index(own):
                tree.fail(f"{file}:{number}: {top}/{own} comes before {top}/{other} ({included})")


def check_orders_complete(tree, orders):
    for top, order in orders.items():
        for file in tree.includes:
            if top_of(file) != top:
                continue
            parent = pathlib.PurePosixPath(file).parent.as_posix()
            if parent != top and sub_folder(file, order) == ".":
                tree.fail(f"{parent}/: has no place in the order of {top}/ (docs/architecture.md)")


def check_cycles(tree):
    graph = collections.defaultdict(set)
    for file, includes in tree.includes.items():
        for _, included in includes:
            if component(included) != component(file):
                graph[component(file)].add(component(included))
    index, low, on_stack, stack, cycles = {}, {}, set(), [], []

    def visit(node):  # Tarjan 1972
        index[node] = low[node] = len(index)
        stack.append(node)
        on_stack.add(node)
        for other in sorted(graph[node]):
            if other not in index:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in on_stack:
                low[node] = min(low[node], index[other])
        if low[node] == index[node]:
            members = []
            while True:
                members.append(stack.pop())
                on_stack.discard(members[-1])
                if members[-1] == node:
                    break
            if len(members) > 1:
                cycles.append(sorted(members))

    sys.setrecursionlimit(10000)
    for node in sorted(graph):
        if node not in index:
            visit(node)
    for cycle in cycles:
        tree.fail(f"include cycle of {len(cycle)} components: {', '.join(cycle)}")


def check_sizes(tree):
    count = collections.Counter(
        str(pathlib.PurePosixPath(file).parent)
        for file in tree.includes
        if top_of(file) not in ("tests", "examples")
    )
    for folder, files in sorted(count.items()):
        if files > MOST_FILES:
            tree.fail(f"{folder}/: {files} files, at most {MOST_FILES}")


def check_subranges(tree):
    for file in tree.includes:
        for number, line in enumerate((tree.root / file).read_text().splitlines(), 1):
            if match := SUBRANGES.search(line):
                tree.fail(f"{file}:{number}: {match.group(0)} does not compile with clang 14")


def check_types(tree):
    """Two types of one name in one namespace: the linker takes the destructor of either for both."""
    headers = collections.defaultdict(set)
    for file in tree.includes:
        if not file.endswith(".h"):
            continue
        namespaces = []
        for line in (tree.root / file).read_text().splitlines():
            if match := re.match(r"namespace ([\w:]+) {", line):
                namespaces.append(match.group(1))
            elif line.startswith("}  // namespace"):
                namespaces.pop()
            elif match := re.match(r"(?:struct|class|union|enum class) (\w+)[^;]*{", line):
                headers["::".join([*namespaces, match.group(1)])].add(file)
    for name, files in sorted(headers.items()):
        if len(files) > 1:
            tree.fail(f"{name} is defined in {' and in '.join(sorted(files))}")


def check_tests(tree, untested):
    """A source with logic of its own has a test that mirrors it, or a line in the list of those
    that another test stands for."""
    for file in tree.includes:
        top = top_of(file)
        if top not in ("core", "slam", "sim", "harness", "tools") or not file.endswith(".cpp"):
            continue
        if (tree.root / "tests" / file.replace(".cpp", "_test.cpp")).exists():
            untested.pop(file, None)
            continue
        if file not in untested:
            tree.fail(f"{file}: no tests/{component(file)}_test.cpp, and no line in {LIST}")
            continue
        stand_in = untested.pop(file)
        if not (tree.root / stand_in).exists():
            tree.fail(f"{LIST}: {file}: there is no {stand_in}")
    for file in untested:
        tree.fail(f"{LIST}: {file}: is not there, or has a test of its own")


LIST = "tests/tools/tested_elsewhere.txt"


def read_list(file):
    entries = {}
    for line in file.read_text().splitlines():
        if line and not line.startswith("#"):
            source, test = line.split()
            entries[source] = test
    return entries


def main():
    root = pathlib.Path(sys.argv[1])
    tree = Tree(root)
    text = (root / "docs/architecture.md").read_text()
    orders = {top: names.replace("`", "").replace("(top)", ".").split(", ")
              for top, names in ORDER.findall(text)}
    for top in ("core", "slam", "sim", "harness", "tools"):
        if top not in orders:
            tree.fail(f"docs/architecture.md: expected a line 'order of `{top}/`: ...'")
    check_arrows(tree)
    check_order(tree, orders)
    check_orders_complete(tree, orders)
    check_cycles(tree)
    check_sizes(tree)
    check_subranges(tree)
    check_types(tree)
    check_tests(tree, read_list(root / LIST))
    for problem in sorted(set(tree.problems)):
        print(problem)
    print(f"{len(tree.includes)} files, {len(set(tree.problems))} problems")
    return 1 if tree.problems else 0


if __name__ == "__main__":
    sys.exit(main())

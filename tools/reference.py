#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the reference: every key of the files that the program reads, and every command.

Usage: reference.py VINEBENCH ROOT FOLDER

What there is, types, defaults and ranges come from the program (`vinebench reference --json`); what
a key means, from the comment beside it in the source.
"""
import json
import pathlib
import re
import subprocess
import sys

SCOPE = re.compile(r"^\s*(?:namespace ([\w:]*)|(?:struct|class) (\w+)(?: : [^{;]+)?) ?\{$")
MEMBER = re.compile(r"^\s*([\w:][\w:<>, ]*?) (\w+)(?:\{.*\}| = .*)?;(?:\s*///< (.*))?$")
OPENED = re.compile(r"^\s*([\w:][\w:<>, ]*?) (\w+)(?:\{| =)(?:.*[^;])?$")
TRAILING = re.compile(r"^.*;\s*///< (.*)$")
COMMENT = re.compile(r"^\s*///<? ?(.*)$")
FIELD = re.compile(r'archive\("(\w+)", ([\w.]+)')
PART = re.compile(r"([\w:]+)(?:\.|::)serialize\(archive\)")
# Parts whose own parts have tables of their own.
DEEP = ("world", "sensors", "slam")
# What the program reads before the rest.
WITHOUT_STRUCT = {"base": "another scenario, whose keys are inherited"}
UNNAMED = "(anonymous namespace)"


class Struct:
    """Comments of its members, and which member a key is."""

    def __init__(self, about):
        self.about = about
        self.members = {}  # name: (type, comment)
        self.keys = {}  # key: name of the member
        self.parts = []  # members whose keys are at the same level, and the base class


def without_strings(line):
    return re.sub(r'"(?:[^"\\]|\\.)*"|\'.\'', '""', line)


class Sources:
    """The structs of all headers, by their full names."""

    def __init__(self, root):
        self.structs = {}
        for top in ("core", "slam", "sim", "harness"):
            for file in sorted((root / top).rglob("*")):
                if file.suffix in (".h", ".cpp") and "serialize(Archive" in file.read_text():
                    self.read(file.read_text().splitlines())

    def read(self, lines):
        scopes, before, last = [], [], None  # names of the open braces; None for others
        for line in lines:
            code = without_strings(line).split("//")[0].rstrip()
            comment = COMMENT.match(line)
            if comment and not code.strip():
                if line.strip().startswith("///<") and last:
                    kind, text = last[0].members[last[1]]
                    last[0].members[last[1]] = kind, f"{text} {comment[1]}".strip()
                else:
                    before.append(comment[1])
                continue
            scope = SCOPE.match(code)
            owner = self.owner(scopes)
            if scope:
                name = scope[2] or scope[1] or UNNAMED
                scopes.append(name)
                if scope[2]:
                    self.structs["::".join(scopes)] = Struct(" ".join(before))
            else:
                opened = last and not MEMBER.match(line) and last[2]
                last = (self.rest(last, line) if opened and owner else
                        self.member(owner, line, before) if owner else None)
                difference = code.count("{") - code.count("}")
                scopes += [None] * difference
                del scopes[len(scopes) + min(difference, 0):]
            before = []
            self.fields(scopes, line)

    def owner(self, scopes):
        return self.structs.get("::".join(scopes)) if None not in scopes else None

    def member(self, owner, line, before):
        found = MEMBER.match(line) or OPENED.match(line)
        if not found or found[1].split()[0] in ("return", "using", "friend", "template"):
            return None
        told = found[3] if found.re is MEMBER else None
        owner.members[found[2]] = found[1], " ".join(filter(None, [*before, told]))
        return owner, found[2], found.re is OPENED

    def rest(self, last, line):
        """The comment of a member whose declaration goes on in this line."""
        told = TRAILING.match(line)
        if told:
            kind, text = last[0].members[last[1]]
            last[0].members[last[1]] = kind, f"{text} {told[1]}".strip()
        return None if line.rstrip().endswith(";") and not told else last

    def fields(self, scopes, line):
        """Of the struct whose function is open."""
        named = scopes[:scopes.index(None)] if None in scopes else scopes
        owner = self.structs.get("::".join(named))
        if owner:
            for key, member in FIELD.findall(line):
                owner.keys.setdefault(key, member.split(".")[-1])
            owner.parts += PART.findall(line)

    def of_type(self, kind):
        """The struct that a member's type names."""
        word = re.findall(r"[\w:]+", kind)[-1]
        named = [s for name, s in self.structs.items() if name.endswith(f"::{word}")]
        return named[0] if len(named) == 1 else None

    def comment(self, owner, key):
        """What is written beside a key, "" if nothing is."""
        if not owner:
            return WITHOUT_STRUCT[key]
        key = re.sub(r"\.(N|NAME)$", "", key)  # an entry is what its list has
        struct = self.structs.get(owner)
        if struct is None:
            return ""
        if key in struct.keys:
            kind, text = struct.members.get(struct.keys[key], ("", ""))
            inner = self.of_type(kind) if not text and kind else None
            return text or (inner.about if inner else "")
        for part in struct.parts:  # members whose keys are at the same level, or the base class
            inner = self.of_type(struct.members[part][0] if part in struct.members else part)
            if inner and key in inner.keys:
                name = next(name for name, s in self.structs.items() if s is inner)
                return self.comment(name, key)
        # A function that several structs call.
        others = [s for s in self.structs.values() if s.members.get(key, ("", ""))[1]]
        return others[0].members[key][1] if len(others) == 1 else ""


def cell(text):
    return text.replace("|", "\\|").replace("<", "&lt;")


def code(text):
    return f"`{text}`" if text else ""


def sections_of(keys):
    """Keys by the part of the file that they belong to; those without a part under ""."""
    parts = {key["key"] for key in keys if key["type"].startswith(("map", "list of maps"))}
    sections = {"": []}
    for key in keys:
        names = key["key"].split(".")
        depth = 2 if names[0] in DEEP and ".".join(names[:2]) in parts else 1
        title = ".".join(names[:depth])
        sections.setdefault(title if title in parts else "", []).append(key)
    return sections


def key_page(files, sources):
    lines = ["# Keys of files", "",
             "Made from the program and the comments in its source; `vinebench reference` prints "
             "the same without the meanings. `N` stands for the number of an entry, `NAME` for a "
             "name of your choice. Explained with examples: [scenarios](../scenarios.md), "
             "[worlds](../worlds.md), [sensors](../sensors.md), [plants](../plants.md), "
             "[data sets](../datasets.md#randomisation).", ""]
    for file in files:
        lines += [f"## {file['name'].capitalize()}", "", file["description"], ""]
        for title, keys in sections_of(file["keys"]).items():
            if not keys:
                continue
            lines += [f"### {file['name']}: {title}", ""] if title else []
            lines += ["| key | type | default | range | meaning |", "|---|---|---|---|---|"]
            for key in keys:
                meaning = sources.comment(key["owner"], key["own_key"])
                lines.append(f"| `{key['key']}` | {cell(key['type'])} | {code(key['value'])} | "
                             f"{key['range']} | {cell(meaning)} |")
            lines.append("")
    return "\n".join(lines)


def command_lines(command, words):
    names = [*words, command["name"]]
    usage = [option["name"] for option in command["options"] if not option["name"].startswith("-")]
    lines = [f"## {' '.join(names)}", "", f"{command['description']}.", "",
             f"    {' '.join(['vinebench', *names, *usage])} …", ""]
    if command["options"]:
        lines += ["| option | | meaning |", "|---|---|---|"]
    for option in command["options"]:
        details = [option["type"], *option.get("choices", [])]
        details += [option["range"]] if "range" in option else []
        details += ["required"] if option["required"] else []
        lines.append(f"| `{option['name']}` | {cell(', '.join(filter(None, details)))} | "
                     f"{cell(option['help'])} |")
    lines += ["", command["footer"].strip(), ""]
    for part in command["commands"]:
        lines += command_lines(part, names)
    return lines


def command_page(program):
    lines = ["# Commands", "", "Made from the program; `vinebench COMMAND --help` prints the same. "
             "What they do: [running](../running.md).", ""]
    for command in program["commands"]:
        lines += command_lines(command, [])
    return "\n".join(lines)


def reference_of(vinebench):
    run = subprocess.run([vinebench, "reference", "--json"], capture_output=True, text=True,
                         check=True)
    return json.loads(run.stdout)


def main():
    told, root = reference_of(sys.argv[1]), pathlib.Path(sys.argv[2])
    folder = pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "keys.md").write_text(key_page(told["files"], Sources(root)))
    (folder / "commands.md").write_text(command_page(told["program"]))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the program on damaged inputs and counts how it ends.

Usage: mutate.py VINEBENCH ROOT [--cases N] [--first N] [--seed N] [--jobs N] [--keep FOLDER] [--only KIND]

The inputs (scenario, world, rover, rig, map, recordings, trajectories, metrics, meshes) are made
with the program itself and damaged one file at a time: bits, bytes and lines, numbers, keys and
types, invalid UTF-8, links, pipes, devices. Each case is a function of the seed and its number. A
whole command then runs with 30 s of processor time, 300 s in all (a loaded machine must not look
like a hang) and 2 GB of memory. Expected are the exit codes 0, 1 and 2;
exit code 3, a signal or a hang is an offence: its inputs and command are kept, and the exit code of
this tool is 1.
"""

import argparse
import base64
import collections
import multiprocessing
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import zlib

PROCESSOR_SECONDS = 30
SECONDS = 300
MEMORY = 2 << 30
LARGEST_OUTPUT = 1 << 30
OFFENCES = ("3", "other code", "signal", "hang")
OUTCOMES = ("0", "1", "2", "memory", *OFFENCES)

NUMBERS = ["0", "-1", "1", "1e308", "-1e308", "1e999", "nan", "-nan", "inf", "-.inf", ".nan",
           "1e-320", "255", "256", "65536", "2147483647", "2147483648", "-2147483649",
           "4294967296", "9223372036854775807", "9223372036854775808", "-9223372036854775808",
           "18446744073709551616", "1" * 400, "0x10", "1_000", "0.5", "-0.0", "1,5", "1e", "+"]
VALUES = ["", "~", "true", "[]", "{}", "[1, 2, 3]", "{a: 1}", "'text'", "\"\\x00\"", "&a [*a]", "*a",
          "!!binary aGVsbG8=", "[" * 300, "- - -", "../../..", "/dev/zero", "/", "a/../b",
          "\"" + "x" * 5000 + "\"", "tag36h11", "\ufeff", "<<: *b", "|", ">-", "%YAML 1.2", "---"]

CAMERA = "width: 376, height: 240, fx: 132, fy: 132, cx: 187.5, cy: 119.5, rpy_deg: [0, 0, 0]"
RIG = f"""name: small
rate_hz: 15
cameras:
  - {{name: front_left, position: [0.15, 0.06, 0.5], {CAMERA}}}
  - {{name: front_right, position: [0.15, -0.06, 0.5], {CAMERA}}}
stereo_pairs:
  - {{name: front, left: front_left, right: front_right}}
tag_cameras: []
"""
SCENARIO = """name: small
seed: 1
world: world.yaml
rover: rover.yaml
renderer: {engine: fake}
duration: 0.3
boxes:
  - {name: carton, size: [0.5, 1.25, 0.8], position: [5.15, 0.325]}
occluders:
  - {shape: box, class: crate, name: crate, size: [0.4, 0.3, 0.2], position: [2, 0.5]}
route:
  speed: 0.5
  acceleration: 0.8
  waypoints:
    - {position: [0.4, 1.25], heading_deg: 0, wait: 0.1}
    - {position: [1.5, 1.25], heading_deg: 0}
slam:
  cameras: front
expectations:
  coverage_min: 1
  ate_origin_rmse_max: 0.0035
"""

OBJ = """mtllib mesh.mtl
o box
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 1
vt 0 0
vt 1 0
vt 1 1
vn 0 0 1
usemtl bark
s 1
f 1/1/1 2/2/1 3/3/1
f 1/1/1 3/3/1 4/2/1 2/1/1
"""
MTL = """# one material
newmtl bark
Ka 0 0 0
Kd 0.5 0.4 0.3
Ks 0 0 0
Ns 10
d 1
illum 2
map_Kd mesh.png
map_d mesh.png
map_Bump -bm 0.1 mesh.png
"""
DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="m" meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_images><image id="i"><init_from>mesh.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert>
<diffuse><color>0.5 0.4 0.3 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 0 1 2 1 1 1</float_array><technique_common>
<accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles material="m" count="2"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 1 3 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="m" target="#m"/>
</technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
"""
STL = """solid box
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 1
endloop
endfacet
facet normal 0 0 1
outer loop
vertex 1 0 0
vertex 1 1 0
vertex 0 1 1
endloop
endfacet
endsolid box
"""


def gltf():
    """A tetrahedron with its buffer inside the JSON, and a texture."""
    points = struct.pack("<12f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)
    corners = struct.pack("<12H", 0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3)
    data = base64.b64encode(points + corners).decode()
    return """{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0, "scale": [1, 1, 1], "rotation": [0, 0, 0, 1]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0, "mode": 4}]}],
"materials": [{"name": "bark", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.4, 0.3, 1],
"baseColorTexture": {"index": 0}}}],
"textures": [{"source": 0}], "images": [{"uri": "mesh.png"}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
{"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
"buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64,%s"}]}
""" % data


def png(width, height):
    """Grey noise-free rows."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = zlib.compress((b"\0" + bytes(width)) * height)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0))
            + chunk(b"IDAT", rows) + chunk(b"IEND", b""))


RECORD_TWO = ["record", "{base}/scenario/scenario.yaml", "--format", "coco", "--seeds", "1..2", "--frames", "0..1",
              "--out", "resumed"]


# --- damage --------------------------------------------------------------------------------------


def flip_bits(data, rng):
    data = bytearray(data)
    for _ in range(rng.choice((1, 1, 2, 8, 40))):
        if data:
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    return bytes(data)


def truncate(data, rng):
    return data[:rng.randrange(len(data) + 1)]


def overwrite(data, rng):
    at = rng.randrange(len(data) + 1)
    size = rng.choice((1, 2, 4, 8))
    part = rng.choice((b"\xff" * size, b"\0" * size, rng.randbytes(size), b"\x7f" + b"\xff" * (size - 1)))
    return data[:at] + part + data[at + size:]


def cut_out(data, rng):
    at = rng.randrange(len(data) + 1)
    return data[:at] + data[at + rng.choice((1, 4, 16, 1000)):]


def insert(data, rng):
    at = rng.randrange(len(data) + 1)
    part = rng.choice((b"\xff\xfe", b"\xc3\x28", b"\0", b"\xed\xa0\x80", b"\r", b"\n\n", b"\t", b"{", b"]",
                       b"\x1b[2J", b"," * 50, b"\x0c", rng.randbytes(9), b"9" * 400, b"[" * 5000))
    return data[:at] + part + data[at:]


def in_lines(change):
    def damage(data, rng):
        lines = data.split(b"\n")
        change(lines, rng)
        return b"\n".join(lines)
    damage.__name__ = change.__name__
    return damage


def repeat_line(lines, rng):
    at = rng.randrange(len(lines))
    lines[at:at] = [lines[at]] * rng.choice((1, 1, 2, 1000))


def delete_line(lines, rng):
    at = rng.randrange(len(lines))
    del lines[at:at + rng.choice((1, 1, 3))]


def swap_lines(lines, rng):
    a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[a], lines[b] = lines[b], lines[a]


def replace_match(data, rng, pattern, values):
    found = list(re.finditer(pattern, data))
    if not found:
        return insert(data, rng)
    match = rng.choice(found)
    return data[:match.start()] + rng.choice(values).encode() + data[match.end():]


def extreme_number(data, rng):
    return replace_match(data, rng, rb"[-+]?\d+(\.\d+)?(e[-+]?\d+)?", NUMBERS)


def wrong_type(data, rng):
    return replace_match(data, rng, rb"(?<=[:,\[ ])[^\n:,\[\]{}]+", VALUES + NUMBERS)


def swap_keys(data, rng):
    keys = list(re.finditer(rb"[A-Za-z_]+(?=[\"']?\s*[:=])", data))
    if len(keys) < 2:
        return flip_bits(data, rng)
    a, b = sorted(rng.sample(range(len(keys)), 2))
    a, b = keys[a], keys[b]
    return data[:a.start()] + b.group() + data[a.end():b.start()] + a.group() + data[b.end():]


def utf16(data, _):
    return data.decode("latin-1").encode("utf-16")


TEXT = [extreme_number] * 4 + [wrong_type] * 3 + [
    flip_bits, truncate, insert, insert, cut_out, swap_keys, swap_keys, utf16, in_lines(repeat_line),
    in_lines(delete_line), in_lines(delete_line), in_lines(swap_lines)]
BINARY = [flip_bits, flip_bits, truncate, overwrite, overwrite, overwrite, cut_out, insert]


def crc64(data, table=[]):
    if not table:
        for value in range(256):
            for _ in range(8):
                value = (value >> 1) ^ (0xC96C5795D7870F42 if value & 1 else 0)
            table.append(value)
    crc = 0xFFFFFFFFFFFFFFFF
    for byte in data:
        crc = table[(crc ^ byte) & 0xFF] ^ (crc >> 8)
    return crc ^ 0xFFFFFFFFFFFFFFFF


def seal_map(data, _):
    """With the length and the checksum of what it now holds, which else would find all damage."""
    content = data[20:-8]
    data = data[:12] + struct.pack("<Q", len(content)) + content
    return data + struct.pack("<Q", crc64(data))


def seal_png(data, _):
    """With the checksums of its chunks."""
    at = 8
    while at + 12 <= len(data):
        size = struct.unpack(">I", data[at:at + 4])[0]
        end = at + 8 + size
        if end + 4 > len(data):
            break
        data = data[:end] + struct.pack(">I", zlib.crc32(data[at + 4:end])) + data[end + 4:]
        at = end + 4
    return data


def replace_file(file, rng):
    """By something that is no such file."""
    kind = rng.choice(("pipe", "zero", "loop", "dangling", "folder", "empty", "huge", "self", "null"))
    file.unlink()
    if kind == "pipe":
        os.mkfifo(file)
    elif kind == "folder":
        file.mkdir()
    elif kind == "empty":
        file.write_bytes(b"")
    elif kind == "huge":
        file.touch()
        os.truncate(file, 1 << 42)
    else:
        target = {"zero": "/dev/zero", "null": "/dev/null", "loop": file.name, "dangling": "gone",
                  "self": "/proc/self/mem"}[kind]
        file.symlink_to(target)
    return kind


def damage_file(file, rng):
    """Damages the file; returns how."""
    if rng.random() < 0.08:
        return replace_file(file, rng)
    data = file.read_bytes()
    text = file.suffix not in (".png", ".map", ".glb", ".jpg")
    done = []
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        change = rng.choice(TEXT if text else BINARY)
        if not text and len(data) > 4096 and rng.random() < 0.4:  # the head of a large file
            data = change(data[:256], rng) + data[256:]
        else:
            data = change(data, rng)
        done.append(change.__name__)
    if file.suffix == ".map" and rng.random() < 0.9 and len(data) > 40:
        data = seal_map(data, rng)
    if file.suffix == ".png" and rng.random() < 0.7:
        data = seal_png(data, rng)
    file.unlink()
    file.write_bytes(data)
    return "+".join(done)


# --- inputs --------------------------------------------------------------------------------------


class Kind:
    """Inputs of one kind: folders of the base, files that may be damaged, and the command."""

    def __init__(self, folders, files, command):
        self.folders, self.files, self.command = folders, files, command


def run_checked(command, folder):
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if result.returncode not in (0, 1):
        sys.exit(f"mutate.py: {' '.join(map(str, command))}: exit code {result.returncode}\n{result.stderr}")


def write_scenario(folder, root, program):
    folder.mkdir()
    run_checked([program, "world", "small", "--rows", "1", "--length", "3", "--terrain", "even",
                 "--out", "world.yaml"], folder)
    for name in ("rover.xml", "rover.yaml"):
        shutil.copy(root / "models/csl-rover" / name, folder)
    (folder / "rig.yaml").write_text(RIG)
    (folder / "scenario.yaml").write_text(SCENARIO)


def write_meshes(folder):
    for name, text in (("mesh.obj", OBJ), ("mesh.mtl", MTL), ("mesh.dae", DAE), ("mesh.stl", STL),
                       ("mesh.gltf", gltf())):
        (folder / name).write_text(text)
    binary = b" " * 80 + struct.pack("<I", 2)
    for corners in ((0, 0, 0, 1, 0, 0, 0, 1, 1), (1, 0, 0, 1, 1, 0, 0, 1, 1)):
        binary += struct.pack("<12fH", 0, 0, 1, *corners, 0)
    (folder / "binary.stl").write_bytes(binary)
    (folder / "mesh.png").write_bytes(png(8, 8))


def make_base(base, root, program):
    """The inputs, whole, in folders of `base`."""
    write_scenario(base / "scenario", root, program)
    run_checked([program, "run", "scenario/scenario.yaml", "--out", "run", "--threads", "1"], base)
    shutil.rmtree(base / "run/frames")
    formats = "euroc,kitti,mcap,tum,coco,depth,semantic,instances,flow,normals,disparity"
    run_checked([program, "record", "scenario/scenario.yaml", "--format", formats, "--out", "data",
                 "--frames", "0..3"], base)
    run_checked([program, *(word.replace("{base}", str(base)) for word in RECORD_TWO)], base)
    (base / "map").mkdir()
    run_checked([program, "replay", "data", "--out", "replayed", "--save-map", "map/row.map"], base)
    shutil.rmtree(base / "replayed")
    shutil.copytree(base / "scenario", base / "mesh")
    write_meshes(base / "mesh")
    (base / "bags").mkdir()
    for bag, name in (("mcap/plain", "plain.mcap"), ("db3/small", "small.db3")):
        shutil.copy(root / "tests/fuzz/corpus" / bag, base / "bags" / name)


def mesh_kind(*names):
    command = ["run", "mesh/scenario.yaml", "--out", "out", "--threads", "1", "--set",
               f"occluders=[{{shape: mesh, class: crate, mesh: {{mesh}}/{names[0]}, size: [1, 1, 1], position: [3, 1]}}]"]
    return Kind(["mesh"], [f"mesh/{name}" for name in names], command)


def kinds_of(base):
    scenario = ["run", "scenario/scenario.yaml", "--out", "out", "--threads", "1"]

    def below(folder, *patterns):
        return [file.relative_to(base).as_posix() for pattern in patterns
                for file in sorted((base / folder).glob(pattern)) if file.is_file()]

    euroc = below("data/euroc", "**/*.csv", "**/*.yaml", "mav0/cam0/data/*.png")
    kitti = below("data/kitti", "*.txt", "*.yaml", "image_0/*.png", "image_1/000000.png")
    lists = ["data/dataset.yaml"] * 3 + ["data/files.xxh128", "data/frames.csv", "data/calibration.yaml",
                                         "data/scenario.resolved.yaml"] * 2
    lists += below("data", "*.yaml", "*.csv", "*.json", "instances/*.json", "coco/*.json", "coco/panoptic/*.png",
                   "depth/**/*.png", "flow/**/000000.png", "semantic/**/000000.png", "instances/**/*.png")
    replay = ["--out", "out", "--threads", "1"]
    return {
        "scenario": Kind(["scenario"], ["scenario/scenario.yaml"], scenario),
        "world": Kind(["scenario"], ["scenario/world.yaml"], scenario),
        "rover": Kind(["scenario"], ["scenario/rover.yaml", "scenario/rover.xml", "scenario/rover.xml"], scenario),
        "rig": Kind(["scenario"], ["scenario/rig.yaml"], scenario),
        "obj": mesh_kind("mesh.obj", "mesh.mtl", "mesh.mtl", "mesh.png"),
        "dae": mesh_kind("mesh.dae"),
        "stl": mesh_kind("mesh.stl"),
        "binary stl": mesh_kind("binary.stl"),
        "gltf": mesh_kind("mesh.gltf", "mesh.gltf", "mesh.png"),
        "euroc": Kind(["data"], euroc, ["replay", "data/euroc"] + replay),
        "kitti": Kind(["data"], kitti, ["replay", "data/kitti"] + replay),
        "mcap": Kind(["data"], below("data/mcap", "*"), ["replay", "data/mcap"] + replay),
        "plain mcap": Kind(["bags"], ["bags/plain.mcap"], ["replay", "bags/plain.mcap"] + replay),
        "db3": Kind(["bags"], ["bags/small.db3"], ["replay", "bags/small.db3"] + replay),
        "map": Kind(["data", "map"], ["map/row.map"], ["replay", "data", "--load-map", "map/row.map"] + replay),
        "data set": Kind(["data"], lists, ["check", "data"]),
        "resume": Kind(["resumed"], below("resumed", "seed_000001/*.yaml", "seed_000001/coco/*.json"),
                       [word.replace("{base}", str(base)) for word in RECORD_TWO] + ["--resume"]),
        "tum": Kind(["run"], ["run/estimate.tum", "run/groundtruth.tum"],
                    ["eval", "run/groundtruth.tum", "run/estimate.tum"]),
        "metrics": Kind(["run"], ["run/metrics.json"], ["compare", "run", "run", "--json", "compared.json"]),
    }


def check_whole(base, kinds, program):
    """Undamaged, each of these kinds runs."""
    for kind in kinds:
        folder = base.parent / "whole"
        for part in kind.folders:
            link_tree(base / part, folder / part)
        run_checked([program, *arguments_of(kind, folder)], folder)
        shutil.rmtree(folder)


def arguments_of(kind, folder):
    return [word.replace("{mesh}", str(folder / "mesh")) for word in kind.command]


def link_tree(source, target):
    """Hard links: the damaged file is written anew."""
    shutil.copytree(source, target, copy_function=os.link)


# --- one case ------------------------------------------------------------------------------------


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR_SECONDS, PROCESSOR_SECONDS + 5))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_FSIZE, (LARGEST_OUTPUT, LARGEST_OUTPUT))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run_limited(command, folder):
    """(outcome, standard error)"""
    with open(folder / "stderr.txt", "wb") as errors:
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=errors, stderr=errors,
                                   preexec_fn=limit, start_new_session=True)
        try:
            code = process.wait(SECONDS)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            code = None
    text = (folder / "stderr.txt").read_bytes()[-4000:].decode("utf-8", "replace")
    if code is None or code == -signal.SIGXCPU:
        return "hang", text
    if code < 0:
        return "signal", f"signal {-code}\n{text}"
    if code == 2 and "not enough memory" in text:
        return "memory", text
    return (str(code) if str(code) in OUTCOMES else "other code"), text


def remove(folder):
    shutil.rmtree(folder, ignore_errors=True)


def run_case(job):
    base, program, name, kind, seed, number, keep, cache = job
    rng = random.Random(f"{seed} {number}")
    folder = base.parent / f"case-{number}"
    for part in kind.folders:
        link_tree(base / part, folder / part)
    damaged = rng.choice(kind.files)
    how = damage_file(folder / damaged, rng)
    arguments = arguments_of(kind, folder)
    os.environ["VINEBENCH_CACHE"] = str(cache)
    outcome, text = run_limited([program, *arguments], folder)
    line = f"{number} {name}: {damaged}: {how}: {outcome}"
    if outcome in OFFENCES or (keep and outcome == "memory"):
        kept = pathlib.Path(keep) / f"case-{number}"
        remove(kept)
        kept.mkdir(parents=True)
        target = kept / pathlib.Path(damaged).name
        source = folder / damaged
        if source.is_file() and not source.is_symlink() and source.stat().st_size < 1 << 28:
            shutil.copy(source, target)
        (kept / "case.txt").write_text(f"{line}\n{' '.join(arguments)}\n{text}\n")
    remove(folder)
    return name, outcome, line, text


def format_counts(counts):
    names = list(counts)
    total = collections.Counter()
    rows = [["inputs", "cases", *OUTCOMES]]
    for name in names:
        rows.append([name, sum(counts[name].values()), *(counts[name][o] for o in OUTCOMES)])
        total.update(counts[name])
    rows.append(["all", sum(total.values()), *(total[o] for o in OUTCOMES)])
    lines = ["| " + " | ".join(map(str, row)) + " |" for row in rows]
    lines.insert(1, "|---" + "|--:" * (len(rows[0]) - 1) + "|")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="VINEBENCH", type=pathlib.Path)
    parser.add_argument("root", metavar="ROOT", type=pathlib.Path)
    parser.add_argument("--cases", type=int, default=2000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--keep", default="mutations", help="folder for the inputs of offences")
    parser.add_argument("--only", help="one kind of inputs")
    options = parser.parse_args()
    options.keep = os.path.abspath(options.keep)
    program, root = str(options.program.resolve()), options.root.resolve()

    with tempfile.TemporaryDirectory(prefix="vinebench-mutate-") as scratch:
        base = pathlib.Path(scratch) / "base"
        base.mkdir()
        cache = pathlib.Path(scratch) / "cache"
        os.environ["VINEBENCH_CACHE"] = str(cache)
        make_base(base, root, program)
        kinds = kinds_of(base)
        if options.only:
            kinds = {options.only: kinds[options.only]}
        names = list(kinds)
        jobs = [(base, program, names[n % len(names)], kinds[names[n % len(names)]], options.seed, n, options.keep,
                 cache) for n in range(options.first, options.first + options.cases)]
        check_whole(base, [kinds[name] for name in dict.fromkeys(job[2] for job in jobs)], program)
        counts = {name: collections.Counter() for name in names}
        offences = 0
        with multiprocessing.Pool(options.jobs) as pool:
            for done, (name, outcome, line, text) in enumerate(pool.imap_unordered(run_case, jobs), 1):
                counts[name][outcome] += 1
                if outcome in OFFENCES:
                    offences += 1
                    print(f"{line}\n    " + text.strip().replace("\n", "\n    ")[-600:], flush=True)
                if done % 200 == 0:
                    print(f"{done} of {len(jobs)} cases", file=sys.stderr, flush=True)
    print(format_counts(counts))
    if offences:
        print(f"{offences} offences; their inputs are in {options.keep}")
    return 1 if offences else 0


if __name__ == "__main__":
    sys.exit(main())

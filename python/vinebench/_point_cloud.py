# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Point clouds as PLY files (docs/maps.md)."""
from __future__ import annotations

import dataclasses
import pathlib
from typing import Optional

import numpy as np
import numpy.typing as npt

from vinebench._load import core

_TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4",
          "float": "f4", "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2",
          "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8"}
_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">", "ascii": "="}


@dataclasses.dataclass(frozen=True, eq=False)
class PointCloud:
    """Points, m, and their colours if they have any."""

    points: npt.NDArray[np.float64]
    colours: Optional[npt.NDArray[np.uint8]]


def _header(lines: list[str]) -> tuple[str, int, list[tuple[str, str]]]:
    """Byte order, number and fields of the vertices, which come first."""
    order, count, fields, element = "", -1, [], ""
    for line in lines:
        words = line.split()
        if words[:1] == ["format"]:
            order = _ORDERS[words[1]]
        elif words[:1] == ["element"]:
            if words[1] != "vertex" and count < 0:
                raise ValueError("the first element is not vertex")
            element, count = words[1], int(words[2]) if words[1] == "vertex" else count
        elif words[:1] == ["property"] and element == "vertex":
            fields.append((words[2], _TYPES[words[1]]))
    if not order or count < 0 or not {"x", "y", "z"} <= {name for name, _ in fields}:
        raise ValueError("expected a format and vertices with x, y, z")
    return order, count, fields


def _vertices(content: bytes) -> npt.NDArray[np.void]:
    head, end, body = content.partition(b"end_header\n")
    lines = head.decode("ascii").splitlines()
    if not end or lines[:1] != ["ply"]:
        raise ValueError("expected a header that begins with ply and ends with end_header")
    order, count, fields = _header(lines[1:])
    dtype = np.dtype([(name, order + kind) for name, kind in fields])
    if order == "=":
        rows = [tuple(line.split()) for line in body.decode("ascii").splitlines()[:count]]
        vertices = np.array(rows, dtype)
    else:
        vertices = np.frombuffer(body, dtype, count)
    if len(vertices) != count:
        raise ValueError(f"expected {count} vertices, found {len(vertices)}")
    return vertices


def read_cloud(file: pathlib.Path) -> PointCloud:
    """Raises Error for a file that is no cloud."""
    try:
        vertices = _vertices(file.read_bytes())
    except OSError as error:
        raise core.Error(f"{file}: {error.strerror}") from error
    except (ValueError, KeyError, IndexError, TypeError, OverflowError) as error:
        raise core.Error(f"{file}: not a point cloud in PLY format ({error})") from error
    points = np.stack([vertices[axis].astype(np.float64) for axis in "xyz"], axis=1)
    channels = ("red", "green", "blue")
    names = vertices.dtype.names or ()
    if not set(channels) <= set(names):
        return PointCloud(points, None)
    return PointCloud(points, np.stack([vertices[c].astype(np.uint8) for c in channels], axis=1))

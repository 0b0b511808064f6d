# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The compiled part; its public names are those of vinebench itself."""
from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Iterator, Optional, TypedDict, Union

import numpy as np
import numpy.typing as npt

_Array = npt.NDArray[np.float64]
_Image = npt.NDArray[np.uint8]
_Path = Union[str, os.PathLike[str]]
_Settings = Mapping[str, Any]

__version__: str
label_names: dict[int, str]

class Error(RuntimeError):
    """Bad input or a failing environment: what is wrong, where, and what was expected."""

class Camera:
    """A camera of the rig: an ideal pinhole, or one with OpenCV's plumb_bob distortion."""

    @property
    def name(self) -> str: ...
    @property
    def width(self) -> int:
        """px"""
    @property
    def height(self) -> int:
        """px"""
    @property
    def K(self) -> _Array:
        """(3, 3), px; pixel (0, 0) is the centre of the top left pixel."""
    @property
    def lens(self) -> str: ...
    @property
    def distortion(self) -> list[float]:
        """k1, k2, p1, p2"""
    @property
    def T_body_camera(self) -> _Array:
        """(4, 4), m: camera (x right, y down, z ahead) to body (x forward, y left, z up)."""

class Rig:
    """Rigidly mounted cameras that are exposed at the same instant."""

    @staticmethod
    def load(file: _Path) -> Rig:
        """Reads a rig's YAML file."""
    @property
    def name(self) -> str: ...
    @property
    def rate_hz(self) -> float:
        """Frames a second."""
    @property
    def cameras(self) -> list[Camera]: ...
    @property
    def stereo_pairs(self) -> list[tuple[str, str]]:
        """Names of the left and the right camera of each pair."""
    @property
    def tag_cameras(self) -> list[str]:
        """Names of the cameras in which AprilTags are detected."""

class _Readings:
    @property
    def index(self) -> int:
        """In the run."""
    @property
    def stamp(self) -> int:
        """ns from the scenario's start, as stamped by the cameras."""
    @property
    def time(self) -> float:
        """The same in s."""
    @property
    def images(self) -> dict[str, _Image]:
        """By camera, (h, w, 3) RGB, or (h, w) of a grey camera; none where none was delivered."""
    @property
    def image_stamps(self) -> list[int]:
        """ns, of each camera's image: the frame's where they have no stamps of their own."""
    @property
    def imu(self) -> _Array:
        """(n, 7) since the previous frame: s, rad/s x y z, m/s^2 x y z, body axes."""
    @property
    def wheels(self) -> _Array:
        """(n, 9) since the previous frame: s, rad of front left, front right, rear left, rear
        right, then rad/s of them."""

class SensorFrame(_Readings):
    """What a SLAM system is given of one instant, and no truth."""

    def __init__(self, stamp: int, images: Mapping[str, Optional[_Image]], *,
                 imu: Optional[npt.NDArray[Any]] = None,
                 wheels: Optional[npt.NDArray[Any]] = None, index: int = 0,
                 image_stamps: Mapping[str, int] = {}) -> None:
        """stamp in ns; images by camera name, uint8 (h, w) grey or (h, w, 3) RGB, None where a
        camera delivered none; imu (n, 7) and wheels (n, 9) since the previous frame. All is
        copied. image_stamps: ns by camera name, of images that were not taken at the stamp."""

class Thing(TypedDict):
    """A labelled object of an image."""

    category: str
    number: int
    box: tuple[int, int, int, int]
    mask: npt.NDArray[np.bool_]
    visibility: Optional[float]
    truncation: Optional[float]

class Frame(_Readings):
    """One instant: images and truth, each by camera name."""

    @property
    def number(self) -> int:
        """Among the requested frames, from 0."""
    @property
    def T_world_body(self) -> _Array:
        """(4, 4), m: the true pose."""
    @property
    def depth(self) -> dict[str, npt.NDArray[np.float32]]:
        """(h, w), m along the optical axis; 0 for sky."""
    @property
    def labels(self) -> dict[str, _Image]:
        """(h, w), keys of label_names."""
    @property
    def instances(self) -> dict[str, npt.NDArray[np.int32]]:
        """(h, w): 256 times the object's number, plus a vine's bunch in the low byte."""
    @property
    def normals(self) -> dict[str, npt.NDArray[np.float32]]:
        """(h, w, 3), unit, camera axes, towards the camera."""
    @property
    def sensors(self) -> SensorFrame:
        """The same instant without truth, as a SLAM system is given it."""
    def things(self, camera: str) -> list[Thing]:
        """The labelled objects of an image; requires truth "things"."""
    def flow_to(self, next: Frame, camera: str) -> tuple[npt.NDArray[np.float32], _Image]:
        """Where each pixel's point is in the next frame, (h, w, 2) px, NaN where undefined; and
        (h, w), 255 where it is visible there. Requires truth "flow"."""

class Scenario:
    """The frames of a simulated scenario, in order, computed on demand. Iterated once."""

    def __init__(self, scenario: _Path, *, seed: Optional[int] = None, set: _Settings = ...,
                 randomise: Optional[_Path] = None, cameras: Sequence[str] = ...,
                 truth: Sequence[str] = ..., frames: Optional[tuple[int, int]] = None,
                 every: int = 1, threads: int = 2) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def seed(self) -> int: ...
    @property
    def cameras(self) -> list[Camera]:
        """Nominal, as given to a SLAM system."""
    @property
    def true_cameras(self) -> list[Camera]:
        """True, consistent with the truth images."""
    @property
    def rig(self) -> Rig:
        """Nominal, as given to a SLAM system."""
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[Frame]: ...
    def __next__(self) -> Frame: ...

class Drive:
    """A scenario whose rover is driven by body twists."""

    def __init__(self, scenario: _Path, *, seed: Optional[int] = None, set: _Settings = ...,
                 randomise: Optional[_Path] = None, cameras: Sequence[str] = ...,
                 truth: Sequence[str] = ..., threads: int = 2) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def seed(self) -> int: ...
    @property
    def rig(self) -> Rig: ...
    @property
    def true_cameras(self) -> list[Camera]: ...
    @property
    def route(self) -> _Array: ...
    @property
    def last_number(self) -> Optional[int]: ...
    @property
    def collided(self) -> bool: ...
    def reset(self, seed: Optional[int] = None,
              start: Optional[tuple[float, ...]] = None) -> Frame: ...
    def step(self, twist: tuple[float, float, float]) -> Optional[Frame]: ...

class Slam:
    """The built-in SLAM core, frame by frame."""

    @staticmethod
    def of_rig(rig: Rig, settings: _Settings, threads: int) -> Slam: ...
    @staticmethod
    def of_scenario(scenario: Scenario, settings: _Settings, threads: int) -> Slam: ...
    @staticmethod
    def of_drive(drive: Drive, settings: _Settings, threads: int) -> Slam: ...
    @property
    def rig(self) -> Rig: ...
    def process(self, frame: Union[Frame, SensorFrame]) -> dict[str, Any]: ...
    def finish(self) -> dict[str, Any]: ...
    def load_map(self, file: _Path) -> None: ...
    def save_map(self, file: _Path) -> None: ...
    def save_cloud(self, file: _Path) -> None: ...

class RosMessages:
    """The messages of ROS 2 of a scenario's frames, as in its bag: (topic, time in ns, CDR)."""

    start: int
    """ns that times are ahead of stamps."""
    def __init__(self, scenario: _Path, *, seed: Optional[int], set: _Settings,
                 randomise: Optional[_Path], colour: bool, images: str, tags: bool) -> None: ...
    @property
    def rig(self) -> Rig: ...
    @property
    def topics(self) -> list[tuple[str, str, bool]]:
        """Topic, type, whether it is latched; those of the truth too."""
    def of_frame(self, frame: SensorFrame) -> list[tuple[str, int, bytes]]:
        """In order of time; without truth."""
    def of_truth(self, stamp: int, T_world_body: _Array) -> list[tuple[str, int, bytes]]: ...

def run(scenario: _Path, *, seed: Optional[int], set: _Settings, randomise: Optional[_Path],
        out: Optional[_Path], threads: int, progress: bool, adapter: Any,
        on_truth: Optional[Callable[[int, _Array], None]]) -> dict[str, Any]: ...
def evaluate(truth: Union[_Array, _Path], estimate: Union[_Array, _Path]) -> dict[str, Any]: ...
def read_tum(file: _Path) -> _Array: ...
def write_tum(file: _Path, trajectory: npt.NDArray[Any]) -> None: ...
def scenario_names() -> list[str]: ...
def scenario_file(text: _Path) -> str: ...
def rig_file(text: _Path) -> str: ...
def pin_arithmetic(libraries: bool) -> None: ...
def arithmetic() -> list[tuple[str, str]]: ...

# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Several simulations side by side, each in a process of its own."""
from __future__ import annotations

import contextlib
import multiprocessing
import multiprocessing.connection
import multiprocessing.shared_memory
import signal
from collections.abc import Mapping, Sequence
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from vinebench._load import core
from vinebench.simulation import Image, Observation, Simulation
from vinebench.trajectories import Array, PathLike

_WAIT = 600.0  # s, for a worker's answer: a large vineyard takes a while to grow


class _Pictures:
    """Images of all simulations by camera, (n, h, w, 3), in memory that processes share."""

    def __init__(self, shapes: Mapping[str, tuple[int, int, int]], count: int,
                 names: Optional[Mapping[str, str]] = None) -> None:
        self.arrays: dict[str, Image] = {}
        self._blocks: list[multiprocessing.shared_memory.SharedMemory] = []
        self._own = names is None
        self.names: dict[str, str] = {}
        for camera, (height, width, channels) in shapes.items():
            shape = (count, height, width, channels)
            if names is None:
                block = multiprocessing.shared_memory.SharedMemory(
                    create=True, size=int(np.prod(shape)))
            else:
                block = multiprocessing.shared_memory.SharedMemory(name=names[camera])
            self._blocks.append(block)
            self.names[camera] = block.name
            self.arrays[camera] = np.ndarray(shape, np.uint8, buffer=block.buf)

    def close(self) -> None:
        self.arrays.clear()
        for block in self._blocks:
            block.close()
            if self._own:
                block.unlink()
        self._blocks.clear()


def _work(connection: multiprocessing.connection.Connection, index: int, count: int,
          arguments: dict[str, Any]) -> None:
    """A worker: answers ("ok", result) or ("error", type's name, text) to each message."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent ends it
    pictures: Optional[_Pictures] = None
    simulation: Optional[Simulation] = None
    while True:
        try:
            message, given = connection.recv()
        except EOFError:
            break
        try:
            if message == "open":
                simulation = Simulation(**arguments)
                connection.send(("ok", simulation.image_shapes))
                continue
            assert simulation is not None
            if message == "share":
                pictures = _Pictures(simulation.image_shapes, count, given)
                connection.send(("ok", None))
                continue
            answer = simulation.reset(**given) if message == "reset" else simulation.step(given)
            assert pictures is not None
            connection.send(("ok", _packed(answer, pictures, index)))
        except Exception as error:
            connection.send(("error", type(error).__name__, str(error)))
    if pictures is not None:
        pictures.close()


def _packed(answer: Sequence[Any], pictures: _Pictures, index: int) -> tuple[Any, ...]:
    """The answer with its images put into shared memory."""
    observation: Observation = answer[0]
    for camera, image in observation["images"].items():
        pictures.arrays[camera][index] = image
    return ({"imu": observation["imu"], "wheels": observation["wheels"]}, *answer[1:])


class VectorSimulation:
    """`n` simulations of a scenario, each in a process, that are stepped at the same time.

    Observations are batched: images[camera] (n, h, w, 3), imu (n, 6), wheels (n, 4). With
    autoreset (Gymnasium's next-step mode) a simulation whose episode ended is reset in place of its
    next step, whose twist is ignored and whose reward is 0.

    Workers are started by `spawn`, since threads of the C++ part do not survive a fork: guard the
    main program with `if __name__ == "__main__":`. Use it as a context manager, or close() it.
    """

    def __init__(self, n: int, scenario: PathLike, *, autoreset: bool = True,
                 start_method: str = "spawn", threads: int = 1, **arguments: Any) -> None:
        """n: number of simulations. start_method: "spawn" or "forkserver". threads: of each.
        Other arguments are those of Simulation; a reward must be picklable."""
        if n < 1:
            raise ValueError(f"n: expected at least 1, found {n}")
        if start_method not in ("spawn", "forkserver"):
            raise ValueError(f'start_method: expected "spawn" or "forkserver", found '
                             f'"{start_method}"')
        self.n = n
        self.autoreset = autoreset
        self._ended = np.zeros(n, bool)
        self._connections: list[multiprocessing.connection.Connection] = []
        self._processes: list[Any] = []
        self._pictures: Optional[_Pictures] = None
        context: Any = multiprocessing.get_context(start_method)
        given = {"scenario": scenario, "threads": threads, **arguments}
        try:
            for i in range(n):
                here, there = context.Pipe()
                process = context.Process(target=_work, args=(there, i, n, given), daemon=True)
                process.start()
                there.close()
                self._connections.append(here)
                self._processes.append(process)
            shapes = self._ask([("open", None)] * n)[0]
            self._pictures = _Pictures(shapes, n)
            self._ask([("share", self._pictures.names)] * n)
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> "VectorSimulation":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __len__(self) -> int:
        return self.n

    def reset(self, *, seed: Union[int, Sequence[int], None] = None,
              options: Optional[Mapping[str, Any]] = None
              ) -> tuple[Observation, tuple[dict[str, Any], ...]]:
        """Begins an episode in each. seed: one for each, or the first's: the i-th has seed + i.

        Returns the batched observation and the info of each.
        """
        seeds: list[Optional[int]]
        if seed is None:
            seeds = [None] * self.n
        elif isinstance(seed, int):
            seeds = [seed + i for i in range(self.n)]
        else:
            seeds = [int(s) for s in seed]
            if len(seeds) != self.n:
                raise ValueError(f"seed: expected {self.n} seeds, found {len(seeds)}")
        answers = self._ask([("reset", {"seed": s, "options": options}) for s in seeds])
        self._ended[:] = False
        return self._batch(answers), tuple(answer[1] for answer in answers)

    def step(self, twists: npt.ArrayLike) -> tuple[
            Observation, Array, npt.NDArray[np.bool_], npt.NDArray[np.bool_],
            tuple[dict[str, Any], ...]]:
        """Drives each by its twist, (n, 3): m/s forward, m/s and rad/s to the left.

        Returns the batched observation, rewards (n,), terminated (n,), truncated (n,), infos.
        """
        commands = np.asarray(twists, dtype=np.float64)
        if commands.shape != (self.n, 3):
            raise ValueError(f"twists: expected shape ({self.n}, 3), found {commands.shape}")
        again = self._ended & self.autoreset
        answers = self._ask([("reset", {}) if again[i] else ("step", commands[i])
                             for i in range(self.n)])
        whole = [(answer[0], 0.0, False, False, answer[1]) if again[i] else answer
                 for i, answer in enumerate(answers)]
        rewards = np.array([answer[1] for answer in whole])
        terminated = np.array([answer[2] for answer in whole])
        truncated = np.array([answer[3] for answer in whole])
        self._ended = terminated | truncated
        return (self._batch(whole), rewards, terminated, truncated,
                tuple(answer[4] for answer in whole))

    def close(self) -> None:
        """Ends the workers; may be called again."""
        for connection in self._connections:
            with contextlib.suppress(OSError):
                connection.close()
        for process in self._processes:
            process.join(timeout=5)
            if process.is_alive():
                process.terminate()
                process.join()
        self._connections.clear()
        self._processes.clear()
        if self._pictures is not None:
            self._pictures.close()
            self._pictures = None

    def __del__(self) -> None:
        if hasattr(self, "_processes"):
            self.close()

    def _ask(self, messages: Sequence[tuple[str, Any]]) -> list[Any]:
        """Sends each worker its message and collects all answers before an error is raised."""
        if len(self._connections) != self.n:
            raise core.Error("the simulations are closed")
        try:
            for connection, message in zip(self._connections, messages):
                connection.send(message)
            answers = [self._answer(i) for i in range(self.n)]
        except KeyboardInterrupt:  # answers are left that belong to no message
            self.close()
            raise
        for i, answer in enumerate(answers):
            if answer[0] != "ok":
                kind = {"ValueError": ValueError, "TypeError": TypeError}.get(answer[1], core.Error)
                raise kind(f"simulation {i}: {answer[2]}")
        return [answer[1] for answer in answers]

    def _answer(self, index: int) -> Any:
        connection = self._connections[index]
        try:
            if connection.poll(_WAIT):
                return connection.recv()
        except (EOFError, OSError):
            pass
        process = self._processes[index]
        process.join(timeout=1)
        state = "does not answer" if process.is_alive() else f"ended: exit code {process.exitcode}"
        raise core.Error(f"simulation {index}: its process {state}")

    def _batch(self, answers: Sequence[Any]) -> Observation:
        assert self._pictures is not None
        return Observation(
            images={camera: array.copy() for camera, array in self._pictures.arrays.items()},
            imu=np.stack([answer[0]["imu"] for answer in answers]),
            wheels=np.stack([answer[0]["wheels"] for answer in answers]))

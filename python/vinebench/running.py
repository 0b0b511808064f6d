# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Runs a scenario and judges it."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Callable, Mapping
from typing import Any, Optional

from vinebench._adapter import SystemAdapter, SlamSystem
from vinebench._load import core
from vinebench.results import Report, report_of
from vinebench.trajectories import Array, PathLike


def run(scenario: PathLike, *, seed: Optional[int] = None, set: Optional[Mapping[str, Any]] = None,
        randomise: Optional[PathLike] = None, out: Optional[PathLike] = None,
        threads: Optional[int] = None, slam: Optional[SlamSystem] = None,
        progress: bool = False,
        on_truth: Optional[Callable[[int, Array], None]] = None) -> Report:
    """Runs a scenario in lockstep and judges it, as `vinebench run` does.

    scenario: a scenario's file, or its name, such as "occluded-camera".
    seed: overrides the scenario's.
    set: overrides keys of the scenario, {"world.sun.elevation_deg": 20}.
    randomise: a file of distributions for keys, or its name, drawn by seed.
    out: a folder for the results; nothing is written without.
    threads: number of worker threads, all processors' by default; changes no result.
    slam: a system in place of the scenario's, an object with `process(frame)` (SlamSystem). It is
        judged as the built-in core is, but for the guard, which was measured with that. What it
        raises is a failure of the run (Report.failure), not of this call.
    progress: tells the progress on standard error.
    on_truth: called with the stamp (ns) and the true pose T_world_body (4, 4) of each frame, once
        the system has answered it; for displays.

    Raises vinebench.Error for bad input. ^C ends the run after its frame with KeyboardInterrupt.
    """
    adapter = None if slam is None else SystemAdapter(slam)
    outcome = core.run(os.fspath(scenario), seed=seed, set=dict(set or {}),
                       randomise=None if randomise is None else os.fspath(randomise),
                       out=None if out is None else os.fspath(out),
                       threads=threads or os.cpu_count() or 1, progress=progress, adapter=adapter,
                       on_truth=on_truth)
    return report_of(outcome, None if out is None else pathlib.Path(out),
                     None if adapter is None else adapter.exception)

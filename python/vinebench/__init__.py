# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Vinebench: a deterministic test bench for multicamera visual SLAM in vineyards.

    import vinebench as vb

    report = vb.run("occluded-camera", seed=3)               # run and judge a scenario
    report = vb.run("quick-loop", slam=MySystem())           # the same with a system of your own
    for frame in vb.Scenario("quick-loop"): ...              # its frames, with truth
    estimate = vb.Slam(scenario).process(frame)              # the built-in core, frame by frame
    evaluation = vb.evaluate("truth.tum", "estimate.tum")    # errors of a trajectory
    simulation = vb.Simulation("quick-loop")                 # a rover that you drive

T_a_b takes coordinates in b to coordinates in a: (4, 4), m. world: x east, y north, z up; map: the
estimator's own world; body: x forward, y left, z up; camera: x right, y down, z ahead. SI units;
stamps are integer nanoseconds.
"""
from vinebench._load import core as _core  # first: it decides how libraries compute
from vinebench._adapter import RegisteredTag, SlamSystem, SystemFailed, SystemSetup, Wheels
from vinebench._core import (Camera, Error, Frame, Rig, Scenario, SensorFrame, __version__,
                             label_names)
from vinebench.evaluation import ErrorStatistics, Evaluation, evaluate
from vinebench.results import (Blind, Check, DegradedSegment, Failure, LoopClosures, Metrics, Report,
                               Trajectories)
from vinebench.running import run
from vinebench.simulation import Observation, Simulation, progress_reward
from vinebench.slam import (CameraCounts, Estimate, LoopClosure, Slam, SlamSummary, TagSighting,
                            TrackingStatus)
from vinebench.trajectories import read_tum, to_matrices, write_tum
from vinebench.vector import VectorSimulation


def scenario_names() -> list[str]:
    """The names of the scenarios that come with the program, for run(), Scenario, Simulation."""
    return _core.scenario_names()


def arithmetic() -> dict[str, str]:
    """What computes in this process: whose elementary functions, which code of OpenCV, how shaders
    multiply and add, which BLAS. Two processes with the same values compute the same bytes."""
    return dict(_core.arithmetic())


__all__ = [
    "Blind", "Camera", "CameraCounts", "Check", "DegradedSegment", "Error", "ErrorStatistics",
    "Estimate", "Evaluation", "Failure", "Frame", "LoopClosure", "LoopClosures", "Metrics",
    "Observation", "RegisteredTag", "Report", "Rig", "Scenario", "SensorFrame", "Simulation", "Slam",
    "SlamSummary", "SlamSystem", "SystemFailed", "SystemSetup", "TagSighting", "TrackingStatus",
    "Trajectories", "VectorSimulation", "Wheels", "__version__", "arithmetic", "evaluate", "label_names",
    "progress_reward", "read_tum", "run", "scenario_names", "to_matrices", "write_tum",
]

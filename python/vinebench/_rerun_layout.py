# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""How the viewer of Rerun lays a recording out."""
from __future__ import annotations

import importlib
from collections.abc import Sequence
from typing import Any

PLOTS = (("plots/error_mm", "Position error, mm"), ("plots/inliers", "Inliers"),
         ("plots/status", "Status"), ("plots/sigma_mm", "Standard deviation, mm"),
         ("plots/drift_percent", "Drift, %"), ("plots/features", "Features"),
         ("plots/occluded", "Occluded"), ("imu", "Inertial unit"))
"""Entities of plots, and their titles."""


def layout(cameras: Sequence[tuple[str, str]], plots: Sequence[str]) -> Any:
    """3D view and events at the left; cameras (name, entity) and plots (entities) at the right."""
    views = importlib.import_module("rerun.blueprint")
    left = views.Vertical(
        views.Spatial3DView(origin="/world", name="Vineyard",
                            contents=["$origin/**", "- $origin/map/far_landmarks"]),
        views.Tabs(views.TextLogView(origin="/events", name="Events"),
                   views.TextDocumentView(origin="/summary", name="Run")), row_shares=[3, 1])
    curves = [views.TimeSeriesView(origin=f"/{entity}", name=title) for entity, title in PLOTS
              if entity in plots]
    images = [views.Spatial2DView(origin=entity, name=name,
                                  contents=["$origin/**", "/world/tags"])
              for name, entity in cameras]
    right = [views.Grid(*images, grid_columns=min(3, len(images)))] if images else []
    if len(curves) > 3:  # two in view, the others behind the third
        curves = [*curves[:2], views.Tabs(*curves[2:])]
    right += [views.Vertical(*curves)] if curves else []
    return views.Blueprint(views.Horizontal(left, *([views.Vertical(*right)] if right else []),
                                            column_shares=[1, 1] if right else [1]))

# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""How the viewer of Rerun lays a recording out."""
from __future__ import annotations

import importlib
from collections.abc import Sequence
from typing import Any

PLOTS = (("plots/error_mm", "Position error, mm"), ("plots/sigma_mm", "Standard deviation, mm"),
         ("plots/drift_percent", "Drift, %"), ("plots/inliers", "Inliers"),
         ("plots/features", "Features"), ("plots/occluded", "Occluded"), ("plots/status", "Status"),
         ("imu", "Inertial unit"))
"""Entities of plots, and their titles."""


def layout(cameras: Sequence[tuple[str, str]], plots: Sequence[str]) -> Any:
    """3D view and events at the left; cameras (name, entity) and plots (entities) at the right."""
    views = importlib.import_module("rerun.blueprint")
    left = views.Vertical(
        views.Spatial3DView(origin="/world", name="Vineyard"),
        views.Tabs(views.TextLogView(origin="/events", name="Events"),
                   views.TextDocumentView(origin="/summary", name="Run")), row_shares=[3, 1])
    curves = [views.TimeSeriesView(origin=f"/{entity}", name=title) for entity, title in PLOTS
              if entity in plots]
    images = [views.Spatial2DView(origin=entity, name=name,
                                  contents=["$origin/**", "/world/tags"])
              for name, entity in cameras]
    # The first three plots in view, the others behind them.
    right = [views.Grid(*images, grid_columns=2)] if images else []
    if curves:
        right.append(views.Vertical(*curves[:2], views.Tabs(*curves[2:])) if len(curves) > 2
                     else views.Vertical(*curves))
    return views.Blueprint(views.Horizontal(left, *([views.Vertical(*right)] if right else []),
                                            column_shares=[1, 1] if right else [1]))

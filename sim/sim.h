// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The simulation of the test bench: vineyard, rover physics, renderer, sensors and ground truth.
/// Independent of SLAM; its output is core's Frame, and Truth for the evaluation.

#include "sim/render/factory/make_render_engine.h"
#include "sim/rover/route.h"
#include "sim/rover/rover.h"
#include "sim/scene/scene.h"
#include "sim/simulation.h"
#include "sim/world/world.h"

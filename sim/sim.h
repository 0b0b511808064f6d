// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The simulated half of the test bench: vineyard, rover physics, renderer, sensors and the truth.
/// It knows nothing of SLAM; what it hands over is core's Frame, and Truth for the judge.

#include "sim/render/renderer.h"
#include "sim/rover/route.h"
#include "sim/rover/rover.h"
#include "sim/scene/scene.h"
#include "sim/simulation.h"
#include "sim/world/world.h"

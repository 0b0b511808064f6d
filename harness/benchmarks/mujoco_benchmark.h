// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "harness/benchmarks/render_case.h"

namespace vinebench::harness {

/// MuJoCo's own renderer on the same scene and poses, with the same software rasteriser: medians of
/// `cpu_ms` and `wall_ms` for the first camera of each size. MuJoCo has no levels of detail, so
/// there are two variants of `meshes`: "finest" everywhere, and "at 2 m", the level that our
/// renderer uses at 2 m from that camera, everywhere; and one with shadows, which MuJoCo renders
/// again for each image. Neither of the first two equals our image: "finest" has more triangles
/// than needed; the cards of "at 2 m" are opaque, because MuJoCo's textures have no alpha channel.
nlohmann::ordered_json measure_mujoco(const RenderBenchmark& benchmark);

/// Adds `throughput_ratio` to each of MuJoCo's images: its CPU time divided by ours, from `cameras`
/// of measure_rendering().
void compare_with_mujoco(nlohmann::ordered_json& mujoco, const nlohmann::ordered_json& cameras);

}  // namespace vinebench::harness

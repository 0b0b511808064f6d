// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/benchmarks/render_benchmark.h"

namespace vinebench::harness {

/// MuJoCo's own renderer on the same scene from the same places, on the same software rasteriser:
/// medians of `cpu_ms` and `wall_ms` for the first camera of each size. MuJoCo knows no levels of
/// detail, so there are two variants of `meshes`: "finest" everywhere, and "at 2 m", the level that
/// our renderer draws at 2 m from that camera, everywhere; and one with shadows, which our images
/// have and MuJoCo draws anew for each image. Neither of the first two is quite our image:
/// "finest" draws more triangles than needed; the cards of "at 2 m" come out opaque, without a
/// leaf's outline, for MuJoCo's textures have no alpha.
nlohmann::ordered_json measure_mujoco(const RenderBenchmark& benchmark);

/// Adds `throughput_ratio` to each of MuJoCo's images: its CPU time by that of ours, from
/// `cameras` as measure_rendering() gives them.
void compare_with_mujoco(nlohmann::ordered_json& mujoco, const nlohmann::ordered_json& cameras);

}  // namespace vinebench::harness

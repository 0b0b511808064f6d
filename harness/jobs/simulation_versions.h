// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/util/arithmetic.h"
#include "sim/render/renderer_config.h"

namespace vinebench::harness {

/// Names and versions of the libraries that simulate and draw. Starts OpenGL on the platform of
/// that name (as choose_backend()).
NamedValues simulation_versions(const std::string& platform);

/// The libraries that make a scenario's frames, for the environment of its hash. Starts OpenGL if
/// it draws with it.
NamedValues drawing_libraries(const sim::RendererConfig& renderer);

}  // namespace vinebench::harness

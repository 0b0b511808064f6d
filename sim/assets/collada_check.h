// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace vinebench::sim {

/// Throws Error that names `file` for the text of a .dae that assimp would not come back from:
/// elements nested so deep that they exhaust the stack, nodes that contain themselves or unfold to
/// more than 100 000, lists said to be longer than the text.
void check_collada(std::string_view text, const std::string& file);

}  // namespace vinebench::sim

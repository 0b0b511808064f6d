// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace vinebench::sim {

/// Throws Error that names `file` for the text of a .dae that would make assimp crash or hang:
/// elements nested deeply enough to exhaust the stack, nodes that contain themselves or expand to
/// more than 100 000, lists with a stated length beyond that of the text, accessors beyond the end
/// of their list.
void check_collada(std::string_view text, const std::string& file);

}  // namespace vinebench::sim

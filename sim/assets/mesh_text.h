// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/assets/imported_mesh.h"

namespace vinebench::sim {

/// The up axis that the text of a .dae states; y, by the standard, where it states none.
UpAxis collada_up_axis(std::string_view text);

/// The material libraries that the text of an .obj names and `folder` does not have.
std::vector<std::string> missing_material_libraries(std::string_view text,
                                                    const std::filesystem::path& folder);

}  // namespace vinebench::sim

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "core/time.h"

namespace vinebench::harness {

/// Stamps of KITTI's raw data, a line each ("2011-09-26 13:02:25.964389445"), ns since 1970 by that
/// clock, whose time zone the data do not tell. Throws Error with file and line.
std::vector<Stamp> read_kitti_stamps(const std::filesystem::path& file);

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// The list of all formats, in the order of data sets.
const std::vector<DatasetFormat>& dataset_formats();

/// The format of that name. Throws Error for an unknown name.
const DatasetFormat& format_named(const std::string& name);

/// Names of the formats that this build can write.
std::vector<std::string> all_formats();

/// Names of formats, each once, in the list's order; "--format" is the option that errors name.
/// Throws Error that lists the known formats.
std::vector<std::string> parse_formats(const std::vector<std::string>& names);

/// The data that the formats require of the simulation. Throws Error for a camera that the rig does
/// not have.
CapturePlan plan_of(const RecordOptions& options, const Rig& rig);

}  // namespace vinebench::harness

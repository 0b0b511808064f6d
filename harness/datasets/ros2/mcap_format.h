// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// Bags of ROS 2: written as MCAP, read as MCAP and SQLite.
DatasetFormat mcap_format();

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// What DC-VSLAM's own programs read without ROS.
DatasetFormat dcvslam_format();

}  // namespace vinebench::harness

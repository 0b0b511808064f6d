// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// A bag of ROS 1; available where the program was built with ROS's libraries.
DatasetFormat ros_format();

}  // namespace vinebench::harness

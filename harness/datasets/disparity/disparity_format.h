// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// Disparity of each rectified pair's left camera as 16-bit PNG in 1/256 px, 0 for none (KITTI's).
/// Its writer throws Error if a pair is not rectified, or there is none.
DatasetFormat disparity_format();

}  // namespace vinebench::harness

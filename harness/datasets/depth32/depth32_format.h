// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// Depth along the optical axis as NumPy files of floats, m, 0 for sky.
DatasetFormat depth32_format();

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// Surface normals as PNG: red to the right, green up, blue towards the camera, each from -1 (0)
/// to 1 (255).
DatasetFormat normals_format();

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// Flow to the next frame as KITTI's 16-bit PNG, with a mask of what that frame still shows.
DatasetFormat flow_format();

/// The same as Middlebury's .flo. Where both are asked for, flow's writer writes both, of one
/// computation.
DatasetFormat flo_format();

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// True trajectories in TUM format.
DatasetFormat tum_format();

}  // namespace vinebench::harness

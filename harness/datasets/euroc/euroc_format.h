// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// An EuRoC/ASL folder.
DatasetFormat euroc_format();

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// Labels as 8-bit PNG of Label; labels.yaml has their names and colours.
DatasetFormat semantic_format();

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// Numbers of instances as RGB PNG, with a table of what they are.
DatasetFormat instances_format();

}  // namespace vinebench::harness

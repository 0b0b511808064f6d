// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// Images as the cameras gave them: <camera>/000012.png, or JPEG or WebP.
DatasetFormat rgb_format();

}  // namespace vinebench::harness

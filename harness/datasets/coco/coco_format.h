// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

/// COCO: boxes, masks and panoptic images; for several sequences also their combined lists.
DatasetFormat coco_format();

}  // namespace vinebench::harness

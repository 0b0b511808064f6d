// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/label_images.h"

namespace vinebench::harness {

/// Holds flow against depth and the poses of its frame and the next: of things at rest, where the
/// depth's point is in the next image, within 0.1 px and what depth's steps make, at nine tenths of
/// the pixels.
void check_flow_image(LabelImages& images);

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// The image list of one camera of a recording.
struct ImageList {
  struct Entry {
    Stamp stamp = 0;
    std::filesystem::path file;
  };
  std::string camera;
  std::vector<Entry> entries;
  int out_of_order = 0;  ///< entries after a later one; sorted
  int repeated = 0;      ///< entries with a duplicate stamp; dropped
};

/// Sorts a list by time and counts its faults.
void put_in_order(ImageList& list);

/// Frames at the given ascending instants. Each takes from each list the image nearest in time, at
/// most half a frame period away, with its stamp, and each image is used at most once. Unmatched
/// images, faults of a list and gaps between the instants become events.
std::vector<RecordedFrame> associate_images(const std::vector<ImageList>& lists,
                                            const std::vector<Stamp>& instants);

std::vector<Stamp> instants_of(const ImageList& list);

/// The median time between neighbours, ns; 0 for fewer than two.
Stamp median_period(const std::vector<Stamp>& instants);

}  // namespace vinebench::harness

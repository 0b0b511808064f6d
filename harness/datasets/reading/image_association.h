// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// What one camera of a recording took, as its list has it.
struct ImageList {
  struct Entry {
    Stamp stamp = 0;
    std::filesystem::path file;
  };
  std::string camera;
  std::vector<Entry> entries;
  int out_of_order = 0;  ///< entries that stood behind a later one; put in their place
  int repeated = 0;      ///< entries with the stamp of another one, left out
};

/// Puts a list into the order of time and counts what was wrong.
void put_in_order(ImageList& list);

/// Frames at the given instants, which ascend. Each takes of each list the image nearest in time,
/// at most half a frame away, and no image twice. What finds no frame, what a list has wrong and
/// gaps between the instants become events.
std::vector<RecordedFrame> associate_images(const std::vector<ImageList>& lists,
                                            const std::vector<Stamp>& instants);

std::vector<Stamp> instants_of(const ImageList& list);

/// The median time between neighbours, ns; 0 for less than two.
Stamp median_period(const std::vector<Stamp>& instants);

}  // namespace vinebench::harness

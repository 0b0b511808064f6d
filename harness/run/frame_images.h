// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>

#include "harness/run/sink.h"

namespace vinebench::harness {

/// Writes all cameras' images of a few frames, evenly distributed over the run, as
/// frames/000123_front_left.png.
class FrameImages : public Sink {
 public:
  /// `count` frames of a run of `total`, including the first and the last.
  FrameImages(std::filesystem::path folder, const Rig& rig, std::int64_t total, int count);
  void on_tick(const Sample& sample, const Estimate& estimate) override;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> cameras_;
  std::set<std::int64_t> chosen_;
};

}  // namespace vinebench::harness

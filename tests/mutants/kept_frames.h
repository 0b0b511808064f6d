// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/truth/frame_source.h"

namespace vinebench::mutants {

/// The frames of a simulation in grey, drawn once for any number of SLAM systems.
class KeptFrames : public FrameSource {
 public:
  explicit KeptFrames(FrameSource& source);
  void rewind() { next_ = 0; }
  std::optional<Sample> next() override;
  std::int64_t size() const override { return static_cast<std::int64_t>(samples_.size()); }
  const Rig& rig() const override { return rig_; }
  const StageTimes& times() const override { return times_; }

 private:
  Rig rig_;
  std::vector<Sample> samples_;
  std::size_t next_ = 0;
  StageTimes times_;
};

}  // namespace vinebench::mutants

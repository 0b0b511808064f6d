// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>

#include "core/truth/frame_source.h"

namespace vinebench::harness {

/// Makes the next sample of a source on another thread while the one before is worked on. The
/// samples are the source's own, in its order; what it throws is thrown by the next() that would
/// have given the sample.
class Prefetch : public FrameSource {
 public:
  /// Keeps a reference to the source, which nobody else may use meanwhile.
  explicit Prefetch(FrameSource& source);

  std::optional<Sample> next() override;
  std::int64_t size() const override { return source_.size(); }
  const Rig& rig() const override { return source_.rig(); }
  /// Waits for the sample under way, whose times are among them.
  const StageTimes& times() const override;

 private:
  void begin();

  FrameSource& source_;
  std::future<std::optional<Sample>> coming_;  ///< its destructor waits
};

}  // namespace vinebench::harness

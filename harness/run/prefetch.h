// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>

#include "core/truth/frame_source.h"

namespace vinebench::harness {

/// Prefetches the next sample of a source on another thread while the previous one is processed.
/// Order and content are unchanged; an exception of the source is thrown by the next() that would
/// have returned the sample.
class Prefetch : public FrameSource {
 public:
  /// Keeps a reference to the source, which must not be used otherwise meanwhile.
  explicit Prefetch(FrameSource& source);

  std::optional<Sample> next() override;
  std::int64_t size() const override { return source_.size(); }
  const Rig& rig() const override { return source_.rig(); }
  /// Waits for the pending sample and includes its times.
  const StageTimes& times() const override;

 private:
  void begin();

  FrameSource& source_;
  std::future<std::optional<Sample>> coming_;  ///< its destructor waits
};

}  // namespace vinebench::harness

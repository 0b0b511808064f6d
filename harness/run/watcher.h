// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/truth/site.h"
#include "harness/run/film.h"
#include "harness/run/sink.h"

namespace vinebench::harness {

/// What a watcher is told before the first tick.
struct WatchedRun {
  std::string title;
  const Site& site;
  const Rig& rig;
  std::int64_t total = 0;   ///< frames
  double box_share = 0;     ///< of an image that occluders cover: it counts as occluded
  Film::Features features;  ///< that supported the latest frame; empty if the system does not tell
};

/// Someone who looks on while a run goes on, and may hold it up.
class Watcher : public Sink {
 public:
  virtual void begin(const WatchedRun& run) = 0;
  /// s, for which it has held the run up.
  virtual double waited_seconds() const { return 0; }
};

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

#include "harness/judge/trial.h"
#include "harness/run/run_record.h"

namespace vinebench::harness {

/// What the truth says of each image of a run that makes it hard to use. Ticks are indices into
/// the record, cameras into its rig. Nothing is known of an image whose truth is not: all is false,
/// shares are 0.
class ImageConditions {
 public:
  ImageConditions(const RunRecord& record, const Site& site);

  bool is_dropped(std::size_t tick, std::size_t camera) const;
  /// A point 1 m away moves by 2 px or more during the exposure.
  bool is_blurred(std::size_t tick, std::size_t camera) const;
  /// Likewise from the first row's exposure to the last's.
  bool is_rolling(std::size_t tick, std::size_t camera) const;
  /// Such a point moves by half a pixel or more between the stamp and the exposure, or between the
  /// exposures of the two cameras of a pair.
  bool is_mistimed(std::size_t tick, std::size_t camera) const;
  /// 95 % of the codes are below a quarter of the range, or half of them saturated, or the gain is
  /// 12 dB or more.
  bool is_badly_exposed(std::size_t tick, std::size_t camera) const;

  Occlusion occlusion(std::size_t tick, std::size_t camera) const;
  /// Of it, the classes of which one moves.
  Occlusion moving(std::size_t tick, std::size_t camera) const;

 private:
  double pixels_per_second(std::size_t tick, std::size_t camera) const;
  const Capture* capture(std::size_t tick, std::size_t camera) const;

  const RunRecord& record_;
  std::set<OccluderClass> movers_;
};

}  // namespace vinebench::harness

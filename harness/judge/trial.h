// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/truth/site.h"
#include "harness/judge/expectations.h"
#include "harness/judge/findings/discrepancy.h"

namespace vinebench::harness {

/// Context of a run for evaluation and report, besides its record. A recording has no site and no
/// expectations.
struct Trial {
  std::string name;
  std::int64_t seed = 0;
  Expectations expectations;
  Expectations goal;
  Expectations now;
  Expectations guard;
  Site site;
  /// That the system under test is told of, where the world's are not known: of a recording.
  std::vector<RegisteredTag> told_tags;
  std::optional<Eigen::Vector2d> route_end;  ///< m, world; end of the route, if there is one
  bool miscalibrated = false;                ///< the true rig differs from the nominal one
  std::vector<Discrepancy> discrepancies;    ///< what the system under test is told wrong

  /// The occlusion that one of the three asks for, null if none does.
  const Expectations::Blind* blind() const {
    for (const Expectations* asked : {&expectations, &goal, &guard}) {
      if (asked->blind) return &*asked->blind;
    }
    return nullptr;
  }

  /// From this share of its image on, a camera counts as occluded.
  double box_share() const {
    const Expectations::Blind* asked = blind();
    return asked != nullptr ? asked->box_share : Expectations::Blind{}.box_share;
  }
};

}  // namespace vinebench::harness

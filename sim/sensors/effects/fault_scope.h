// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "core/time.h"

namespace vinebench::sim {

/// Which cameras a fault applies_to, and when. All of them all the time by default.
struct FaultScope {
  std::vector<std::string> cameras;  ///< names of the rig; empty: every camera
  double from = 0;                   ///< s, from the scenario's start
  std::optional<double> until;       ///< s, no longer then; to the end where absent
  template <class Archive>
  void serialize(Archive& archive) {
    archive("cameras", cameras);
    archive("from", from, Range::between(0, 1e7));
    archive("until", until, Range::between(0, 1e7));
    archive.require(!until || *until > from, "until", "expected a time after from");
  }

  bool applies_to(const std::string& camera) const {
    return cameras.empty() || std::find(cameras.begin(), cameras.end(), camera) != cameras.end();
  }
  bool is_active(Stamp stamp) const {
    return stamp >= from_seconds(from) && (!until || stamp < from_seconds(*until));
  }
};

}  // namespace vinebench::sim

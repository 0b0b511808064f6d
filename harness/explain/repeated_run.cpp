// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/repeated_run.h"

#include <sstream>

#include "core/util/error.h"

namespace vinebench::harness {

KnownPoses::KnownPoses(const std::string& text, std::string differences)
    : differences_(std::move(differences)) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    lines_[line.substr(0, line.find(' '))] = line + "\n";
  }
}

void KnownPoses::check(const Step& step) const {
  const auto known = lines_.find(format_seconds(step.stamp));
  std::string expected = known == lines_.end() ? "" : known->second;
  std::string found;
  if (step.tracked) found = format_tum({{step.stamp, *step.T_map_body}});
  if (found == expected) return;
  fail("the run cannot be repeated here: its live pose at {} s (frame {}) is another one. {}",
       format_seconds(step.stamp), step.index,
       differences_.empty()
           ? "Its files, or the program, were changed since then: run the scenario again"
           : "What computes is different: " + differences_);
}

}  // namespace vinebench::harness

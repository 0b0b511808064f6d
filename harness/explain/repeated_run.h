// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "harness/explain/rerun.h"

namespace vinebench::harness {

/// The live poses of a run, as its file says them: what a repetition must give.
class KnownPoses {
 public:
  /// `text` of a TUM file; `differences` may say why a repetition differs.
  KnownPoses(const std::string& text, std::string differences);

  /// Throws Error if the run had another pose at this step, or none.
  void check(const Step& step) const;

 private:
  std::map<std::string, std::string> lines_;  ///< by their stamps' text
  std::string differences_;
};

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/judge/expectations.h"
#include "harness/judge/results.h"

namespace vinebench::harness {

/// How a bound follows from the runs of several seeds (guard).
enum class Spread {
  kCount,  ///< a whole number: the worst of the seeds
  kShare,  ///< 0 to 1: the worst of the seeds, and as far again from the median
  kError,  ///< not negative, zero is best: likewise
  kRatio,  ///< neither too small nor too large: likewise, by the ratio
};

/// A bound of Expectations on one metric of a run.
struct Bound {
  const char* key;     ///< of Expectations
  const char* what;    ///< in a verdict
  const char* unit;    ///< behind a number, in a verdict
  const char* metric;  ///< JSON pointer into metrics.json
  bool at_least;       ///< a minimum, not a maximum
  Spread spread;
  std::optional<double> (*asked)(const Expectations&);
  std::optional<double> (*measured)(const RunResults&);
};

/// Those of single metrics, in the order of a verdict. `blind` and `median` are apart.
const std::vector<Bound>& bounds();

/// A measured or allowed value, with its unit.
std::string text_of(const Bound& bound, double value);

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/explain/explain_request.h"

namespace vinebench::harness {

/// A factor, or two of them, and what the drive is without.
struct FactorEffect {
  std::vector<std::size_t> factors;  ///< of Explanation::factors
  bool from_start = false;           ///< taken away from the drive's start on
  std::vector<StretchDrift> without{};
  Effect effect{};
  Interaction interaction{};  ///< of two
};

/// What reruns without a factor are compared with: others that differ in the noise alone.
struct Normal {
  std::vector<std::size_t> without{};  ///< factors that are absent in all of them
  std::vector<StretchDrift> drifts{};
  AsItWas chance{};
};

/// What is left of a drift without the causes that were found before. Beside a cause of half a
/// metre one of a centimetre is not seen: here it is.
struct Remainder {
  Normal normal;
  std::vector<FactorEffect> singles{};  ///< without one factor more each
  std::vector<std::size_t> causes{};    ///< the strongest first
};

struct StretchExplanation {
  Stretch stretch;
  std::int64_t aligned = 0;  ///< index of the frame since which drift is measured
  StretchDrift was{};        ///< of the run itself
  Normal normal{};           ///< that, and the placebos
  std::vector<FactorEffect> singles{};
  std::optional<FactorEffect> all{};    ///< without any of them; of two or more
  std::vector<FactorEffect> pairs{};    ///< those that were tried
  std::vector<Remainder> remainders{};  ///< each without all causes before it
  std::vector<std::size_t> causes{};    ///< factors, the strongest first, then those of remainders
};

struct Explanation {
  std::vector<Factor> factors;
  std::vector<StretchExplanation> stretches;
  int reruns = 0;
  double rerun_seconds = 0;  ///< processor time of all of them
  double null_seconds = 0;   ///< of those in which nothing was taken away, on average
};

/// Repeats the run up to just before each stretch, and from there on as it was, with placebos, and
/// without each factor, from the same state of rover and estimator. Throws Error if the repetition
/// differs from the run, for scenarios whose rover is steered by estimates, and for other SLAM
/// systems. Requires that this process has one thread and no GL context.
Explanation explain(const ExplainRequest& request);

/// The factors that cause the drift or the lost frames, the strongest first: singles, and the pair
/// that takes away most of what its two do not take away alone. Without those of remainders.
std::vector<std::size_t> causes_of(const StretchExplanation& stretch);

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/explain/explain_request.h"

namespace vinebench::harness {

/// A factor, or two of them, and what the drive is without; or, of Look::alone, with it alone.
struct FactorEffect {
  std::vector<std::size_t> factors;  ///< of Explanation::factors
  bool from_start = false;           ///< taken away from the drive's start on
  std::vector<StretchDrift> reruns{};
  Effect effect{};
  Interaction interaction{};  ///< of two
};

/// What reruns are compared with: others that differ in the noise alone.
struct Normal {
  std::vector<std::size_t> without{};  ///< factors that are absent in all of them
  std::vector<StretchDrift> drifts{};
  AsItWas chance{};
};

/// A stretch as it was, or without the causes that were found before. Beside a cause of half a
/// metre one of a centimetre is not seen: without it, it is.
struct Look {
  Normal normal{};
  std::vector<FactorEffect> singles{};  ///< without one factor more each
  Normal nothing{};                     ///< without any factor, if alone are tried
  /// With one factor each and no other. Tried where all factors together have an effect and no
  /// single one has: of two causes that would each do, neither takes anything away.
  std::vector<FactorEffect> alone{};
  std::vector<std::size_t> causes{};  ///< factors, the strongest first
};

struct StretchExplanation {
  Stretch stretch;
  std::int64_t aligned = 0;           ///< index of the frame since which drift is measured
  StretchDrift was{};                 ///< of the run itself
  std::vector<Look> looks{};          ///< the first one as it was, each other without the causes
                                      ///< of those before it
  std::optional<FactorEffect> all{};  ///< without any factor
  std::vector<FactorEffect> pairs{};  ///< those that were tried

  /// Factors, the strongest first, then those of further looks.
  std::vector<std::size_t> causes() const;
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

/// The factors that cause the drift or the lost frames of a look, the strongest first.
std::vector<std::size_t> causes_of(const Look& look);

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/explain/rerun.h"

namespace vinebench::harness {

/// Frames of a drive, by index; both included.
struct Stretch {
  int number = 1;  ///< as the run lists its degraded segments
  std::int64_t first = 0;
  std::int64_t last = 0;
  std::vector<std::string> coincide{};  ///< causes that the run's diagnosis names
};

/// How the estimate did in a stretch.
struct StretchDrift {
  double metres = 0;  ///< root mean square over its frames of the live pose's drift since `aligned`
  double end = 0;     ///< m, the drift at its last frame with a pose
  double lost = 0;    ///< frames without a pose supported by cameras
};

/// With true and estimated pose aligned at the frame of index `aligned`, or at the first one after
/// it with a pose. Dead reckoning counts as a pose. Zeros without any.
StretchDrift drift_of(const std::vector<Step>& steps, const Stretch& stretch, std::int64_t aligned);

/// What chance alone makes of a value: of runs that differ in the draw of the noise alone.
struct Chance {
  double mean = 0;
  double deviation = 0;  ///< standard deviation, of n - 1
  int runs = 0;

  /// What a difference between the mean and one more run exceeds in one of a hundred cases by
  /// chance, by Student's t. Or that of a sum of so many reruns and the mean times `means`.
  double limit(int reruns = 1, int means = 1) const;
};

Chance chance_of(const std::vector<double>& values);

/// What a rerun without something took away.
struct Effect {
  double metres = 0;             ///< of the drift; negative where it was worse without
  double lost = 0;               ///< frames
  bool drift_is_caused = false;  ///< beyond chance, and not little
  bool losses_are_caused = false;

  bool is_cause() const { return drift_is_caused || losses_are_caused; }
};

/// The drift as it was: the run's own and those of the placebos.
struct AsItWas {
  Chance metres;
  Chance lost;
};
AsItWas as_it_was(const std::vector<StretchDrift>& drifts);

/// A cause takes away more than chance could, and at least a millimetre and a fifth of the drift,
/// or two frames and a fifth of those lost.
Effect effect_of(const AsItWas& was, const StretchDrift& without);

/// By how much a pair's effect exceeds the sum of the two, m. Negative: each alone takes away what
/// both share. `certain` if it is beyond chance, and not little.
struct Interaction {
  double metres = 0;
  double lost = 0;  ///< frames
  bool certain = false;
};
Interaction interaction_of(const AsItWas& was, const Effect& one, const Effect& other,
                           const Effect& both);

/// Whether the singles' sum misses the effect of all together by more than chance and 30 % of the
/// drift: pairs are then tried.
bool do_not_add_up(const AsItWas& was, const std::vector<Effect>& singles, const Effect& all);

}  // namespace vinebench::harness

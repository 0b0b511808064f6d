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

/// What chance alone makes of a value that is not negative: of runs that differ in the draw of the
/// noise alone. Drift spreads in proportion to its size, so that its logarithm is compared.
class Chance {
 public:
  Chance() = default;
  /// `floor` is added to each value: what is much smaller makes no difference.
  Chance(const std::vector<double>& values, double floor);

  int runs() const { return runs_; }
  double typical() const { return typical_; }      ///< the median: a rare loss weighs little
  double deviation() const { return deviation_; }  ///< standard deviation, of n - 1

  /// By how much the mean of some reruns must be smaller so that chance does it in one of a hundred
  /// cases only, by Student's t on one side. The deviation counts as at least a tenth.
  double limit(std::size_t reruns = 1) const;
  /// Whether it is.
  bool is_undercut_by(const std::vector<double>& reruns) const;
  /// Whether it is larger by as much, on the logarithm's scale.
  bool is_exceeded_by(const std::vector<double>& reruns) const;
  /// Whether it may be that a share of the value is taken away by what these reruns are without:
  /// the share that they say, and one standard error.
  bool may_take(double share, const std::vector<double>& reruns) const;
  /// Likewise, that as much is added by what these reruns have.
  bool may_add(double value, const std::vector<double>& reruns) const;

 private:
  double log_error(std::size_t reruns) const;
  double log_limit(std::size_t reruns) const;
  double log_less(const std::vector<double>& reruns) const;

  int runs_ = 0;
  double typical_ = 0;
  double deviation_ = 0;
  double floor_ = 0;
  double log_mean_ = 0;
  double log_deviation_ = 0;
};

/// What reruns without something took away, or those with it alone added.
struct Effect {
  double metres = 0;             ///< of the drift; negative where it was worse without
  double lost = 0;               ///< frames
  bool drift_is_caused = false;  ///< beyond chance, and not little
  bool losses_are_caused = false;
  bool is_open = false;  ///< perhaps not little, but chance could do it: more reruns may decide

  bool is_cause() const { return drift_is_caused || losses_are_caused; }
};

/// The drift as it was: the run's own and those of the placebos.
struct AsItWas {
  Chance metres;
  Chance lost;
};
AsItWas as_it_was(const std::vector<StretchDrift>& drifts);

/// A cause takes away more than chance could, and at least a millimetre and a fifth of the drift,
/// or two frames and a fifth of those lost. `without`: at least one rerun.
Effect effect_of(const AsItWas& was, const std::vector<StretchDrift>& without);

/// Of two causes that would each do, neither takes anything away. A factor that is enough adds more
/// to `nothing`, the stretch without any factor, than chance could, and as much of the drift as it
/// was as a cause takes away; likewise of the lost frames. Only of what `all` factors together
/// cause. `alone`: at least one rerun with this factor and no other.
Effect effect_alone(const AsItWas& nothing, const std::vector<StretchDrift>& alone,
                    const AsItWas& was, const Effect& all);

/// Whether there may be further causes than what `some` reruns are without: they have a millimetre
/// and a fifth more of drift than those without any factor, or two frames and a fifth more lost.
bool leaves_more(const std::vector<StretchDrift>& some,
                 const std::vector<StretchDrift>& without_all);

/// By how much a pair's effect exceeds the sum of the two. Negative: each alone takes away what
/// both cause together only. Positive: each alone would do.
struct Interaction {
  double metres = 0;
  double lost = 0;  ///< frames
};
Interaction interaction_of(const Effect& one, const Effect& other, const Effect& both);

/// Whether the effect of all together is one beyond chance and the singles' sum misses it by 30 %
/// of the drift and a millimetre, or by 30 % of the lost frames and two: pairs are then tried. What
/// is worse without a factor counts as no effect of it.
bool do_not_add_up(const AsItWas& was, const std::vector<Effect>& singles, const Effect& all);

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/effects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/util/percentile.h"

namespace vinebench::harness {
namespace {

constexpr double kLeastMetres = 1e-3;
constexpr double kLeastFrames = 2;
constexpr double kLeastShare = 0.2;      // of the drift, or of the lost frames
constexpr double kLeastMissing = 0.3;    // likewise, of what singles do not explain
constexpr double kLeastDeviation = 0.1;  // of the logarithm: a few equal placebos prove little

/// Student's t, 99 % on one side, by degrees of freedom from 1.
constexpr std::array<double, 10> kStudent{31.82, 6.96, 4.54, 3.75, 3.36,
                                          3.14,  3.00, 2.90, 2.82, 2.76};

double student(int freedom) {
  if (freedom < 1) return std::numeric_limits<double>::infinity();
  return kStudent[std::min<std::size_t>(static_cast<std::size_t>(freedom), kStudent.size()) - 1];
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
  if (values.size() < 2) return 0;
  const double mean = mean_of(values);
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

std::vector<double> logarithms(std::vector<double> values, double floor) {
  for (double& value : values) value = std::log(value + floor);
  return values;
}

std::vector<double> values_of(const std::vector<StretchDrift>& drifts,
                              double StretchDrift::*value) {
  std::vector<double> values;
  for (const StretchDrift& drift : drifts) values.push_back(drift.*value);
  return values;
}

/// Whether reruns may be without something that is not little.
bool may_matter(const std::vector<double>& without, const Chance& chance, double least) {
  return chance.typical() >= least && chance.may_take(kLeastShare, without);
}

/// Whether something is taken away that is not little.
bool matters(double effect, double typical, double least, double share = kLeastShare) {
  return effect >= least && effect >= share * typical;
}

}  // namespace

StretchDrift drift_of(const std::vector<Step>& steps, const Stretch& stretch,
                      std::int64_t aligned) {
  StretchDrift drift;
  std::optional<Pose> T_world_map;
  double squares = 0;
  int poses = 0;
  for (const Step& step : steps) {
    if (step.index < aligned || step.index > stretch.last) continue;
    if (!T_world_map && step.T_map_body) {
      T_world_map = step.T_world_body * step.T_map_body->inverse();
    }
    if (step.index < stretch.first) continue;
    if (!step.tracked) ++drift.lost;
    if (!step.T_map_body) continue;
    drift.end =
        (*T_world_map * step.T_map_body->translation - step.T_world_body.translation).norm();
    squares += drift.end * drift.end;
    ++poses;
  }
  if (poses > 0) drift.metres = std::sqrt(squares / poses);
  return drift;
}

Chance::Chance(const std::vector<double>& values, double floor)
    : runs_(static_cast<int>(values.size())),
      typical_(percentile(values, 0.5)),
      deviation_(deviation_of(values)),
      floor_(floor),
      log_mean_(mean_of(logarithms(values, floor))),
      log_deviation_(deviation_of(logarithms(values, floor))) {}

double Chance::log_error(std::size_t reruns) const {
  return std::max(log_deviation_, kLeastDeviation) *
         std::sqrt(1.0 / static_cast<double>(reruns) + 1.0 / runs_);
}

double Chance::log_limit(std::size_t reruns) const {
  return student(runs_ - 1) * log_error(reruns);
}

double Chance::log_less(const std::vector<double>& reruns) const {
  return log_mean_ - mean_of(logarithms(reruns, floor_));
}

double Chance::limit(std::size_t reruns) const {
  return std::exp(log_mean_) * (1 - std::exp(-log_limit(reruns)));
}

bool Chance::is_undercut_by(const std::vector<double>& reruns) const {
  return log_less(reruns) > log_limit(reruns.size());
}

bool Chance::is_exceeded_by(const std::vector<double>& reruns) const {
  return -log_less(reruns) > log_limit(reruns.size());
}

bool Chance::may_take(double share, const std::vector<double>& reruns) const {
  return log_less(reruns) + log_error(reruns.size()) >= -std::log(1 - share);
}

bool Chance::may_add(double value, const std::vector<double>& reruns) const {
  return -log_less(reruns) + log_error(reruns.size()) >= std::log1p(value / (typical_ + floor_));
}

AsItWas as_it_was(const std::vector<StretchDrift>& drifts) {
  return {Chance(values_of(drifts, &StretchDrift::metres), kLeastMetres),
          Chance(values_of(drifts, &StretchDrift::lost), kLeastFrames)};
}

Effect effect_of(const AsItWas& was, const std::vector<StretchDrift>& without) {
  const std::vector<double> metres = values_of(without, &StretchDrift::metres);
  const std::vector<double> lost = values_of(without, &StretchDrift::lost);
  Effect effect;
  effect.metres = was.metres.typical() - percentile(metres, 0.5);
  effect.lost = was.lost.typical() - percentile(lost, 0.5);
  const bool drift_matters = matters(effect.metres, was.metres.typical(), kLeastMetres);
  const bool losses_matter = matters(effect.lost, was.lost.typical(), kLeastFrames);
  effect.drift_is_caused = drift_matters && was.metres.is_undercut_by(metres);
  effect.losses_are_caused = losses_matter && was.lost.is_undercut_by(lost);
  effect.is_open = !effect.is_cause() && (may_matter(metres, was.metres, kLeastMetres) ||
                                          may_matter(lost, was.lost, kLeastFrames));
  return effect;
}

Effect effect_alone(const AsItWas& nothing, const std::vector<StretchDrift>& alone,
                    const AsItWas& was, const Effect& all) {
  const std::vector<double> metres = values_of(alone, &StretchDrift::metres);
  const std::vector<double> lost = values_of(alone, &StretchDrift::lost);
  Effect effect;
  effect.metres = percentile(metres, 0.5) - nothing.metres.typical();
  effect.lost = percentile(lost, 0.5) - nothing.lost.typical();
  const double least_metres = std::max(kLeastMetres, kLeastShare * was.metres.typical());
  const double least_lost = std::max(kLeastFrames, kLeastShare * was.lost.typical());
  effect.drift_is_caused =
      all.drift_is_caused && effect.metres >= least_metres && nothing.metres.is_exceeded_by(metres);
  effect.losses_are_caused =
      all.losses_are_caused && effect.lost >= least_lost && nothing.lost.is_exceeded_by(lost);
  effect.is_open = !effect.is_cause() &&
                   ((all.drift_is_caused && nothing.metres.may_add(least_metres, metres)) ||
                    (all.losses_are_caused && nothing.lost.may_add(least_lost, lost)));
  return effect;
}

bool leaves_more(const std::vector<StretchDrift>& some,
                 const std::vector<StretchDrift>& without_all) {
  const auto exceeds = [&](double StretchDrift::*value, double least) {
    const double typical = percentile(values_of(some, value), 0.5);
    return matters(typical - percentile(values_of(without_all, value), 0.5), typical, least);
  };
  return exceeds(&StretchDrift::metres, kLeastMetres) || exceeds(&StretchDrift::lost, kLeastFrames);
}

Interaction interaction_of(const Effect& one, const Effect& other, const Effect& both) {
  return {both.metres - one.metres - other.metres, both.lost - one.lost - other.lost};
}

bool do_not_add_up(const AsItWas& was, const std::vector<Effect>& singles, const Effect& all) {
  double metres = all.metres;
  double lost = all.lost;
  for (const Effect& single : singles) {
    metres -= std::max(0.0, single.metres);
    lost -= std::max(0.0, single.lost);
  }
  return (all.drift_is_caused &&
          matters(std::abs(metres), was.metres.typical(), kLeastMetres, kLeastMissing)) ||
         (all.losses_are_caused &&
          matters(std::abs(lost), was.lost.typical(), kLeastFrames, kLeastMissing));
}

}  // namespace vinebench::harness

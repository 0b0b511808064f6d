// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/effects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vinebench::harness {
namespace {

constexpr double kLeastMetres = 1e-3;
constexpr double kLeastFrames = 2;
constexpr double kLeastShare = 0.2;        // of the drift, or of the lost frames
constexpr double kLeastInteraction = 0.3;  // likewise

/// Student's t, 99 % of both sides together, by degrees of freedom from 1.
constexpr std::array<double, 10> kStudent{63.66, 9.92, 5.84, 4.60, 4.03,
                                          3.71,  3.50, 3.36, 3.25, 3.17};

double student(int freedom) {
  if (freedom < 1) return std::numeric_limits<double>::infinity();
  return kStudent[std::min<std::size_t>(static_cast<std::size_t>(freedom), kStudent.size()) - 1];
}

bool is_caused(double effect, const Chance& chance, double least) {
  return effect > chance.limit() && effect >= least && effect >= kLeastShare * chance.mean;
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

double Chance::limit(int reruns, int means) const {
  return student(runs - 1) * deviation * std::sqrt(reruns + 1.0 * means * means / runs);
}

Chance chance_of(const std::vector<double>& values) {
  Chance chance;
  chance.runs = static_cast<int>(values.size());
  for (const double value : values) chance.mean += value / chance.runs;
  double squares = 0;
  for (const double value : values) squares += (value - chance.mean) * (value - chance.mean);
  if (chance.runs > 1) chance.deviation = std::sqrt(squares / (chance.runs - 1));
  return chance;
}

AsItWas as_it_was(const std::vector<StretchDrift>& drifts) {
  std::vector<double> metres;
  std::vector<double> lost;
  for (const StretchDrift& drift : drifts) {
    metres.push_back(drift.metres);
    lost.push_back(drift.lost);
  }
  return {chance_of(metres), chance_of(lost)};
}

Effect effect_of(const AsItWas& was, const StretchDrift& without) {
  Effect effect;
  effect.metres = was.metres.mean - without.metres;
  effect.lost = was.lost.mean - without.lost;
  effect.drift_is_caused = is_caused(effect.metres, was.metres, kLeastMetres);
  effect.losses_are_caused = is_caused(effect.lost, was.lost, kLeastFrames);
  return effect;
}

Interaction interaction_of(const AsItWas& was, const Effect& one, const Effect& other,
                           const Effect& both) {
  Interaction interaction;
  interaction.metres = both.metres - one.metres - other.metres;
  interaction.lost = both.lost - one.lost - other.lost;
  const auto certain = [](double value, const Chance& chance, double least) {
    return std::abs(value) > std::max({chance.limit(3), least, kLeastInteraction * chance.mean});
  };
  interaction.certain = certain(interaction.metres, was.metres, kLeastMetres) ||
                        certain(interaction.lost, was.lost, kLeastFrames);
  return interaction;
}

bool do_not_add_up(const AsItWas& was, const std::vector<Effect>& singles, const Effect& all) {
  double metres = all.metres;
  double lost = all.lost;
  for (const Effect& single : singles) {
    metres -= single.metres;
    lost -= single.lost;
  }
  const int count = static_cast<int>(singles.size());
  const auto differs = [&](double rest, const Chance& chance, double least) {
    return std::abs(rest) >
           std::max({chance.limit(count + 1, count - 1), least, kLeastInteraction * chance.mean});
  };
  return differs(metres, was.metres, kLeastMetres) || differs(lost, was.lost, kLeastFrames);
}

}  // namespace vinebench::harness

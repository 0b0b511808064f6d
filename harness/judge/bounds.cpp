// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/bounds.h"

#include <fmt/format.h>

#include "core/geometry/angle.h"

namespace vinebench::harness {
namespace {

template <auto member>
std::optional<double> asked(const Expectations& expectations) {
  const auto& value = expectations.*member;
  return value ? std::optional(static_cast<double>(*value)) : std::nullopt;
}

template <ErrorStatistics Evaluation::*of>
std::optional<double> error(const RunResults& results) {
  return results.corrected ? std::optional(((*results.corrected).*of).rmse) : std::nullopt;
}

using Angles = AngleStatistics OrientationErrors::*;
using Angle = double AngleStatistics::*;

template <Angles of, Angle statistic>
std::optional<double> degrees(const RunResults& results) {
  if (!results.corrected) return std::nullopt;
  return results.corrected->orientation.*of.*statistic / kRadiansPerDegree;
}

const WorldErrors* in_world(const RunResults& results) {
  return results.corrected && results.corrected->world ? &*results.corrected->world : nullptr;
}

template <Angles of>
std::optional<double> world_degrees(const RunResults& results) {
  const WorldErrors* world = in_world(results);
  if (world == nullptr) return std::nullopt;
  return (world->orientation.*of).rmse / kRadiansPerDegree;
}

std::optional<double> world_error(const RunResults& results) {
  const WorldErrors* world = in_world(results);
  return world != nullptr ? std::optional(world->position.rmse) : std::nullopt;
}

std::optional<double> live_world_error(const RunResults& results) {
  return results.live_world ? std::optional(results.live_world->position.rmse) : std::nullopt;
}

std::optional<double> nees_mean(const RunResults& results) {
  const auto& consistency = results.consistency;
  return consistency && consistency->frames > 0 ? std::optional(consistency->nees_mean)
                                                : std::nullopt;
}

using E = Expectations;
using R = RunResults;

std::vector<Bound> tracking_bounds() {
  return {{"coverage_min", "coverage", "", "/coverage", true, Spread::kShare,
           asked<&E::coverage_min>, [](const R& r) { return std::optional(r.coverage); }},
          {"losses_max", "losses", "", "/losses", false, Spread::kCount, asked<&E::losses_max>,
           [](const R& r) { return std::optional<double>(r.losses); }}};
}

std::vector<Bound> position_bounds() {
  return {{"ate_rmse_max", "ATE, SE(3)-aligned", " m", "/ate_rmse_m", false, Spread::kError,
           asked<&E::ate_rmse_max>, error<&Evaluation::ate>},
          {"ate_origin_rmse_max", "ATE, first pose aligned", " m", "/ate_origin_rmse_m", false,
           Spread::kError, asked<&E::ate_origin_rmse_max>, error<&Evaluation::origin>},
          {"ate_world_rmse_max", "ATE, in the world", " m", "/ate_world_rmse_m", false,
           Spread::kError, asked<&E::ate_world_rmse_max>, world_error},
          {"ate_world_live_rmse_max", "ATE, in the world, live", " m", "/ate_world_live_rmse_m",
           false, Spread::kError, asked<&E::ate_world_live_rmse_max>, live_world_error},
          {"rpe_trans_percent_max", "RPE", " %", "/rpe_trans_percent", false, Spread::kError,
           asked<&E::rpe_trans_percent_max>,
           [](const R& r) { return r.corrected ? r.corrected->rpe_trans_percent : std::nullopt; }},
          {"worst_frame_max", "worst frame", " m", "/worst_frame/error_m", false, Spread::kError,
           asked<&E::worst_frame_max>,
           [](const R& r) {
             return r.corrected ? std::optional(r.corrected->worst.error) : std::nullopt;
           }},
          {"drift_max", "drift before a loop closure", " m", "/drift_m", false, Spread::kError,
           asked<&E::drift_max>,
           [](const R& r) { return r.drift ? std::optional(r.drift->error) : std::nullopt; }},
          {"end_error_max", "distance from the route's end", " m", "/end_error_m", false,
           Spread::kError, asked<&E::end_error_max>, [](const R& r) { return r.end_error; }}};
}

std::vector<Bound> orientation_bounds() {
  constexpr Angles heading = &OrientationErrors::heading;
  constexpr Angles tilt = &OrientationErrors::tilt;
  constexpr Angle rmse = &AngleStatistics::rmse;
  constexpr Angle max = &AngleStatistics::max;
  return {{"heading_rmse_max_deg", "heading", " deg", "/heading_rmse_deg", false, Spread::kError,
           asked<&E::heading_rmse_max_deg>, degrees<heading, rmse>},
          {"heading_error_max_deg", "heading, worst frame", " deg", "/heading_max_deg", false,
           Spread::kError, asked<&E::heading_error_max_deg>, degrees<heading, max>},
          {"tilt_rmse_max_deg", "tilt", " deg", "/tilt_rmse_deg", false, Spread::kError,
           asked<&E::tilt_rmse_max_deg>, degrees<tilt, rmse>},
          {"tilt_error_max_deg", "tilt, worst frame", " deg", "/tilt_max_deg", false,
           Spread::kError, asked<&E::tilt_error_max_deg>, degrees<tilt, max>},
          {"heading_world_rmse_max_deg", "heading in the world", " deg", "/heading_world_rmse_deg",
           false, Spread::kError, asked<&E::heading_world_rmse_max_deg>, world_degrees<heading>},
          {"tilt_world_rmse_max_deg", "tilt in the world", " deg", "/tilt_world_rmse_deg", false,
           Spread::kError, asked<&E::tilt_world_rmse_max_deg>, world_degrees<tilt>}};
}

std::vector<Bound> other_bounds() {
  return {{"nees_mean_min", "NEES, mean", "", "/nees_mean", true, Spread::kRatio,
           asked<&E::nees_mean_min>, nees_mean},
          {"nees_mean_max", "NEES, mean", "", "/nees_mean", false, Spread::kRatio,
           asked<&E::nees_mean_max>, nees_mean},
          {"loop_closures_correct_min", "loop closures, correct", "", "/loop_closures/correct",
           true, Spread::kCount, asked<&E::loop_closures_correct_min>,
           [](const R& r) { return std::optional<double>(r.loops.correct()); }},
          {"loop_closures_wrong_max", "loop closures, wrong", "", "/loop_closures/wrong", false,
           Spread::kCount, asked<&E::loop_closures_wrong_max>,
           [](const R& r) { return std::optional<double>(r.loops.wrong()); }},
          {"loop_closures_missed_max", "loop closures, missed", "", "/loop_closures/missed", false,
           Spread::kCount, asked<&E::loop_closures_missed_max>,
           [](const R& r) { return std::optional<double>(r.loops.missed.size()); }}};
}

}  // namespace

const std::vector<Bound>& bounds() {
  static const std::vector<Bound> all = [] {
    std::vector<Bound> list;
    for (const auto& part :
         {tracking_bounds(), position_bounds(), orientation_bounds(), other_bounds()}) {
      list.insert(list.end(), part.begin(), part.end());
    }
    return list;
  }();
  return all;
}

std::string text_of(const Bound& bound, double value) {
  return bound.spread == Spread::kCount ? fmt::format("{:.0f}{}", value, bound.unit)
                                        : fmt::format("{:.4f}{}", value, bound.unit);
}

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/bound_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "harness/experiment/clear_view.h"
#include "harness/judge/loop_judge.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

constexpr double kHalfTurn = 180;  // degrees

RunRecord planned_record(const ScenarioConfig& scenario) {
  const sim::SimulationConfig& simulation = scenario.simulation;
  RunRecord record;
  record.rig = load_rig(simulation.rover.rig);
  record.tags = sim::world_tags(simulation.world);
  const sim::WorldLayout layout = sim::lay_out(simulation.world);
  const ClearView view(record.rig);
  const sim::Route route(simulation.route);
  const double seconds = to_seconds(route.duration());
  const Stamp end = from_seconds(std::min(simulation.duration.value_or(seconds), seconds));
  for (std::int64_t i = 0; stamp_of_frame(i, record.rig.rate_hz) <= end; ++i) {
    Tick tick;
    tick.index = i;
    tick.stamp = stamp_of_frame(i, record.rig.rate_hz);
    const Eigen::Vector3d at = route.at(tick.stamp).pose;
    tick.truth.T_world_body = standing_at(at, layout.terrain);
    tick.truth.visible_tags = view.of(record.tags, tick.truth.T_world_body);
    record.ticks.push_back(std::move(tick));
  }
  return record;
}

void check_part(const char* part, const Expectations& asked, const RouteOutlook& drive,
                std::vector<IneffectiveBound>& found) {
  for (const Bound& bound : bounds()) {
    const std::optional<double> value = bound.asked(asked);
    if (!value) continue;
    const std::string reason = why_ineffective(bound, *value, drive);
    if (!reason.empty()) found.push_back({part, bound.key, reason});
  }
  if (asked.blind && asked.blind->inliers_drop == 0) {
    found.push_back({part, "blind.inliers_drop", "nothing is below it"});
  }
  if (!asked.median) return;
  const auto check_median = [&](const char* key, const std::optional<double>& median,
                                const std::optional<double>& each) {
    if (median && each && *median >= *each) {
      found.push_back({part, std::string("median.") + key, "each run must be below it"});
    }
  };
  check_median("ate_rmse_max", asked.median->ate_rmse_max, asked.ate_rmse_max);
  check_median("ate_origin_rmse_max", asked.median->ate_origin_rmse_max, asked.ate_origin_rmse_max);
}

}  // namespace

std::string why_ineffective(const Bound& bound, double value, const RouteOutlook& drive) {
  const std::string_view key = bound.key;
  const std::string_view unit = bound.unit;
  if (bound.at_least) return value <= 0 ? "nothing is below it" : "";
  if (key == "losses_max" && value >= drive.frames / 2) {
    return fmt::format("{} frames allow at most {} losses", drive.frames, drive.frames / 2);
  }
  if (key == "loop_closures_wrong_max" && value >= drive.frames) {
    return fmt::format("there are {} frames", drive.frames);
  }
  if (key == "loop_closures_missed_max" && value >= drive.returns) {
    return fmt::format("the route returns to tags {} times", drive.returns);
  }
  if (unit == " deg" && value >= kHalfTurn) return "no angle is larger";
  if (unit == " m" && value >= drive.reach) {
    return fmt::format("an estimate that stands still is at most {:.2f} m off", drive.reach);
  }
  return "";
}

std::string IneffectiveBound::text() const {
  return fmt::format("{}.{}: this bound cannot fail: {}", part, key, reason);
}

RouteOutlook route_outlook(const ScenarioConfig& scenario) {
  const RunRecord record = planned_record(scenario);
  RouteOutlook drive{.frames = static_cast<int>(record.ticks.size())};
  for (const Tick& tick : record.ticks) {
    const Eigen::Vector3d from_start =
        tick.truth.T_world_body.translation - record.ticks.front().truth.T_world_body.translation;
    drive.reach = std::max(drive.reach, from_start.norm());
  }
  drive.returns = judge_loop_closures(record).returns;
  return drive;
}

std::vector<IneffectiveBound> ineffective_bounds(const ScenarioConfig& scenario) {
  const RouteOutlook drive = route_outlook(scenario);
  std::vector<IneffectiveBound> found;
  check_part("expectations", scenario.expectations, drive, found);
  check_part("goal", scenario.goal, drive, found);
  if (scenario.guard) check_part("guard", scenario.guard->bounds, drive, found);
  return found;
}

}  // namespace vinebench::harness

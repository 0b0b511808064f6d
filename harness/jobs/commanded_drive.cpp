// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/commanded_drive.h"

#include <algorithm>
#include <utility>

#include "core/geometry/angle.h"
#include "core/util/error.h"

namespace vinebench::harness {

CommandedDrive::CommandedDrive(const FramesRequest& request)
    : request_(request), scenario_(scenario_of(request)), pool_(std::max(1, request.threads)) {
  begin(std::nullopt);
}

std::shared_ptr<const DatasetFrame> CommandedDrive::reset(
    std::optional<std::int64_t> seed, const std::optional<Eigen::Vector3d>& start) {
  if (seed && *seed != scenario_.seed) {
    request_.seed = seed;
    scenario_ = scenario_of(request_);
  }
  begin(start);
  return next();
}

void CommandedDrive::begin(const std::optional<Eigen::Vector3d>& start) {
  sim::SimulationConfig config = scenario_.simulation;
  if (start) {
    if (!start->allFinite()) fail("start: expected finite numbers");
    config.route.waypoints.front().position = start->head<2>();
    config.route.waypoints.front().heading_deg = start->z() / kRadiansPerDegree;
  }
  const auto seed = static_cast<std::uint64_t>(scenario_.seed);
  const CapturePlan plan = plan_of(request_, load_rig(config.rover.rig));
  if (!drawn_ || !drawn_->serves(config, seed)) {
    const auto cameras = static_cast<std::size_t>(std::ranges::count(plan.cameras, true));
    const auto threads = static_cast<std::size_t>(pool_.threads());
    drawn_ = std::make_shared<sim::DrawnScene>(
        config, seed, request_.machine.plant_cache,
        plan.cameras.empty() ? threads : std::min(threads, cameras));
  }
  frames_ = 0;
  drive_ = sim::make_commanded_simulation(config, seed, request_.machine.plant_cache, pool_, plan,
                                          drawn_);
}

std::shared_ptr<const DatasetFrame> CommandedDrive::step(const Eigen::Vector3d& twist) {
  if (frames_ == 0) fail("step: expected a reset before the first step");
  if (!twist.allFinite()) {
    fail("twist: expected finite numbers, found {}, {}, {}", twist.x(), twist.y(), twist.z());
  }
  drive_->command(twist);
  return next();
}

std::shared_ptr<const DatasetFrame> CommandedDrive::next() {
  std::optional<Sample> sample = drive_->next();
  if (!sample) return nullptr;
  return std::make_shared<const DatasetFrame>(
      DatasetFrame{frames_++, std::move(sample->frame), std::move(sample->truth)});
}

const SimulatedSource& CommandedDrive::source() const {
  return *drive_;
}

std::optional<std::int64_t> CommandedDrive::last_number() const {
  if (!scenario_.simulation.duration) return std::nullopt;
  return drive_->size() - 1;
}

std::vector<Eigen::Vector3d> CommandedDrive::route() const {
  std::vector<Eigen::Vector3d> points;
  for (const auto& waypoint : scenario_.simulation.route.waypoints) {
    points.emplace_back(waypoint.position.x(), waypoint.position.y(),
                        waypoint.heading_deg * kRadiansPerDegree);
  }
  return points;
}

}  // namespace vinebench::harness

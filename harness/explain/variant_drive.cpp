// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/variant_drive.h"

#include <algorithm>

#include "sim/simulation.h"

namespace vinebench::harness {
namespace {

CapturePlan plan_of(const Splice& splice, std::int64_t last) {
  CapturePlan plan;
  plan.first = splice.first;
  plan.last = last;
  return plan;
}

/// To the bit, whatever the signs of zeros.
bool equal(const Pose& a, const Pose& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

template <class Reading>
void erase_until(Stamp stamp, std::vector<Reading>& readings) {
  std::erase_if(readings, [&](const Reading& reading) { return reading.stamp <= stamp; });
}

}  // namespace

Rig told_rig(const Variant& variant) {
  Rig rig = load_rig(variant.scenario.simulation.rover.rig);
  if (!variant.ideal_lenses) return rig;
  for (RigCamera& camera : rig.cameras) camera.model = camera.model.without_distortion();
  return rig;
}

VariantDrive::VariantDrive(const Variant& variant, const Splice& splice, std::int64_t last,
                           const Machine& machine, WorkerPool& pool,
                           const std::shared_ptr<sim::DrawnScene>& drawn)
    : splice_(splice),
      simulation_(sim::make_simulation(variant.scenario.simulation,
                                       static_cast<std::uint64_t>(variant.scenario.seed),
                                       machine.plant_cache, pool, plan_of(splice, last), drawn)),
      rig_(told_rig(variant)) {
  const sim::RoverConfig& rover = variant.scenario.simulation.rover;
  if (variant.without_slip) {
    rolling_.emplace(sim::MecanumDrive{rover.wheel_radius, rover.half_track, rover.half_wheelbase});
  }
}

std::optional<Sample> VariantDrive::next() {
  std::optional<Sample> sample = simulation_->next();
  if (!sample) return sample;
  if (!joined_ && splice_.first > 0) {
    join(*sample);
  } else if (rolling_) {
    rolling_->replace(sample->frame.wheels, sample->truth.path);
  }
  joined_ = true;
  return sample;
}

/// The simulation gives the first frame all readings since the start.
void VariantDrive::join(Sample& sample) {
  const Trajectory& path = sample.truth.path;
  if (splice_.path_end) {
    const auto end =
        std::ranges::lower_bound(path, splice_.path_end->stamp, {}, &StampedPose::stamp);
    same_drive_ = end != path.end() && end->stamp == splice_.path_end->stamp &&
                  equal(end->pose, splice_.path_end->pose);
  }
  if (rolling_) {
    std::vector<WheelSample>& wheels = sample.frame.wheels;
    const auto later = std::ranges::upper_bound(wheels, splice_.before, {}, &WheelSample::stamp);
    if (later != wheels.begin()) wheels.erase(wheels.begin(), later - 1);
    rolling_->replace(wheels, path);
  }
  erase_until(splice_.before, sample.frame.imu);
  erase_until(splice_.before, sample.frame.wheels);
}

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/rerun.h"

#include "harness/run/run_cost.h"
#include "harness/run/run_record.h"
#include "harness/systems/host/wire.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

using Numbers = std::array<double, 7>;

Numbers numbers_of(const Pose& pose) {
  const Eigen::Vector3d& p = pose.translation;
  const Eigen::Quaterniond& q = pose.rotation;
  return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

Pose pose_of(const Numbers& n) {
  return {Eigen::Quaterniond(n[6], n[3], n[4], n[5]), {n[0], n[1], n[2]}};
}

}  // namespace

Step step_of(const Sample& sample, const Estimate& estimate) {
  return {sample.frame.index, sample.frame.stamp, sample.truth.T_world_body, estimate.T_map_body,
          is_tracked(estimate)};
}

Rerun run_variant(const Variant& variant, const Splice& splice, std::int64_t last,
                  const Machine& machine, const Prepared& prepared) {
  const double start = cpu_seconds();
  WorkerPool pool(1);
  VariantDrive drive(variant, splice, last, machine, pool, prepared.drawn);
  slam::MappingSystem* slam = prepared.slam;
  std::unique_ptr<slam::MappingSystem> own;
  if (slam == nullptr) {
    own = slam::make_slam(variant.scenario.slam, drive.rig(), registered_tags(variant.scenario),
                          pool);
    slam = own.get();
  }
  Rerun rerun;
  while (const auto sample = drive.next()) {
    if (!drive.is_same_drive()) {
      rerun.same_drive = false;
      break;
    }
    rerun.steps.push_back(step_of(*sample, slam->process(sample->frame)));
  }
  rerun.seconds = cpu_seconds() - start;
  return rerun;
}

std::string pack_rerun(const Rerun& rerun) {
  MessageWriter message;
  message.add(rerun.same_drive);
  message.add(rerun.seconds);
  message.add(static_cast<std::uint64_t>(rerun.steps.size()));
  for (const Step& step : rerun.steps) {
    message.add(step.index);
    message.add(step.stamp);
    message.add(numbers_of(step.T_world_body));
    message.add(step.T_map_body.has_value());
    message.add(numbers_of(step.T_map_body.value_or(Pose{})));
    message.add(step.tracked);
  }
  return message.content();
}

Rerun unpack_rerun(const std::string& content) {
  MessageReader message(content);
  Rerun rerun;
  rerun.same_drive = message.read<bool>();
  rerun.seconds = message.read<double>();
  rerun.steps.resize(message.read<std::uint64_t>());
  for (Step& step : rerun.steps) {
    step.index = message.read<std::int64_t>();
    step.stamp = message.read<Stamp>();
    step.T_world_body = pose_of(message.read<Numbers>());
    const bool has_pose = message.read<bool>();
    const Pose pose = pose_of(message.read<Numbers>());
    if (has_pose) step.T_map_body = pose;
    step.tracked = message.read<bool>();
  }
  return rerun;
}

}  // namespace vinebench::harness

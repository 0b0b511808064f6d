// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "core/geometry/angle.h"
#include "tests/mutants/mutant.h"

namespace vinebench::mutants {
namespace {

using Names = std::vector<std::string>;
const Names kFront{"front_left", "front_right"};
const Names kBack{"back_left", "back_right"};
const Names kPairs{"front_left", "front_right", "back_left", "back_right"};

RigCamera& camera(Rig& rig, const std::string& name) {
  return rig.cameras.at(static_cast<std::size_t>(rig.find_camera(name)));
}

Mutant calibration(std::string name, std::string text, std::function<void(Rig&)> change) {
  return {.name = std::move(name),
          .part = "calibration",
          .text = std::move(text),
          .tell = [change = std::move(change)](Told& told) { change(told.rig); }};
}

/// Of each of the cameras.
Mutant lens(std::string name, std::string text, const Names& names,
            const std::function<void(PinholeCamera&)>& change) {
  return calibration(std::move(name), std::move(text), [names, change](Rig& rig) {
    for (const std::string& each : names) change(camera(rig, each).model);
  });
}

/// Of each of the cameras: turned about the body's axes through the middle of them, and moved.
Mutant mount(std::string name, std::string text, const Names& names,
             const Eigen::Vector3d& turn_deg, const Eigen::Vector3d& shift) {
  return calibration(std::move(name), std::move(text), [=](Rig& rig) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::string& each : names) middle += camera(rig, each).T_body_cam.translation;
    middle /= static_cast<double>(names.size());
    const Pose about{Eigen::Quaterniond::Identity(), middle};
    const Pose moved = Pose{Eigen::Quaterniond::Identity(), shift} * about *
                       Pose{exp_so3(kRadiansPerDegree * turn_deg), Eigen::Vector3d::Zero()} *
                       about.inverse();
    for (const std::string& each : names) {
      Pose& T_body_cam = camera(rig, each).T_body_cam;
      T_body_cam = moved * T_body_cam;
    }
  });
}

Mutant baseline(std::string name, std::string text, const Names& pairs, double factor) {
  return calibration(std::move(name), std::move(text), [=](Rig& rig) {
    for (const StereoPair& pair : rig.stereo_pairs) {
      if (std::ranges::find(pairs, pair.name) == pairs.end()) continue;
      const Pose& left = rig.cameras[static_cast<std::size_t>(pair.left)].T_body_cam;
      Pose& right = rig.cameras[static_cast<std::size_t>(pair.right)].T_body_cam;
      right.translation = left.translation + factor * (right.translation - left.translation);
    }
  });
}

void swap_calibration(Rig& rig, const std::string& one, const std::string& other) {
  RigCamera& a = camera(rig, one);
  RigCamera& b = camera(rig, other);
  std::swap(a.model, b.model);
  std::swap(a.T_body_cam, b.T_body_cam);
}

Mutant survey(std::string name, std::string text, std::function<void(RegisteredTag&)> change) {
  return {.name = std::move(name),
          .part = "survey",
          .text = std::move(text),
          .tell = [change = std::move(change)](Told& told) {
            std::ranges::for_each(told.tags, change);
          }};
}

Mutant tag_moved(std::string name, std::string text, const Eigen::Vector3d& shift,
                 double turn_deg) {
  return survey(std::move(name), std::move(text), [=](RegisteredTag& tag) {
    tag.T_world_tag.translation += shift;
    tag.T_world_tag.rotation =
        exp_so3({0, 0, kRadiansPerDegree * turn_deg}) * tag.T_world_tag.rotation;
  });
}

Mutant sensors(std::string name, std::string text, std::vector<Override> settings) {
  return {.name = std::move(name),
          .part = "sensors",
          .text = std::move(text),
          .settings = std::move(settings)};
}

Mutant estimator(std::string name, std::string text, Fault fault, double size) {
  return {.name = std::move(name),
          .part = "estimator",
          .text = std::move(text),
          .fault = EstimatorFault{fault, size}};
}

void add_calibrations(std::vector<Mutant>& list) {
  list.push_back(baseline("baselines", "both baselines 2 % too long", {"front", "back"}, 1.02));
  list.push_back(baseline("front-baseline", "front baseline 2 % too short", {"front"}, 0.98));
  list.push_back(baseline("back-baseline", "back baseline 2 % too long", {"back"}, 1.02));
  list.push_back(baseline("baselines-1", "both baselines 1 % too short", {"front", "back"}, 0.99));
  const auto scaled = [](double factor) {
    return [factor](PinholeCamera& model) {
      model.fx *= factor;
      model.fy *= factor;
    };
  };
  list.push_back(lens("focal", "focal length of both pairs 1 % too long", kPairs, scaled(1.01)));
  list.push_back(
      lens("front-focal", "focal length of the front pair 1 % too short", kFront, scaled(0.99)));
  list.push_back(lens("one-focal", "focal length of the left back camera 1 % too long",
                      {"back_left"}, scaled(1.01)));
  list.push_back(lens("aspect", "fy of both pairs 2 % too long", kPairs,
                      [](PinholeCamera& model) { model.fy *= 1.02; }));
  list.push_back(lens("front-centre", "cx of the front pair 6 px too large", kFront,
                      [](PinholeCamera& model) { model.cx += 6; }));
  list.push_back(lens("back-centre-y", "cy of the back pair 6 px too small", kBack,
                      [](PinholeCamera& model) { model.cy -= 6; }));
  list.push_back(lens("one-centre-y", "cy of the right front camera 3 px too large",
                      {"front_right"}, [](PinholeCamera& model) { model.cy += 3; }));
  list.push_back(
      lens("side-focal", "focal length of the side camera 3 % too long", {"side"}, scaled(1.03)));
  list.push_back(mount("front-yaw", "front pair turned by 1 degree about z", kFront, {0, 0, 1},
                       Eigen::Vector3d::Zero()));
  list.push_back(mount("back-pitch", "back pair turned by 1 degree about y", kBack, {0, 1, 0},
                       Eigen::Vector3d::Zero()));
  list.push_back(mount("front-roll", "front pair turned by 1 degree about x", kFront, {1, 0, 0},
                       Eigen::Vector3d::Zero()));
  list.push_back(mount("back-position", "back pair 3 cm too far to the left", kBack,
                       Eigen::Vector3d::Zero(), {0, 0.03, 0}));
  list.push_back(mount("one-yaw", "right front camera turned by 0.3 degrees about z",
                       {"front_right"}, {0, 0, 0.3}, Eigen::Vector3d::Zero()));
  list.push_back(mount("side-yaw", "side camera turned by 2 degrees about z", {"side"}, {0, 0, 2},
                       Eigen::Vector3d::Zero()));
  list.push_back(mount("side-position", "side camera 3 cm too far ahead", {"side"},
                       Eigen::Vector3d::Zero(), {0.03, 0, 0}));
  list.push_back(calibration("swapped-front", "left and right of the front pair swapped",
                             [](Rig& rig) { swap_calibration(rig, "front_left", "front_right"); }));
  list.push_back(calibration("swapped-pairs", "front and back pair swapped", [](Rig& rig) {
    swap_calibration(rig, "front_left", "back_left");
    swap_calibration(rig, "front_right", "back_right");
  }));
}

void add_surveys(std::vector<Mutant>& list) {
  list.push_back(tag_moved("survey", "tags surveyed 6 cm and 5 degrees wrong", {0.06, 0, 0}, 5));
  list.push_back(tag_moved("survey-height", "tags surveyed 4 cm too high", {0, 0, 0.04}, 0));
  list.push_back(tag_moved("survey-turn", "tags surveyed 2 degrees wrong", {0, 0, 0}, 2));
  list.push_back(
      survey("tag-size", "tags 5 % too large", [](RegisteredTag& tag) { tag.size *= 1.05; }));
  list.push_back(
      survey("tag-id", "tags with another's number", [](RegisteredTag& tag) { tag.id += 100; }));
}

std::string triggers(const Names& names, double delay) {
  std::string list = "[";
  for (const std::string& name : names) {
    list += (list.size() > 1 ? ", " : "") + ("{camera: " + name) +
            ", delay: " + std::to_string(delay) + "}";
  }
  return list + "]";
}

void add_sensors(std::vector<Mutant>& list) {
  const std::string kTriggers = "sensors.timing.triggers";
  list.push_back(
      sensors("late-pair", "back pair exposes 10 ms late", {{kTriggers, triggers(kBack, 0.01)}}));
  list.push_back(sensors("early-pair", "front pair exposes 10 ms early",
                         {{kTriggers, triggers(kFront, -0.01)}}));
  list.push_back(sensors("late-camera", "right front camera exposes 5 ms late",
                         {{kTriggers, triggers({"front_right"}, 0.005)}}));
  list.push_back(
      sensors("stamps", "all stamps 30 ms too late", {{"sensors.timing.stamp_offset", "0.03"}}));
  list.push_back({.name = "wheel-radius",
                  .part = "calibration",
                  .text = "wheels 5 % too large",
                  .tell = [](Told& told) { told.config.dead_reckoning.wheels->radius *= 1.05; }});
  list.push_back(sensors("accelerometer", "accelerometer off by 0.5 m/s^2",
                         {{"sensors.inertial.accelerometer.initial_bias", "0.5"}}));
  list.push_back(
      sensors("drops", "a fifth of the frames is lost", {{"sensors.drops.frame_rate", "0.2"}}));
}

void add_estimators(std::vector<Mutant>& list) {
  list.push_back(estimator("scale", "scale frozen 1 % too large", Fault::kScale, 0.01));
  list.push_back(estimator("late", "poses one frame late", Fault::kLate, 1.0 / 15));
  list.push_back(estimator("jump", "a jump of 2 cm", Fault::kJump, 0.02));
  list.push_back(estimator("jump-back", "2 cm off for a second", Fault::kJumpBack, 0.02));
  list.push_back(estimator("drift", "drift of 0.3 %, sideways", Fault::kDrift, 0.003));
  list.push_back(estimator("climb", "drift of 0.3 %, upwards", Fault::kClimb, 0.003));
  list.push_back(estimator("heading", "heading drifts by 0.3 degrees a metre", Fault::kHeadingDrift,
                           0.3 * kRadiansPerDegree));
  list.push_back(estimator("tilt", "rolled by 0.5 degrees", Fault::kTilt, 0.5 * kRadiansPerDegree));
  list.push_back(estimator("frozen", "stands still for a second", Fault::kFrozen, 1));
  list.push_back(estimator("silent-loss", "lost silently for two seconds", Fault::kSilentLoss, 2));
  list.push_back(estimator("open-loss", "lost for half a second", Fault::kOpenLoss, 0.5));
  list.push_back(estimator("noise", "noise of 5 mm", Fault::kNoise, 0.005));
  list.push_back(
      estimator("overconfident", "covariance ten times too small", Fault::kCovariance, 0.1));
  list.push_back(
      estimator("underconfident", "covariance ten times too large", Fault::kCovariance, 10));
  list.push_back(estimator("false-loop", "a wrong loop closure of 20 cm", Fault::kFalseLoop, 0.2));
  list.push_back(estimator("world", "the map 3 cm off in the world", Fault::kWorld, 0.03));
  list.push_back({.name = "forgotten-loop",
                  .part = "estimator",
                  .text = "loops are never closed",
                  .tell = [](Told& told) { told.config.loop.enabled = false; }});
}

}  // namespace

std::vector<Mutant> all_mutants() {
  std::vector<Mutant> list;
  add_calibrations(list);
  add_surveys(list);
  add_sensors(list);
  add_estimators(list);
  return list;
}

}  // namespace vinebench::mutants

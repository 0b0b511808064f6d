// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// A broken SLAM core must not pass the suite. Faults are simulated by wrong inputs of the core.
#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/imgproc.hpp>
#include <set>

#include "harness/experiment/scenario.h"
#include "harness/judge/results.h"
#include "harness/judge/verdict.h"
#include "harness/machine.h"
#include "harness/run/lockstep.h"
#include "sim/world/world_layout.h"
#include "slam/slam.h"

namespace vinebench::harness {
namespace {

/// The frames of a simulation, recorded once for any number of SLAM systems.
class KeptFrames : public FrameSource {
 public:
  explicit KeptFrames(FrameSource& source) : rig_(source.rig()) {
    while (auto sample = source.next()) {
      for (cv::Mat& image : sample->frame.images) {
        cv::Mat grey;
        cv::cvtColor(image, grey, cv::COLOR_RGB2GRAY);
        image = grey;
      }
      samples_.push_back(std::move(*sample));
    }
  }
  void rewind() { next_ = 0; }
  std::optional<Sample> next() override {
    if (next_ == samples_.size()) return std::nullopt;
    return samples_[next_++];
  }
  std::int64_t size() const override { return static_cast<std::int64_t>(samples_.size()); }
  const Rig& rig() const override { return rig_; }
  const StageTimes& times() const override { return times_; }

 private:
  Rig rig_;
  std::vector<Sample> samples_;
  std::size_t next_ = 0;
  StageTimes times_;
};

/// Ten seconds past the box and back to the tag, driven once for any number of SLAM cores.
class Drive {
 public:
  Drive()
      : scenario_(load_scenario(std::filesystem::path(VINEBENCH_SOURCE_DIR) /
                                "scenarios/quick-loop.yaml")),
        frames_(*sim::make_simulation(scenario_.simulation,
                                      static_cast<std::uint64_t>(scenario_.seed),
                                      machine_of_environment().plant_cache, pool_)) {}

  const Rig& rig() const { return frames_.rig(); }
  const slam::SlamConfig& config() const { return scenario_.slam; }

  /// The expectations not met by a SLAM core with this rig and these settings.
  std::set<std::string> broken_expectations(const Rig& nominal, const slam::SlamConfig& config) {
    frames_.rewind();
    const auto slam =
        slam::make_slam(config, nominal, sim::registered_tags(scenario_.simulation.world), pool_);
    RunRecorder recorder(frames_.rig(), sim::world_tags(scenario_.simulation.world));
    run_lockstep(frames_, *slam, {&recorder});
    std::set<std::string> broken;
    const Trial trial = trial_of(scenario_);
    for (const Check& check : check_trial(trial, measure(recorder.record(), trial))) {
      if (!check.ok) broken.insert(check.what);
    }
    return broken;
  }

 private:
  WorkerPool pool_{2};
  ScenarioConfig scenario_;
  KeptFrames frames_;
};

Rig with_baselines_times(double factor, Rig rig) {
  for (const StereoPair& pair : rig.stereo_pairs) {
    const Pose& left = rig.cameras[static_cast<std::size_t>(pair.left)].T_body_cam;
    Pose& right = rig.cameras[static_cast<std::size_t>(pair.right)].T_body_cam;
    right.translation = left.translation + factor * (right.translation - left.translation);
  }
  return rig;
}

Rig with_the_back_pair_looking_ahead(Rig rig) {
  const Pose half_turn{from_roll_pitch_yaw({0, 0, std::numbers::pi}), Eigen::Vector3d::Zero()};
  const StereoPair& back = rig.stereo_pairs.at(1);
  for (const int camera : {back.left, back.right}) {
    Pose& mounted = rig.cameras[static_cast<std::size_t>(camera)].T_body_cam;
    mounted = half_turn * mounted;
  }
  return rig;
}

// One test, because the simulation of the drive takes longer than its estimation.
TEST(BrokenSlamTest, EachFaultIsCaughtByTheExpectationThatShould) {
  Drive drive;
  EXPECT_TRUE(drive.broken_expectations(drive.rig(), drive.config()).empty());

  // Depths, and therefore the estimated path, are 2 % too long: 2 cm at the end of a metre.
  const auto longer =
      drive.broken_expectations(with_baselines_times(1.02, drive.rig()), drive.config());
  EXPECT_TRUE(longer.contains("ATE, first pose aligned"));

  slam::SlamConfig without_tags = drive.config();
  without_tags.loop.enabled = false;
  const auto open = drive.broken_expectations(drive.rig(), without_tags);
  EXPECT_TRUE(open.contains("loop closures, correct"));
  EXPECT_TRUE(open.contains("loop closures, missed"));

  // While the box covers the front pair no correct measurement is left.
  const auto mirrored =
      drive.broken_expectations(with_the_back_pair_looking_ahead(drive.rig()), drive.config());
  EXPECT_TRUE(mirrored.contains("coverage") || mirrored.contains("ATE, first pose aligned"));
}

}  // namespace
}  // namespace vinebench::harness

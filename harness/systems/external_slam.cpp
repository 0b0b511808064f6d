// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/external_slam.h"

#include <algorithm>
#include <optional>

#include "core/files/output_folder.h"
#include "core/util/error.h"
#include "harness/run/system_failure.h"
#include "harness/systems/foreign_trajectory.h"
#include "harness/systems/process_group.h"
#include "harness/systems/program.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBody = "body";

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

/// Throws Error unless the path lies in the folder, by links too.
void check_inside(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path inside = fs::weakly_canonical(folder.parent_path(), error) / folder.filename();
  const fs::path real = fs::weakly_canonical(path, error);
  if (!error && std::ranges::mismatch(inside, real).in1 == inside.end()) return;
  fail("slam.external.trajectory: {} leads out of {}", path.string(), folder.string());
}

/// Removes the files of an earlier run only.
fs::path clear_recording(const fs::path& folder) {
  std::error_code ignored;
  if (fs::exists(folder / "frames.csv", ignored) && fs::exists(folder / "mav0", ignored)) {
    fs::remove_all(folder, ignored);
  }
  return folder;
}

class ExternalSlam : public SlamSystem {
 public:
  ExternalSlam(const ExternalSlamConfig& config, const RecordingNotes& notes,
               const fs::path& folder, std::function<bool()> stopped)
      : config_(config),
        rig_(notes.rig.make()),
        recording_(fs::absolute(clear_recording(folder / "recording"))),
        output_(fs::absolute(folder / "external")),
        stopped_(std::move(stopped)) {
    check_external_slam(config, rig_);
    check_executable(config.program);
    create_inner_folder(output_);
    create_inner_folder(recording_);
    const fs::path file = output_ / config.trajectory;
    check_inside(file.parent_path(), output_);
    std::error_code ignored;
    fs::remove(file, ignored);  // of an earlier run
    writer_.emplace(recording_, notes);
  }

  Estimate process(const Frame& frame) override {
    Estimate estimate;
    estimate.stamp = frame.stamp;
    Truth none;
    none.known = false;
    writer_->on_tick({frame, none, {}}, estimate);
    stamps_.push_back(frame.stamp);
    return estimate;
  }

  SlamSummary finish() override {
    SlamSummary summary;
    writer_->on_finish(summary);
    writer_.reset();
    std::error_code ignored;
    fs::remove_all(recording_ / "mav0/state_groundtruth_estimate0", ignored);  // empty
    try {
      if (!run()) return summary;
      summary.trajectory = read_trajectory();
    } catch (const Error& error) {
      throw SystemFailure(error.what());
    }
    if (!config_.keep_recording) fs::remove_all(recording_, ignored);
    return summary;
  }

  const StageTimes& times() const override { return times_; }

 private:
  /// False if it was stopped.
  bool run() {
    const ScopedTimer timer(times_, "external");
    Program program{.file = config_.program,
                    .arguments = config_.arguments,
                    .environment = {{"VINEBENCH_RECORDING", recording_.string()},
                                    {"VINEBENCH_OUTPUT", output_.string()}},
                    .folder = output_,
                    .log = output_ / "log.txt",
                    .timeout = config_.timeout,
                    .memory_mib = config_.memory_mib,
                    .stopped = stopped_};
    for (std::string& argument : program.arguments) {
      replace_all(argument, "{recording}", recording_.string());
      replace_all(argument, "{output}", output_.string());
    }
    return run_program(program);
  }

  Trajectory read_trajectory() const {
    const fs::path file = output_ / config_.trajectory;
    std::error_code ignored;
    if (!fs::exists(file, ignored)) {
      fail("{}: wrote no trajectory; expected {}; its messages are in {}", config_.program.string(),
           file.string(), (output_ / "log.txt").string());
    }
    check_inside(file, output_);
    Pose T_sensor_body;
    if (config_.poses_of != kBody) {
      const auto camera = static_cast<std::size_t>(rig_.find_camera(config_.poses_of));
      T_sensor_body = rig_.cameras[camera].T_body_cam.inverse();
    }
    return read_foreign_trajectory(file, stamps_, T_sensor_body);
  }

  ExternalSlamConfig config_;
  Rig rig_;
  fs::path recording_;
  fs::path output_;
  std::function<bool()> stopped_;
  std::optional<EurocSink> writer_;
  std::vector<Stamp> stamps_;
  StageTimes times_;
};

}  // namespace

void check_external_slam(const ExternalSlamConfig& config, const Rig& rig) {
  if (config.poses_of != kBody && rig.find_camera(config.poses_of) < 0) {
    fail("slam.external.poses_of: expected 'body' or a camera of the rig, found '{}'",
         config.poses_of);
  }
}

std::unique_ptr<SlamSystem> make_external_slam(const ExternalSlamConfig& config,
                                               const RecordingNotes& notes, const fs::path& folder,
                                               std::function<bool()> stopped) {
  return std::make_unique<ExternalSlam>(config, notes, folder, std::move(stopped));
}

}  // namespace vinebench::harness

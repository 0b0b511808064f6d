// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/dataset_reader.h"

#include <algorithm>

#include "core/util/error.h"
#include "harness/datasets/format/dataset_card.h"
#include "harness/datasets/reading/dataset_readers.h"
#include "harness/datasets/reading/recorded_images.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr Stamp kSameInstant = 1000;                    // ns
constexpr Stamp kTruthGap = kNanosecondsPerSecond / 4;  // ns
constexpr const char* kFormats =
    "an EuRoC/ASL folder (mav0/cam0 with data.csv and sensor.yaml) or a KITTI odometry folder "
    "(calib.txt beside image_0 and image_1, image_2 and image_3, or image_l and image_r)";

/// The first image of each camera that can be read must have the size of its calibration.
void check_sizes(const Recording& recording) {
  for (std::size_t camera = 0; camera < recording.rig.cameras.size(); ++camera) {
    const RigCamera& expected = recording.rig.cameras[camera];
    const cv::Size size = first_image_size(recording, camera);
    if (size.empty()) continue;
    if (size.width != expected.model.width || size.height != expected.model.height) {
      fail("{}: camera '{}': its calibration is for {} x {} pixels, its first image has {} x {}",
           recording.name, expected.name, expected.model.width, expected.model.height, size.width,
           size.height);
    }
  }
}

class RecordingSource : public FrameSource {
 public:
  RecordingSource(Recording recording, WorkerPool& pool)
      : recording_(std::move(recording)), pool_(pool) {}

  std::optional<Sample> next() override {
    if (index_ >= recording_.frames.size()) return std::nullopt;
    const RecordedFrame& recorded = recording_.frames[index_];
    Sample sample;
    sample.frame.index = static_cast<std::int64_t>(index_);
    sample.frame.stamp = recorded.stamp;
    sample.events = recorded.events;
    read_images(recorded, sample);
    hand_out(recording_.imu, next_imu_, recorded.stamp, sample.frame.imu);
    hand_out(recording_.wheels, next_wheels_, recorded.stamp, sample.frame.wheels);
    const auto truth = pose_at(recording_.truth, recorded.stamp, kTruthGap);
    sample.truth.known = truth.has_value();
    if (truth) sample.truth.T_world_body = *truth;
    if (!truth && !recording_.truth.empty()) {
      sample.events.push_back({"groundtruth_missing", "groundtruth", "none at this frame's time"});
    }
    ++index_;
    return sample;
  }
  std::int64_t size() const override { return static_cast<std::int64_t>(recording_.frames.size()); }
  const Rig& rig() const override { return recording_.rig; }
  const StageTimes& times() const override { return times_; }

 private:
  void read_images(const RecordedFrame& recorded, Sample& sample) {
    const ScopedTimer timer(times_, "read images");
    const std::size_t cameras = recording_.rig.cameras.size();
    sample.frame.images.resize(cameras);
    std::vector<std::optional<SourceEvent>> faults(cameras);
    pool_.for_each(cameras, [&](std::size_t camera) {
      faults[camera] = read_image(recorded.images[camera], recording_.rig.cameras[camera],
                                  sample.frame.images[camera]);
    });
    for (const auto& fault : faults) {
      if (fault) sample.events.push_back(*fault);
    }
  }

  static std::optional<SourceEvent> read_image(const fs::path& file, const RigCamera& camera,
                                               cv::Mat& image) {
    std::error_code ignored;
    if (file.empty()) return SourceEvent{"picture_missing", camera.name, "not recorded"};
    if (!fs::exists(file, ignored)) {
      return SourceEvent{"picture_missing", camera.name, file.string()};
    }
    image = read_grey(file);
    if (image.empty()) return SourceEvent{"picture_unreadable", camera.name, file.string()};
    if (image.cols == camera.model.width && image.rows == camera.model.height) return std::nullopt;
    const std::string size = fmt::format("{}: {} x {}", file.string(), image.cols, image.rows);
    image = cv::Mat();
    return SourceEvent{"picture_of_wrong_size", camera.name, size};
  }

  /// Readings up to a frame's stamp that were not handed out yet.
  template <class Reading>
  static void hand_out(const std::vector<Reading>& readings, std::size_t& next, Stamp until,
                       std::vector<Reading>& out) {
    while (next < readings.size() && readings[next].stamp <= until) {
      out.push_back(readings[next++]);
    }
  }

  Recording recording_;
  WorkerPool& pool_;
  std::size_t index_ = 0;
  std::size_t next_imu_ = 0;
  std::size_t next_wheels_ = 0;
  StageTimes times_;
};

/// A data set of ours has its formats side by side, in folders of their names.
fs::path readable_part(const fs::path& folder) {
  if (is_euroc(folder) || is_kitti(folder) || !has_card(folder)) return folder;
  std::error_code ignored;
  for (const char* format : {"euroc", "kitti"}) {
    if (fs::is_directory(folder / format, ignored)) return folder / format;
  }
  return folder;
}

}  // namespace

std::optional<Pose> pose_at(const Trajectory& trajectory, Stamp stamp, Stamp max_gap) {
  const auto after = std::ranges::lower_bound(trajectory, stamp, {}, &StampedPose::stamp);
  if (after != trajectory.end() && after->stamp - stamp <= kSameInstant) return after->pose;
  if (after == trajectory.begin()) return std::nullopt;
  const auto before = std::prev(after);
  if (stamp - before->stamp <= kSameInstant) return before->pose;
  if (after == trajectory.end() || after->stamp - before->stamp > max_gap) return std::nullopt;
  const double share = static_cast<double>(stamp - before->stamp) /
                       static_cast<double>(after->stamp - before->stamp);
  return interpolate(before->pose, after->pose, share);
}

Rig load_rig_for(const fs::path& file, std::size_t cameras) {
  Rig rig = load_rig(file);
  if (rig.cameras.size() > cameras) {
    fail("{}: rig '{}' has {} cameras, the recording has {}", file.string(), rig.name,
         rig.cameras.size(), cameras);
  }
  return rig;
}

Recording open_recording(const fs::path& named, const RecordingOptions& options) {
  std::error_code ignored;
  if (!fs::is_directory(named, ignored)) {
    fail("{}: expected a folder: {}", named.string(), kFormats);
  }
  const fs::path folder = readable_part(named);
  const bool euroc = is_euroc(folder);
  if (!euroc && !is_kitti(folder)) {
    fail("{}: is no recording: expected {}", folder.string(), kFormats);
  }
  Recording recording = euroc ? read_euroc(folder, options) : read_kitti(folder, options);
  recording.name = fs::weakly_canonical(named).filename().string();
  if (recording.name == "mav0") {
    recording.name = fs::weakly_canonical(named).parent_path().filename().string();
  }
  if (recording.frames.empty()) fail("{}: has no images", folder.string());
  if (!options.groundtruth.empty()) {
    recording.truth = read_groundtruth(options.groundtruth, recording);
  }
  check_sizes(recording);
  return recording;
}

std::unique_ptr<FrameSource> play(Recording recording, WorkerPool& pool) {
  return std::make_unique<RecordingSource>(std::move(recording), pool);
}

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/dataset_reader.h"

#include <algorithm>
#include <system_error>

#include "core/util/error.h"
#include "harness/datasets/reading/recorded_images.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr Stamp kSameInstant = 1000;                    // ns
constexpr Stamp kTruthGap = kNanosecondsPerSecond / 4;  // ns

std::optional<SourceEvent> deliver_image(const Recording& recording, const fs::path& file,
                                         const RigCamera& camera, cv::Mat& image) {
  if (file.empty()) return SourceEvent{"picture_missing", camera.name, "not recorded"};
  if (!has_image(recording, file)) {
    return SourceEvent{"picture_missing", camera.name, file.string()};
  }
  try {
    image = read_grey(recording, file);
  } catch (const Error& error) {
    return SourceEvent{"picture_unreadable", camera.name, error.what()};
  }
  if (image.empty()) return SourceEvent{"picture_unreadable", camera.name, file.string()};
  if (image.cols == camera.model.width && image.rows == camera.model.height) return std::nullopt;
  const std::string size = fmt::format("{}: {} x {}", file.string(), image.cols, image.rows);
  image = cv::Mat();
  return SourceEvent{"picture_of_wrong_size", camera.name, size};
}

/// Readings up to a frame's stamp that were not taken yet.
template <class Reading>
void take_readings(const std::vector<Reading>& readings, std::size_t& next, Stamp until,
                   std::vector<Reading>& out) {
  while (next < readings.size() && readings[next].stamp <= until) {
    out.push_back(readings[next++]);
  }
}

}  // namespace

DatasetReader::DatasetReader(Recording recording, WorkerPool& pool)
    : recording_(std::move(recording)), pool_(pool) {}

std::optional<Sample> DatasetReader::next() {
  if (index_ >= recording_.frames.size()) return std::nullopt;
  const RecordedFrame& recorded = recording_.frames[index_];
  Sample sample;
  sample.frame.index = static_cast<std::int64_t>(index_);
  sample.frame.stamp = recorded.stamp;
  sample.frame.image_stamps = recorded.image_stamps;
  sample.events = recorded.events;
  read_images(recorded, sample);
  take_readings(recording_.imu, next_imu_, recorded.stamp, sample.frame.imu);
  take_readings(recording_.wheels, next_wheels_, recorded.stamp, sample.frame.wheels);
  const auto truth = pose_at(recording_.truth, recorded.stamp, kTruthGap);
  sample.truth.known = truth.has_value();
  if (truth) sample.truth.T_world_body = *truth;
  if (!truth && !recording_.truth.empty()) {
    sample.events.push_back({"groundtruth_missing", "groundtruth", "none at this frame's time"});
  }
  ++index_;
  return sample;
}
void DatasetReader::read_images(const RecordedFrame& recorded, Sample& sample) {
  const ScopedTimer timer(times_, "read images");
  const std::size_t cameras = recording_.rig.cameras.size();
  sample.frame.images.resize(cameras);
  std::vector<std::optional<SourceEvent>> faults(cameras);
  pool_.for_each(cameras, [&](std::size_t camera) {
    faults[camera] = deliver_image(recording_, recorded.images[camera],
                                   recording_.rig.cameras[camera], sample.frame.images[camera]);
  });
  for (const auto& fault : faults) {
    if (fault) sample.events.push_back(*fault);
  }
}

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

}  // namespace vinebench::harness

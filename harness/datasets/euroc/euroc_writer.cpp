// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/euroc_writer.h"

#include <fmt/ranges.h>

#include "core/files/files.h"
#include "harness/datasets/euroc/our_files.h"
#include "harness/datasets/euroc/slam_settings.h"
#include "harness/datasets/files/image_codec.h"
#include "harness/datasets/reading/sensor_file.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr const char* kImuHeader =
    "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
    "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n";
constexpr const char* kWheelHeader =
    "#timestamp [ns],front left [rad],front right [rad],rear left [rad],rear right [rad],"
    "front left [rad s^-1],front right [rad s^-1],rear left [rad s^-1],rear right [rad s^-1]\n";
constexpr const char* kTruthHeader =
    "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],"
    "q_RS_z [],v_RS_R_x [m s^-1],v_RS_R_y [m s^-1],v_RS_R_z [m s^-1],b_w_RS_S_x [rad s^-1],"
    "b_w_RS_S_y [rad s^-1],b_w_RS_S_z [rad s^-1],b_a_RS_S_x [m s^-2],b_a_RS_S_y [m s^-2],"
    "b_a_RS_S_z [m s^-2]\n";

std::string format_transform(const Pose& T_BS) {
  const Eigen::Matrix4d T = T_BS.matrix();
  std::string rows;
  for (Eigen::Index row = 0; row < 4; ++row) {
    rows += fmt::format("{}{}, {}, {}, {}", row == 0 ? "[" : ",\n         ", T(row, 0), T(row, 1),
                        T(row, 2), T(row, 3));
  }
  return fmt::format("T_BS:\n  cols: 4\n  rows: 4\n  data: {}]\n", rows);
}

std::string describe_camera(const RigCamera& camera, double rate_hz) {
  const PinholeCamera& lens = camera.model;
  return fmt::format("sensor_type: camera\ncomment: {}\n{}rate_hz: {}\nresolution: [{}, {}]\n{}",
                     camera.name, format_transform(camera.T_body_cam), rate_hz, lens.width,
                     lens.height, sensor_lens(lens));
}

std::string describe_imu(const RecordingNotes& notes) {
  const auto& [gyroscope, accelerometer] = notes.imu;
  return fmt::format(
      "sensor_type: imu\ncomment: inertial unit\n{}rate_hz: {}\ngyroscope_noise_density: {}\n"
      "gyroscope_random_walk: {}\naccelerometer_noise_density: {}\n"
      "accelerometer_random_walk: {}\n",
      format_transform(Pose{}), notes.imu_rate_hz, gyroscope.noise_density,
      gyroscope.bias_random_walk, accelerometer.noise_density, accelerometer.bias_random_walk);
}

std::string line_of(const ImuSample& sample) {
  const Eigen::Vector3d& w = sample.angular_velocity;
  const Eigen::Vector3d& a = sample.specific_force;
  return fmt::format("{},{},{},{},{},{},{}\n", sample.stamp, w.x(), w.y(), w.z(), a.x(), a.y(),
                     a.z());
}

/// As many digits as EuRoC's own stamps have, so that names in order are in order of time.
std::string digits_of(Stamp stamp) {
  return fmt::format("{:019}", stamp);
}

}  // namespace

EurocWriter::EurocWriter(const fs::path& folder, const RecordingNotes& notes, bool colour)
    : mav_(make_folder(folder / "mav0")),
      colour_(colour),
      frames_(folder / kFrameList),
      times_(folder / "times.txt"),
      imu_(make_folder(mav_ / "imu0") / "data.csv"),
      wheels_(make_folder(mav_ / "wheels0") / "data.csv"),
      truth_(make_folder(mav_ / "state_groundtruth_estimate0") / "data.csv") {
  frames_.append(kFrameListHeader);
  imu_.append(kImuHeader);
  if (notes.first_reading) imu_.append(line_of(*notes.first_reading));
  wheels_.append(kWheelHeader);
  truth_.append(kTruthHeader);
  const Rig rig = notes.rig.make();
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const fs::path camera = mav_ / fmt::format("cam{}", i);
    make_folder(camera / "data");
    write_file_atomically(camera / "sensor.yaml", describe_camera(rig.cameras[i], rig.rate_hz));
    cameras_.emplace_back(camera / "data.csv").append("#timestamp [ns],filename\n");
  }
  if (!rig.stereo_pairs.empty()) pair_ = rig.stereo_pairs.front();
  describe(folder, notes);
}

void EurocWriter::describe(const fs::path& folder, const RecordingNotes& notes) const {
  write_our_files(folder, notes);
  write_file_atomically(mav_ / "body.yaml", fmt::format("comment: {}\n", notes.scenario));
  write_file_atomically(mav_ / "imu0/sensor.yaml", describe_imu(notes));
  write_file_atomically(
      mav_ / "state_groundtruth_estimate0/sensor.yaml",
      "sensor_type: visual-inertial\ncomment: true poses\n" + format_transform(Pose{}));
  if (!pair_) return;
  make_folder(folder / "settings");
  for (const SettingsFile& file : slam_settings(notes)) {
    write_file_atomically(folder / "settings" / file.name, file.text);
  }
}

std::vector<FileTask> EurocWriter::files(const std::shared_ptr<const DatasetFrame>& frame) {
  std::vector<FileTask> tasks;
  for (std::size_t i = 0; i < frame->frame.images.size(); ++i) {
    if (frame->frame.images[i].empty()) continue;
    const std::string name = digits_of(frame->frame.image_stamp(i)) + ".png";
    tasks.push_back(camera_image(frame, i, colour_, mav_ / fmt::format("cam{}/data", i) / name));
  }
  return tasks;
}

void EurocWriter::commit(const DatasetFrame& written) {
  const Frame& frame = written.frame;
  const auto has = [&](int camera) {
    return !frame.images.at(static_cast<std::size_t>(camera)).empty();
  };
  for (std::size_t i = 0; i < frame.images.size(); ++i) {
    if (!frame.images[i].empty()) {
      cameras_[i].append(fmt::format("{0},{0}.png\n", digits_of(frame.image_stamp(i))));
    }
  }
  if (pair_ && has(pair_->left) && has(pair_->right)) {
    // Readers of this list take both eyes' images to have this name.
    const Stamp left = frame.image_stamp(static_cast<std::size_t>(pair_->left));
    const bool together = left == frame.image_stamp(static_cast<std::size_t>(pair_->right));
    if (together) times_.append(digits_of(left) + "\n");
  }
  write_readings(frame);
  if (written.truth.known) add_truth(written);
  frames_.append(fmt::format("{}\n", frame.stamp));
}

void EurocWriter::finish() {
  for (const PendingPose& pose : pending_) append_truth(pose.at, *before_, *support_);
  pending_.clear();
}

void EurocWriter::write_readings(const Frame& frame) {
  std::string rows;
  for (const ImuSample& sample : frame.imu) rows += line_of(sample);
  imu_.append(rows);
  rows.clear();
  for (const WheelSample& s : frame.wheels) {
    rows += fmt::format("{},{},{}\n", s.stamp, fmt::join(s.angle, ","), fmt::join(s.velocity, ","));
  }
  wheels_.append(rows);
}

/// The supports are the path's poses, or the frames' own where a source has no path.
void EurocWriter::add_truth(const DatasetFrame& frame) {
  const StampedPose now{frame.frame.stamp, frame.truth.T_world_body};
  biases_.insert(biases_.end(), frame.truth.imu_biases.begin(), frame.truth.imu_biases.end());
  for (const StampedPose& pose : frame.truth.path) add_support(pose);
  if (frame.truth.path.empty()) {
    add_support(now);
  } else if (support_->stamp == now.stamp) {
    pending_.back().at = now;
  } else {
    pending_.push_back({now, *support_});
  }
}

void EurocWriter::add_support(const StampedPose& support) {
  for (const PendingPose& pose : pending_) append_truth(pose.at, pose.from, support);
  before_ = support_.value_or(support);
  pending_.assign(1, {support, *before_});
  support_ = support;
}

/// That of the last inertial reading until then, of the first one before it; zero where unknown.
ImuBias EurocWriter::bias_at(Stamp stamp) {
  while (biases_.size() > 1 && biases_[1].stamp <= stamp) biases_.pop_front();
  return biases_.empty() ? ImuBias() : biases_.front();
}

/// With the mean velocity from one pose to another.
void EurocWriter::append_truth(const StampedPose& at, const StampedPose& from,
                               const StampedPose& to) {
  const double seconds = to_seconds(to.stamp - from.stamp);
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  if (seconds > 0) v = (to.pose.translation - from.pose.translation) / seconds;
  const Eigen::Vector3d& p = at.pose.translation;
  const Eigen::Quaterniond& q = at.pose.rotation;
  const ImuBias bias = bias_at(at.stamp);
  truth_.append(fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", at.stamp, p.x(), p.y(),
                            p.z(), q.w(), q.x(), q.y(), q.z(), v.x(), v.y(), v.z(),
                            fmt::join(bias.angular_velocity, ","),
                            fmt::join(bias.specific_force, ",")));
}

}  // namespace vinebench::harness

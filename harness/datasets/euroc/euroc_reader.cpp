// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/euroc_reader.h"

#include <algorithm>

#include "core/files/input_file.h"
#include "core/util/error.h"
#include "harness/datasets/euroc/our_files.h"
#include "harness/datasets/files/text_table.h"
#include "harness/datasets/reading/groundtruth.h"
#include "harness/datasets/reading/image_association.h"
#include "harness/datasets/reading/kalibr_chain.h"
#include "harness/datasets/reading/reading_order.h"
#include "harness/datasets/reading/sensor_file.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kEurocRate = 20;  // Hz, of EuRoC's cameras
// TUM-VI's calibration, by Kalibr; its cameras have no sensor.yaml.
constexpr const char* kKalibrChain = "dso/camchain.yaml";
constexpr const char* kKalibrNoise = "dso/imu_config.yaml";

/// The folder that contains cam0; the user may name it or its parent.
fs::path sensor_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "mav0", ignored) ? folder / "mav0" : folder;
}

/// cam0, cam1, … without gaps.
std::vector<fs::path> camera_folders(const fs::path& sensors) {
  std::vector<fs::path> folders;
  std::error_code ignored;
  for (int i = 0;; ++i) {
    fs::path camera = sensors / fmt::format("cam{}", i);
    if (!fs::is_directory(camera, ignored)) return folders;
    folders.push_back(std::move(camera));
  }
}

ImageList read_images(const fs::path& folder, bool may_be_empty) {
  ImageList list;
  list.camera = folder.filename().string();
  for (const TableRow& row : read_table(folder / "data.csv")) {
    row.expect_columns(2, "timestamp [ns], filename");
    list.entries.push_back({row.nanoseconds(0), folder / "data" / row.fields[1]});
  }
  if (list.entries.empty() && !may_be_empty) {
    fail("{}: expected a line for each image, found none", (folder / "data.csv").string());
  }
  put_in_order(list);
  return list;
}

/// Our recordings list the frames, because any camera may lack one; otherwise cam0 defines them.
std::vector<Stamp> read_instants(const fs::path& folder, const ImageList& first_camera) {
  const fs::path file = folder / kFrameList;
  return is_present(file) ? read_frame_list(file) : instants_of(first_camera);
}

Rig rig_of_sensors(const fs::path& sensors, const std::vector<fs::path>& folders) {
  Rig rig;
  rig.name = "EuRoC";
  for (const fs::path& folder : folders) {
    const SensorFile sensor(folder / "sensor.yaml");
    rig.cameras.push_back({folder.filename().string(), sensor.camera(), sensor.T_BS()});
    if (rig.cameras.size() == 1) rig.rate_hz = sensor.rate_hz().value_or(0);
  }
  pair_in_order(rig);
  if (const fs::path imu = sensors / "imu0/sensor.yaml"; is_present(imu)) {
    rig.imu = SensorFile(imu).imu_noise();
  }
  return rig;
}

void read_rig(const fs::path& folder, const std::vector<fs::path>& cameras,
              const RecordingOptions& options, Recording& recording) {
  if (!options.rig.empty()) return set_rig(options.rig, cameras.size(), recording);
  const fs::path ours = folder / "rig.yaml";
  if (is_present(ours)) return set_rig(ours, cameras.size(), recording);
  if (cameras.size() < 2) {
    fail("{}: expected a cam1 beside cam0: a stereo pair", sensor_folder(folder).string());
  }
  if (const fs::path chain = folder / kKalibrChain; is_present(chain)) {
    set_rig(chain, cameras.size(), recording);
    if (const fs::path imu = folder / kKalibrNoise; is_present(imu)) {
      recording.rig.imu = SensorFile(imu).imu_noise();
    }
    return;
  }
  recording.rig = rig_of_sensors(sensor_folder(folder), cameras);
}

void read_imu(const fs::path& folder, Recording& recording) {
  if (!is_present(folder / "data.csv")) return;
  Pose T_body_imu;
  if (is_present(folder / "sensor.yaml")) {
    T_body_imu = SensorFile(folder / "sensor.yaml").T_BS();
  }
  for (const TableRow& row : read_table(folder / "data.csv")) {
    row.expect_columns(7, "ns, angular velocity, specific force");
    const auto vector_at = [&](std::size_t first) {
      return Eigen::Vector3d(row.number(first), row.number(first + 1), row.number(first + 2));
    };
    ImuSample sample{row.nanoseconds(0), vector_at(1), vector_at(4)};
    if (T_body_imu.rotation.w() != 1) {
      sample.angular_velocity = T_body_imu.rotation * sample.angular_velocity;
      sample.specific_force = T_body_imu.rotation * sample.specific_force;
    }
    recording.imu.push_back(sample);
  }
  put_in_order(recording.imu, "imu0", recording);
}

/// Our extension: angles and speeds of the four wheels.
void read_wheels(const fs::path& folder, Recording& recording) {
  if (!is_present(folder / "data.csv")) return;
  for (const TableRow& row : read_table(folder / "data.csv")) {
    WheelSample sample;
    const std::size_t wheels = sample.angle.size();
    row.expect_columns(1 + 2 * wheels, "ns, four angles, four speeds");
    sample.stamp = row.nanoseconds(0);
    for (std::size_t i = 0; i < wheels; ++i) {
      sample.angle[i] = row.number(1 + i);
      sample.velocity[i] = row.number(1 + wheels + i);
    }
    recording.wheels.push_back(sample);
  }
  put_in_order(recording.wheels, "wheels0", recording);
}

/// The state estimate if there is one, otherwise motion capture.
Trajectory read_truth(const fs::path& sensors) {
  for (const char* name : {"state_groundtruth_estimate0", "vicon0", "mocap0"}) {
    const fs::path folder = sensors / name;
    if (!is_present(folder / "data.csv")) continue;
    const bool described = is_present(folder / "sensor.yaml");
    const Pose T_body_sensor = described ? SensorFile(folder / "sensor.yaml").T_BS() : Pose{};
    return read_euroc_poses(folder / "data.csv", T_body_sensor);
  }
  return {};
}

}  // namespace

bool is_euroc(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "mav0", ignored) || fs::is_directory(folder / "cam0", ignored);
}

Recording read_euroc(const fs::path& named, const RecordingOptions& options) {
  const fs::path sensors = sensor_folder(named);
  // For a folder ".../mav0" its parent is used.
  const bool inner = sensors == named && fs::weakly_canonical(named).filename() == "mav0";
  const fs::path folder = inner ? fs::weakly_canonical(named).parent_path() : named;
  std::vector<fs::path> cameras = camera_folders(sensors);
  if (cameras.empty()) fail("{}: expected the folders cam0 and cam1", sensors.string());
  Recording recording;
  recording.format = "EuRoC/ASL";
  read_rig(folder, cameras, options, recording);
  recording.T_body_left = recording.rig.cameras.front().T_body_cam;
  cameras.resize(recording.rig.cameras.size());
  const bool frames_are_listed = is_present(folder / kFrameList);
  std::vector<ImageList> lists;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    lists.push_back(read_images(cameras[i], frames_are_listed));
    lists.back().camera = recording.rig.cameras[i].name;
  }
  const std::vector<Stamp> instants = read_instants(folder, lists.front());
  recording.frames = associate_images(lists, instants);
  if (recording.rig.rate_hz <= 0) {
    const Stamp period = median_period(instants);
    recording.rig.rate_hz = period > 0 ? 1 / to_seconds(period) : kEurocRate;
  }
  read_imu(sensors / "imu0", recording);
  read_wheels(sensors / "wheels0", recording);
  if (options.groundtruth.empty()) recording.truth = read_truth(sensors);
  read_tags_and_settings(folder, recording);
  return recording;
}

}  // namespace vinebench::harness

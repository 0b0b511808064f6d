// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "core/util/worker_pool.h"
#include "harness/datasets/open_recording.h"
#include "harness/datasets/reading/dataset_reader.h"
#include "tests/support/test_folder.h"

namespace vinebench::test {

namespace fs = std::filesystem;

inline constexpr int kWidth = 32;
inline constexpr int kHeight = 24;

/// A small image whose grey levels encode camera and number.
inline cv::Mat numbered_image(int camera, int number) {
  return {kHeight, kWidth, CV_8UC1, cv::Scalar(20 * camera + number)};
}

inline void write_image(const fs::path& file, const cv::Mat& image) {
  fs::create_directories(file.parent_path());
  cv::imwrite(file.string(), image);
}

inline void write_text(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  write_file_atomically(file, text);
}

/// A KITTI excerpt without labels and times: two cameras 0.5 m apart, driving forward by 1 m a
/// frame.
inline fs::path write_kitti(const TestFolder& folder, int frames = 5) {
  const fs::path root = folder / "kitti";
  std::string poses;
  for (int i = 0; i < frames; ++i) {
    write_image(root / fmt::format("image_l/{:06}.png", i), numbered_image(0, i));
    write_image(root / fmt::format("image_r/{:06}.png", i), numbered_image(1, i));
    poses += fmt::format("1 0 0 0 0 1 0 0 0 0 1 {}\n", i);
  }
  write_text(root / "poses.txt", poses);
  write_text(root / "calib.txt", "20 0 15 0 0 20 11 0 0 0 1 0\n20 0 15 -10 0 20 11 0 0 0 1 0");
  return root;
}

inline std::string sensor_yaml(double y, const std::string& distortion = "[0, 0, 0, 0]") {
  // The camera looks forward (body x), so T_BS maps z to x, x to -y, y to -z.
  return fmt::format(
      "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n"
      "  data: [0, 0, 1, 0,\n  -1, 0, 0, {},\n  0, -1, 0, 0,\n  0, 0, 0, 1]\nrate_hz: 20\n"
      "resolution: [{}, {}]\ncamera_model: pinhole\nintrinsics: [20, 20, 15, 11] #fu, fv, cu, cv\n"
      "distortion_model: radial-tangential\ndistortion_coefficients: {}\n",
      y, kWidth, kHeight, distortion);
}

/// A camera of a chain of Kalibr, which looks forward from `y` on the inertial unit.
inline std::string kalibr_camera(const std::string& name, double y) {
  // The inverse of sensor_yaml()'s T_BS: x right = -y of the unit, which is at y there.
  return fmt::format(
      "{}:\n  T_cam_imu:\n  - [0, -1, 0, {}]\n  - [0, 0, -1, 0]\n  - [1, 0, 0, 0]\n"
      "  - [0, 0, 0, 1]\n  cam_overlaps: [0]\n  camera_model: pinhole\n"
      "  distortion_coeffs: [0.01, -0.001, 0.002, 0]\n  distortion_model: equidistant\n"
      "  intrinsics: [20, 20, 15, 11]\n  resolution: [{}, {}]\n  rostopic: /{}/image_raw\n",
      name, y, kWidth, kHeight, name);
}

inline constexpr std::int64_t kFirstStamp = 1403715273262142976;
inline constexpr std::int64_t kPeriod = 50'000'000;  // ns

/// Its list, images and sensor.yaml.
inline void write_euroc_camera(const fs::path& root, int camera,
                               const std::vector<std::int64_t>& stamps) {
  const fs::path folder = root / fmt::format("mav0/cam{}", camera);
  std::string list = "#timestamp [ns],filename\r\n";
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const std::string name = fmt::format("{}.png", stamps[i]);
    list += fmt::format("{},{}\r\n", stamps[i], name);
    write_image(folder / "data" / name, numbered_image(camera, static_cast<int>(i)));
  }
  write_text(folder / "data.csv", list);
  write_text(folder / "sensor.yaml", sensor_yaml(camera % 2 == 0 ? 0 : -0.1));
}

inline std::vector<std::int64_t> regular_stamps(int frames) {
  std::vector<std::int64_t> stamps;
  for (int i = 0; i < frames; ++i) stamps.push_back(kFirstStamp + i * kPeriod);
  return stamps;
}

/// Two cameras at 20 Hz, an inertial unit at 200 Hz, true poses 100 times a second at 1 m/s along
/// x.
inline fs::path write_euroc(const TestFolder& folder, int frames = 5) {
  const fs::path root = folder / "euroc";
  for (int camera = 0; camera < 2; ++camera) {
    write_euroc_camera(root, camera, regular_stamps(frames));
  }
  std::string imu = "#timestamp [ns],w,w,w,a,a,a\n";
  for (int i = 0; i < 10 * frames; ++i) {
    imu += fmt::format("{},0.1,0.2,0.3,{},0,9.81\n", kFirstStamp + i * kPeriod / 10, i);
  }
  write_text(root / "mav0/imu0/data.csv", imu);
  std::string truth = "#timestamp,p,p,p,q,q,q,q,v,v,v,b,b,b,b,b,b\n";
  for (int i = 0; i < 5 * frames; ++i) {
    // 3 ms off the frames' stamps
    const std::int64_t stamp = kFirstStamp + 3'000'000 + (i - 1) * 10'000'000;
    const double x = 1e-9 * static_cast<double>(stamp - kFirstStamp);
    truth += fmt::format("{},{},2,3,1,0,0,0,1,0,0,0,0,0,0,0,0\n", stamp, x);
  }
  write_text(root / "mav0/state_groundtruth_estimate0/data.csv", truth);
  return root;
}

/// All samples of a recording.
inline std::vector<Sample> play_all(const fs::path& folder,
                                    const harness::RecordingOptions& options = {}) {
  WorkerPool pool(2);
  harness::DatasetReader reader(harness::open_recording(folder, options), pool);
  std::vector<Sample> samples;
  while (auto sample = reader.next()) samples.push_back(std::move(*sample));
  return samples;
}

/// Number of events by kind.
inline std::map<std::string, int> count_events(const std::vector<Sample>& samples) {
  std::map<std::string, int> counts;
  for (const Sample& sample : samples) {
    for (const SourceEvent& event : sample.events) ++counts[event.event];
  }
  return counts;
}

inline int grey_of(const cv::Mat& image) {
  return image.empty() ? -1 : image.at<std::uint8_t>(0, 0);
}

}  // namespace vinebench::test

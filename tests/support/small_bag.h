// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "harness/datasets/ros2/mcap/mcap_output.h"

namespace vinebench::test {

inline constexpr std::int64_t kBagStart = 5'000'000'000;  // ns, of the first frame
inline constexpr std::int64_t kBagPeriod = 100'000'000;   // ns

/// GCC 12 takes a header in braces within braces for uninitialised.
inline harness::RosHeader header_at(std::int64_t time, const std::string& frame) {
  harness::RosHeader header;
  header.time = time;
  header.frame = frame;
  return header;
}

/// A mount on base_link or another frame.
inline harness::RosTransform mount_of(const std::string& child, const harness::RosPose& pose,
                                      const std::string& parent = "base_link") {
  harness::RosTransform mount;
  mount.header = header_at(kBagStart, parent);
  mount.child = child;
  mount.pose = pose;
  return mount;
}

/// A camera of a small bag: 32 x 16 pixels, all of the number of their frame, plus `first`.
struct BagCameraSpec {
  std::string topic = "/left/image_rect";
  std::string info = "/left/camera_info";
  std::string frame = "left_optical_frame";
  double shift = 0;  ///< P[3]
  int first = 0;
};

inline harness::RosCameraInfo small_info(const BagCameraSpec& spec, std::int64_t time) {
  harness::RosCameraInfo info;
  info.header = header_at(time, spec.frame);
  info.width = 32;
  info.height = 16;
  info.D = {0, 0, 0, 0, 0};
  info.K = {20, 0, 15.5, 0, 20, 7.5, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {20, 0, 15.5, spec.shift, 0, 20, 7.5, 0, 0, 0, 1, 0};
  return info;
}

/// A rectified pair whose baseline is 0.1 m: P[3] = -20 px times 0.1 m.
inline std::vector<BagCameraSpec> small_pair() {
  return {{}, {"/right/image_rect", "/right/camera_info", "right_optical_frame", -2, 100}};
}

/// The images and calibrations of some frames.
inline void write_images(harness::RosOutput& out, const std::vector<BagCameraSpec>& cameras,
                         int frames = 3) {
  for (int i = 0; i < frames; ++i) {
    const std::int64_t time = kBagStart + i * kBagPeriod;
    for (const BagCameraSpec& spec : cameras) {
      const std::string pixels(32 * 16, static_cast<char>(spec.first + i));
      out.write(spec.topic,
                harness::RosImage{header_at(time, spec.frame), 32, 16, "mono8", pixels});
      out.write(spec.info, small_info(spec, time));
    }
    out.end_chunk();
  }
}

/// The cameras' axes (x right, y down, z ahead) on a body (x ahead, y left, z up).
inline harness::RosPose optical_at(double x, double y, double z) {
  return {{x, y, z}, {-0.5, 0.5, -0.5, 0.5}};
}

}  // namespace vinebench::test

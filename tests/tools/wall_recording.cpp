// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/euroc_sink.h"
#include "tests/support/synthetic_texture.h"

// Writes FOLDER, an EuRoC recording of a textured wall 2 m ahead of a pair with 0.1 m of baseline:
// 200 px * 0.1 m / 2 m = 10 px of disparity. The pair moves 20 mm to its right a frame: 2 px.

namespace {

constexpr int kFrames = 12;
constexpr int kWidth = 320;
constexpr int kHeight = 200;
constexpr int kDisparity = 10;  // px
constexpr int kShift = 2;       // px a frame
constexpr double kStep = 0.02;  // m a frame

vinebench::RigConfig::Camera camera(const std::string& name, double y) {
  vinebench::RigConfig::Camera camera;
  camera.name = name;
  camera.width = kWidth;
  camera.height = kHeight;
  camera.fx = camera.fy = 200;
  camera.position = {0, y, 0};
  return camera;
}

vinebench::harness::RecordingNotes notes() {
  vinebench::harness::RecordingNotes notes;
  notes.scenario = "wall";
  notes.rig.name = "wall";
  notes.rig.rate_hz = 15;
  notes.rig.cameras = {camera("left", 0), camera("right", -0.1)};
  notes.rig.stereo_pairs = {{"front", "left", "right"}};
  return notes;
}

/// Whole pixels of one wide image, so that each view is exact.
cv::Mat view(int shift) {
  static const cv::Mat wall = vinebench::test::render_image(
      kWidth + kShift * kFrames + kDisparity, kHeight, vinebench::test::SyntheticTexture(3));
  return wall.colRange(shift, shift + kWidth);
}

vinebench::Sample sample(int i) {
  vinebench::Sample sample;
  sample.frame.index = i;
  sample.frame.stamp = vinebench::stamp_of_frame(i, 15);
  sample.frame.images = {view(kShift * i), view(kShift * i + kDisparity)};
  sample.truth.T_world_body.translation = {0, -kStep * i, 0};
  return sample;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  vinebench::harness::EurocSink writer(argv[1], notes());
  for (int i = 0; i < kFrames; ++i) writer.on_tick(sample(i), {});
  writer.on_finish({});
}

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/support/synthetic_texture.h"

// Writes FOLDER/left/000000.png … and right/: images of a frontal plane for the rig of
// examples/feed_images. The plane is 2.4 m away, so that 0.12 m of baseline at 400 px is 20 px; the
// rig moves 12 mm to its right a frame, which is 2 px.
int main(int argc, char** argv) {
  if (argc != 2) return 1;
  constexpr int kFrames = 20;
  constexpr int kDisparity = 20;  // px
  constexpr int kStep = 2;        // px
  const std::filesystem::path folder = argv[1];
  const vinebench::test::SyntheticTexture texture(1);
  const cv::Mat plane =
      vinebench::test::render_image(640 + kDisparity + kStep * kFrames, 400, texture);
  for (const auto& [camera, shift] : {std::pair{"left", 0}, {"right", kDisparity}}) {
    std::filesystem::create_directories(folder / camera);
    for (int i = 0; i < kFrames; ++i) {
      const std::string number = std::to_string(1000000 + i).substr(1);
      const cv::Mat seen = plane(cv::Rect(shift + kStep * i, 0, 640, 400));
      if (!cv::imwrite((folder / camera / (number + ".png")).string(), seen)) return 1;
    }
  }
}

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <slam/slam.h>

#include <cstdio>
#include <opencv2/imgcodecs.hpp>

using namespace vinebench;

/// Reads FOLDER/left/000000.png, FOLDER/right/000000.png and so on, and prints the position of the
/// left camera.
int main(int argc, char** argv) try {
  const std::string folder = argc == 2 ? argv[1] : throw Error("usage: feed_images FOLDER");
  const PinholeCamera lens{640, 400, 400, 400, 319.5, 199.5};  // width, height, fx, fy, cx, cy, px
  const Rig rig = Rig::stereo(lens, 0.12);  // rectified, the cameras 0.12 m apart
  WorkerPool threads(2);                    // the number changes no result
  const auto slam = slam::make_slam(slam::SlamConfig{}, rig, {}, threads);

  Frame frame;
  for (;; ++frame.index) {
    frame.stamp = stamp_of_frame(frame.index, 15);  // ns
    frame.images.clear();
    for (const char* camera : {"left", "right"}) {
      const std::string file = fmt::format("{}/{}/{:06}.png", folder, camera, frame.index);
      frame.images.push_back(cv::imread(file, cv::IMREAD_GRAYSCALE));
    }
    if (frame.images[0].empty()) break;
    const Estimate estimate = slam->process(frame);
    if (!estimate.T_map_body) continue;  // not started, or lost
    const Eigen::Vector3d p = estimate.T_map_body->translation;
    std::printf("%s %.4f %.4f %.4f\n", format_seconds(frame.stamp).c_str(), p.x(), p.y(), p.z());
  }
  write_tum(slam->finish().trajectory, folder + "/trajectory.tum");
} catch (const std::exception& error) {
  std::fprintf(stderr, "feed_images: %s\n", error.what());
  return 1;
}

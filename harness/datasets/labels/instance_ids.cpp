// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/labels/instance_ids.h"

#include "core/util/error.h"

namespace vinebench::harness {
std::int32_t instance_id(const SceneIndex& scene, std::int32_t number) {
  constexpr std::int32_t kRover = 1;
  constexpr std::int32_t kMost = 0xffffff;
  switch (scene.thing(number)) {
    case Thing::kNone:
    case Thing::kGround:
    case Thing::kCover:
      return 0;
    case Thing::kRover:
      return kRover;
    default:
      break;
  }
  if (number > kMost) fail("instances: number {} does not fit into 24 bits", number);
  return number;
}

cv::Mat instance_ids(const SceneIndex& scene, const cv::Mat& numbers) {
  cv::Mat ids(numbers.size(), CV_32SC1);
  std::int32_t last = 0;
  std::int32_t id = instance_id(scene, last);
  for (int y = 0; y < numbers.rows; ++y) {
    const auto* number = numbers.ptr<std::int32_t>(y);
    auto* to = ids.ptr<std::int32_t>(y);
    for (int x = 0; x < numbers.cols; ++x) {
      if (number[x] != last) id = instance_id(scene, last = number[x]);
      to[x] = id;
    }
  }
  return ids;
}

cv::Mat id_colours(const cv::Mat& ids) {
  cv::Mat colours(ids.size(), CV_8UC3);
  for (int y = 0; y < ids.rows; ++y) {
    const auto* id = ids.ptr<std::int32_t>(y);
    auto* colour = colours.ptr<cv::Vec3b>(y);
    for (int x = 0; x < ids.cols; ++x) {
      colour[x] = {static_cast<std::uint8_t>(id[x]), static_cast<std::uint8_t>(id[x] >> 8),
                   static_cast<std::uint8_t>(id[x] >> 16)};
    }
  }
  return colours;
}

}  // namespace vinebench::harness

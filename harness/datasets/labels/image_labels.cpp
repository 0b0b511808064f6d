// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/labels/image_labels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <utility>

#include "harness/datasets/labels/instance_ids.h"

namespace vinebench::harness {
namespace {

constexpr double kNearest = 0.03;  // m in front of the camera; nearer points are not in the image

// The low byte of a panoptic id that is not a bunch: plants have far fewer bunches.
constexpr std::int32_t kTrunkPart = 253;
constexpr std::int32_t kCanePart = 254;
constexpr std::int32_t kLeafPart = 255;
constexpr std::int32_t kRoverSegment = 200;  // below 256, as the categories' own ids of stuff

using Key = std::pair<Category, std::int32_t>;  // and the thing's number, 0 for stuff

std::int32_t whole_of(std::int32_t number) {
  return number & ~255;
}

Key key_of(std::uint8_t label, std::int32_t number) {
  const Category category = category_of(static_cast<Label>(label));
  if (!is_thing(category)) return {category, 0};
  return {category, category == Category::kBunch ? number : whole_of(number)};
}

std::int32_t segment_of(const Key& key, const SceneIndex& scene) {
  const auto& [category, number] = key;
  switch (category) {
    case Category::kRover:
      return kRoverSegment;
    case Category::kTrunk:
      return instance_id(scene, number) | kTrunkPart;
    case Category::kCane:
      return instance_id(scene, number) | kCanePart;
    case Category::kLeaf:
      return instance_id(scene, number) | kLeafPart;
    default:
      return is_thing(category) ? instance_id(scene, number) : category_id(category);
  }
}

/// Masks by category and number, in one column-wise pass; sets the pixels' segments.
std::map<Key, Runs> find_masks(const RenderedImage& image, const SceneIndex& scene,
                               cv::Mat& segments) {
  std::map<Key, Runs> masks;
  const cv::Mat labels = image.labels.t();
  const cv::Mat numbers = image.instances.t();
  cv::Mat columns(labels.size(), CV_32SC1);
  const auto pixels = static_cast<std::int64_t>(labels.total());
  const auto* label = labels.ptr<std::uint8_t>();
  const auto* number = numbers.ptr<std::int32_t>();
  auto* segment = columns.ptr<std::int32_t>();
  for (std::int64_t begin = 0, end = 0; begin < pixels; begin = end) {
    while (end < pixels && label[end] == label[begin] && number[end] == number[begin]) ++end;
    const Key key = key_of(label[begin], number[begin]);
    Runs& runs = masks[key];
    if (!runs.empty() && runs.back().end == begin) {
      runs.back().end = end;
    } else {
      runs.push_back({begin, end});
    }
    std::fill(segment + begin, segment + end, segment_of(key, scene));
  }
  segments = columns.t();
  return masks;
}

bool has_outline(Category category) {
  return category == Category::kBunch || category == Category::kPlant ||
         category == Category::kPost || category == Category::kTag || category == Category::kBox ||
         category == Category::kPerson || category == Category::kOccluder;
}

void measure_outline(const TruthView& view, const SceneIndex& scene, ThingLabel& thing) {
  const std::vector<Eigen::Vector3d> points = scene.points(thing.number);
  if (points.empty()) return;
  const Pose T_cam_world = view.T_world_cam.inverse();
  std::size_t inside = 0;
  std::size_t shown = 0;
  for (const Eigen::Vector3d& p_world : points) {
    const Eigen::Vector3d p = T_cam_world * p_world;
    if (p.z() < kNearest) continue;
    const Eigen::Vector2d at = view.camera.project(p);
    if (!view.camera.contains(at)) continue;
    ++inside;
    const auto x = std::min(static_cast<int>(std::lround(at.x())), view.camera.width - 1);
    const auto y = std::min(static_cast<int>(std::lround(at.y())), view.camera.height - 1);
    const auto seen = view.image.instances.at<std::int32_t>(y, x);
    const bool part = thing.category == Category::kBunch;
    if ((part ? seen : whole_of(seen)) == thing.number) ++shown;
  }
  const auto total = static_cast<double>(points.size());
  thing.truncation = 1 - static_cast<double>(inside) / total;
  thing.visibility = inside == 0 ? 0 : static_cast<double>(shown) / static_cast<double>(inside);
}

/// All parts of one plant as one thing.
std::vector<ThingLabel> whole_plants(const std::vector<ThingLabel>& parts,
                                     const SceneIndex& scene) {
  std::map<std::int32_t, std::vector<Runs>> masks;
  for (const ThingLabel& part : parts) {
    if (scene.thing(part.number) == Thing::kVine) masks[whole_of(part.number)].push_back(part.mask);
  }
  std::vector<ThingLabel> plants;
  for (auto& [number, runs] : masks) {
    ThingLabel plant;
    plant.category = Category::kPlant;
    plant.number = number;
    plant.mask = united(std::move(runs));
    plants.push_back(std::move(plant));
  }
  return plants;
}

}  // namespace

ImageLabels label_things(const TruthView& view, const SceneIndex& scene) {
  ImageLabels labels;
  for (auto& [key, runs] : find_masks(view.image, scene, labels.segments)) {
    const std::int32_t segment = segment_of(key, scene);
    if (is_thing(key.first)) {
      labels.things.push_back({key.first, key.second, segment, std::move(runs), {}, {}});
    } else {
      labels.stuff.push_back({key.first, segment, std::move(runs)});
    }
  }
  const std::vector<ThingLabel> plants = whole_plants(labels.things, scene);
  labels.things.insert(labels.things.end(), plants.begin(), plants.end());
  std::ranges::stable_sort(
      labels.things, {}, [](const ThingLabel& thing) { return Key(thing.category, thing.number); });
  for (ThingLabel& thing : labels.things) {
    if (has_outline(thing.category)) measure_outline(view, scene, thing);
  }
  return labels;
}

}  // namespace vinebench::harness

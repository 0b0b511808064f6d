// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/bag_cameras.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kMostCameras = 64;  // of a rig
constexpr std::string_view kCompressed = "/compressed";

/// Topics of one camera, the best for a replay first.
constexpr std::array<std::string_view, 8> kKinds{"image_rect", "image_rect_raw", "image_rect_color",
                                                 "image_raw",  "image_mono",     "image_color",
                                                 "image",      "image_rect_mono"};

/// What names of a pair's two cameras differ in.
constexpr std::array<std::array<std::string_view, 2>, 5> kSides{{{"left", "right"},
                                                                 {"infra1", "infra2"},
                                                                 {"cam0", "cam1"},
                                                                 {"cam2", "cam3"},
                                                                 {"cam_l", "cam_r"}}};

bool is_compressed(const std::string& topic) {
  return topic.ends_with(kCompressed);
}

std::string without_compressed(const std::string& topic) {
  return is_compressed(topic) ? topic.substr(0, topic.size() - kCompressed.size()) : topic;
}

/// "/left" of "/left/image_rect/compressed".
std::string namespace_of(const std::string& topic) {
  const std::string raw = without_compressed(topic);
  const std::size_t slash = raw.rfind('/');
  return slash == std::string::npos ? "" : raw.substr(0, slash);
}

std::string kind_of(const std::string& topic) {
  const std::string raw = without_compressed(topic);
  return raw.substr(raw.rfind('/') + 1);
}

/// The place in the order of preference; raw before compressed. Empty for what is no such image.
std::optional<std::size_t> rank_of(const std::string& topic, const BagImages& images) {
  static const std::array<std::string_view, 7> grey_or_colour{"mono8", "8UC1",  "rgb8", "bgr8",
                                                              "8UC3",  "rgba8", "bgra8"};
  const bool compressed = images.type.ends_with("CompressedImage");
  const bool usable = compressed ? images.coding.find("Depth") == std::string::npos
                                 : std::ranges::count(grey_or_colour, images.coding) > 0;
  const auto kind = std::ranges::find(kKinds, kind_of(topic));
  if (!usable || kind == kKinds.end()) return std::nullopt;
  return 2 * static_cast<std::size_t>(kind - kKinds.begin()) + (compressed ? 1 : 0);
}

BagCamera camera_of(const std::string& topic) {
  const std::string name_space = namespace_of(topic);
  BagCamera camera;
  camera.name = name_space.substr(name_space.rfind('/') + 1);
  camera.topic = topic;
  camera.info = name_space + "/camera_info";
  camera.rectified = kind_of(topic).find("rect") != std::string::npos;
  return camera;
}

/// Two cameras of one name get their whole namespaces as names, and those without one their topics.
void make_names_unique(std::vector<BagCamera>& cameras) {
  const std::vector<BagCamera> before = cameras;
  for (BagCamera& camera : cameras) {
    if (camera.name.empty()) camera.name = camera.topic;
    if (std::ranges::count(before, camera.name, &BagCamera::name) > 1) camera.name = camera.topic;
  }
}

/// The best topic of each namespace, in the order of these.
std::vector<BagCamera> best_cameras(const BagContents& contents) {
  std::map<std::string, std::pair<std::size_t, std::string>> best;  // rank and topic
  for (const auto& [topic, images] : contents.images) {
    const auto rank = rank_of(topic, images);
    if (!rank) continue;
    const auto [place, first] = best.try_emplace(namespace_of(topic), *rank, topic);
    if (!first && *rank < place->second.first) place->second = {*rank, topic};
  }
  std::vector<BagCamera> cameras;
  for (const auto& [name_space, topic] : best) cameras.push_back(camera_of(topic.second));
  return cameras;
}

/// Whether the second topic is the first one with its last "left" as "right" or the like.
bool is_pair(const BagCamera& left, const BagCamera& right) {
  for (const auto& [l, r] : kSides) {
    std::string name = namespace_of(left.topic);
    const std::size_t at = name.rfind(l);
    if (at == std::string::npos) continue;
    if (name.replace(at, l.size(), r) == namespace_of(right.topic)) return true;
  }
  return false;
}

/// "back" of "/back_left" and "/back_right", else a name that no other pair has.
std::string name_of_pair(const BagCamera& left, const std::vector<StereoPair>& before) {
  const std::string name = left.name.substr(0, left.name.rfind("_left"));
  const auto is_new = [&](const std::string& wanted) {
    return std::ranges::count(before, wanted, &StereoPair::name) == 0;
  };
  if (name != left.name && is_new(name)) return name;
  for (const char* usual : {"front", "back"}) {
    if (is_new(usual)) return usual;
  }
  return left.topic;
}

/// Pairs by their names, and the cameras of pairs before the others.
BagCameras paired(const std::vector<BagCamera>& found) {
  BagCameras result;
  std::vector<bool> taken(found.size(), false);
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t j = 0; j < found.size(); ++j) {
      if (taken[i] || taken[j] || !is_pair(found[i], found[j])) continue;
      const auto first = static_cast<int>(result.cameras.size());
      result.pairs.push_back({name_of_pair(found[i], result.pairs), first, first + 1});
      result.cameras.insert(result.cameras.end(), {found[i], found[j]});
      taken[i] = taken[j] = true;
    }
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!taken[i]) result.cameras.push_back(found[i]);
  }
  return result;
}

std::string list_of_topics(const BagContents& contents) {
  constexpr std::size_t kMost = 30;
  std::vector<std::string> texts;
  for (const auto& [topic, type] : contents.topics) {
    if (texts.size() < kMost) texts.push_back(fmt::format("{} ({})", topic, type));
  }
  if (contents.topics.size() > kMost) texts.emplace_back("…");
  return texts.empty() ? "no messages" : fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

void fault_without_pair(const BagContents& contents) {
  fail(
      "{}: expected a stereo pair, such as images on /left/image_rect and /right/image_rect, or "
      "--topics LEFT,RIGHT; found {}{}",
      contents.names.front().string(), list_of_topics(contents),
      contents.cut_off.empty() ? "" : "; " + contents.cut_off);
}

BagCameras choose_bag_cameras(const BagContents& contents, const std::vector<std::string>& topics) {
  BagCameras chosen;
  for (const std::string& topic : topics) {
    if (!contents.images.contains(topic)) {
      fail("{}: --topics: expected topics of images, found '{}' among {}",
           contents.names.front().string(), topic, list_of_topics(contents));
    }
    if (std::ranges::count(topics, topic) > 1) fail("--topics: '{}' is named twice", topic);
    chosen.cameras.push_back(camera_of(topic));
  }
  if (topics.empty()) {
    const std::vector<BagCamera> found = best_cameras(contents);
    if (found.size() > kMostCameras) {
      fail("{}: expected at most {} cameras, found {}: --topics chooses some",
           contents.names.front().string(), kMostCameras, found.size());
    }
    chosen = paired(found);
  } else {
    if (topics.size() >= 2) chosen.pairs.push_back({"front", 0, 1});
    if (topics.size() >= 4) chosen.pairs.push_back({"back", 2, 3});
  }
  if (chosen.cameras.empty()) fault_without_pair(contents);
  make_names_unique(chosen.cameras);
  return chosen;
}

void order_by_rig(const Rig& rig, std::vector<BagCamera>& cameras) {
  std::vector<BagCamera> ordered;
  for (const RigCamera& camera : rig.cameras) {
    const auto found = std::ranges::find(cameras, camera.name, &BagCamera::name);
    if (found == cameras.end()) return;
    ordered.push_back(*found);
  }
  cameras = std::move(ordered);
}

}  // namespace vinebench::harness

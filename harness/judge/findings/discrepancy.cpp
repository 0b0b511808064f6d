// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/findings/discrepancy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/angle.h"

namespace vinebench::harness {
namespace {

constexpr double kLeast = 0.1;  // px

/// Errors of two cameras are one if they agree to this share of the larger.
constexpr double kAlike = 0.1;

using List = std::vector<Discrepancy>;

bool alike(double a, double b) {
  return std::abs(a - b) <= kAlike * std::max(std::abs(a), std::abs(b));
}

double percent(double told, double truth) {
  return 100 * (told / truth - 1);
}

const RigCamera& camera_of(const Rig& rig, int index) {
  return rig.cameras[static_cast<std::size_t>(index)];
}

/// Of one camera's lens.
List lens_discrepancies(const RigCamera& told, const RigCamera& truth) {
  const PinholeCamera& a = told.model;
  const PinholeCamera& b = truth.model;
  const double wide = percent(a.fx, b.fx);
  const double high = percent(a.fy, b.fy);
  List list;
  if (alike(wide, high)) {
    list.push_back({told.name, "focal length", wide, "%", std::abs(wide) / 100 * b.fx});
  } else {
    list.push_back({told.name, "focal length, x", wide, "%", std::abs(wide) / 100 * b.fx});
    list.push_back({told.name, "focal length, y", high, "%", std::abs(high) / 100 * b.fy});
  }
  list.push_back({told.name, "principal point, x", a.cx - b.cx, "px", std::abs(a.cx - b.cx)});
  list.push_back({told.name, "principal point, y", a.cy - b.cy, "px", std::abs(a.cy - b.cy)});
  return list;
}

/// Of where `told` stands and looks.
List pose_discrepancies(const std::string& of, const Pose& told, const Pose& truth, double focal) {
  const double moved = (told.translation - truth.translation).norm();
  const double turned = angle_of(truth.rotation.conjugate() * told.rotation);
  return {{of, "position", 1000 * moved, "mm", moved * focal},
          {of, "orientation", turned / kRadiansPerDegree, "deg", turned * focal}};
}

/// Of where a pair's middle stands and its left camera looks, and of its cameras to each other.
List pair_discrepancies(const StereoPair& pair, const Rig& told, const Rig& truth) {
  const std::string of = pair.name + " pair";
  const double focal = camera_of(truth, pair.left).model.fx;
  const auto middle = [&pair](const Rig& rig) {
    const Pose& left = camera_of(rig, pair.left).T_body_cam;
    const Pose& right = camera_of(rig, pair.right).T_body_cam;
    return Pose{left.rotation, 0.5 * (left.translation + right.translation)};
  };
  const auto relative = [&pair](const Rig& rig) {
    return camera_of(rig, pair.left).T_body_cam.rotation.conjugate() *
           camera_of(rig, pair.right).T_body_cam.rotation;
  };
  List list = pose_discrepancies(of, middle(told), middle(truth), focal);
  const double longer = percent(told.baseline(pair), truth.baseline(pair));
  const double shift = std::abs(told.baseline(pair) - truth.baseline(pair)) * focal;
  list.push_back({of, "baseline", longer, "%", shift});
  const double turned = angle_of(relative(truth).conjugate() * relative(told));
  list.push_back({of, "cameras to each other", turned / kRadiansPerDegree, "deg", turned * focal});
  return list;
}

bool same_calibration(const RigCamera& a, const RigCamera& b) {
  List list = lens_discrepancies(a, b);
  const List pose = pose_discrepancies({}, a.T_body_cam, b.T_body_cam, b.model.fx);
  list.insert(list.end(), pose.begin(), pose.end());
  return std::ranges::all_of(list, [](const Discrepancy& d) { return d.pixels < kLeast; });
}

/// The camera that has the calibration of camera `i`, and the other way round.
std::optional<std::size_t> swapped_with(std::size_t i, const Rig& told, const Rig& truth) {
  if (same_calibration(told.cameras[i], truth.cameras[i])) return std::nullopt;
  for (std::size_t k = 0; k < told.cameras.size(); ++k) {
    if (k != i && same_calibration(told.cameras[i], truth.cameras[k]) &&
        same_calibration(told.cameras[k], truth.cameras[i])) {
      return k;
    }
  }
  return std::nullopt;
}

/// Takes the errors that several have in common together under one name.
void merge(List& list, const std::vector<std::string>& members, const std::string& name) {
  const List before = list;
  for (const Discrepancy& first : before) {
    if (members.empty() || first.of != members.front()) continue;
    std::vector<std::string> found;
    for (const Discrepancy& other : before) {
      const bool member = std::ranges::find(members, other.of) != members.end();
      if (member && other.what == first.what && alike(other.size, first.size)) {
        found.push_back(other.of);
      }
    }
    if (found.size() != members.size() || members.size() < 2) continue;
    std::erase_if(list, [&](const Discrepancy& d) {
      return d.what == first.what && d.of != members.front() &&
             std::ranges::find(members, d.of) != members.end();
    });
    for (Discrepancy& kept : list) {
      if (kept.what == first.what && kept.of == members.front()) kept.of = name;
    }
  }
}

}  // namespace

std::vector<Discrepancy> rig_discrepancies(const Rig& told, const Rig& truth) {
  List list;
  std::vector<char> paired(told.cameras.size(), 0);
  std::vector<char> swapped(told.cameras.size(), 0);
  for (std::size_t i = 0; i < told.cameras.size(); ++i) {
    const auto other = swapped_with(i, told, truth);
    if (!other) continue;
    swapped[i] = 1;
    if (*other < i) continue;
    list.push_back({told.cameras[i].name + " and " + told.cameras[*other].name, "swapped", 0, "",
                    truth.cameras[i].model.fx});
  }
  for (const StereoPair& pair : told.stereo_pairs) {
    const auto left = static_cast<std::size_t>(pair.left);
    const auto right = static_cast<std::size_t>(pair.right);
    paired[left] = paired[right] = 1;
    if (swapped[left] || swapped[right]) continue;
    const List found = pair_discrepancies(pair, told, truth);
    list.insert(list.end(), found.begin(), found.end());
  }
  for (std::size_t i = 0; i < told.cameras.size(); ++i) {
    if (swapped[i]) continue;
    List found = lens_discrepancies(told.cameras[i], truth.cameras[i]);
    if (!paired[i]) {
      const List pose = pose_discrepancies(told.cameras[i].name, told.cameras[i].T_body_cam,
                                           truth.cameras[i].T_body_cam, truth.cameras[i].model.fx);
      found.insert(found.end(), pose.begin(), pose.end());
    }
    list.insert(list.end(), found.begin(), found.end());
  }
  std::erase_if(list, [](const Discrepancy& d) { return !(d.pixels >= kLeast); });
  std::vector<std::string> pairs;
  for (const StereoPair& pair : told.stereo_pairs) {
    pairs.push_back(pair.name + " pair");
    merge(list, {camera_of(told, pair.left).name, camera_of(told, pair.right).name}, pairs.back());
  }
  merge(list, pairs, "all pairs");
  rank(list);
  return list;
}

std::vector<Discrepancy> tag_discrepancies(const std::vector<RegisteredTag>& told,
                                           const std::vector<WorldTag>& truth, double focal) {
  List list;
  for (const RegisteredTag& tag : told) {
    const std::string of = fmt::format("tag {}", tag.id);
    const auto same = [&](const WorldTag& w) { return w.family == tag.family && w.id == tag.id; };
    // Of several with the number, the nearest.
    const WorldTag* standing = nullptr;
    const auto off = [&tag](const WorldTag& w) {
      return (w.T_world_tag.translation - tag.T_world_tag.translation).norm();
    };
    for (const WorldTag& w : truth) {
      if (same(w) && (standing == nullptr || off(w) < off(*standing))) standing = &w;
    }
    if (standing == nullptr) {
      list.push_back({of, "not in the world", 0, "", focal});
      continue;
    }
    const List pose = pose_discrepancies(of, tag.T_world_tag, standing->T_world_tag, focal);
    list.insert(list.end(), pose.begin(), pose.end());
    const double larger = percent(tag.size, standing->size);
    list.push_back({of, "size", larger, "%", std::abs(larger) / 100 * focal});
  }
  std::erase_if(list, [](const Discrepancy& d) { return !(d.pixels >= kLeast); });
  rank(list);
  return list;
}

void rank(std::vector<Discrepancy>& discrepancies) {
  std::ranges::stable_sort(discrepancies, std::ranges::greater{}, &Discrepancy::pixels);
}

std::string text_of(const Discrepancy& d) {
  if (d.unit.empty()) return fmt::format("{}: {}", d.of, d.what);
  if (d.unit == "deg" || d.unit == "mm") {
    return fmt::format("{}: {} {:.2g} {} off", d.of, d.what, d.size, d.unit);
  }
  return fmt::format(
      "{}: {} {:.2g} {} too {}", d.of, d.what, std::abs(d.size), d.unit,
      d.unit == "ms" ? (d.size > 0 ? "late" : "early") : (d.size > 0 ? "large" : "small"));
}

std::string format_discrepancies(const std::vector<Discrepancy>& discrepancies) {
  if (discrepancies.empty()) return {};
  std::string text = "told and not so: ";
  for (std::size_t i = 0; i < discrepancies.size(); ++i) {
    text += (i > 0 ? "; " : "") + text_of(discrepancies[i]);
  }
  return text + "\n";
}

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/placement/plan_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/config/yaml_block.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

constexpr double kScale = 24;    // px a metre
constexpr double kMargin = 2.5;  // m

const char* name_of(sim::WorldConfig::PostSide::Side side) {
  static const std::vector<std::string> names = yaml_names(sim::WorldConfig::PostSide::Side{});
  return names.at(static_cast<std::size_t>(side)).c_str();
}

/// From 0 to 1: blue, yellow, red.
std::string colour_of(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const auto part = [](double x) {
    return static_cast<int>(std::lround(255 * std::clamp(x, 0.0, 1.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", part(0.15 + 1.6 * s),
                     part(0.45 + 0.9 * s - 1.2 * s * s), part(0.85 - 1.6 * s));
}

/// What an SVG shows of the world: x to the right, y upwards.
class Plan {
 public:
  Plan(const sim::WorldLayout& layout, const std::vector<Pose>& poses) {
    for (const sim::RowConfig& row : layout.rows) {
      include(row.start);
      include(row.end);
    }
    for (const Pose& pose : poses) include(pose.translation.head<2>());
  }

  double width() const { return (high_.x() - low_.x() + 2 * kMargin) * kScale; }
  double height() const { return (high_.y() - low_.y() + 2 * kMargin) * kScale; }
  Eigen::Vector2d at(const Eigen::Vector2d& place) const {
    return {(place.x() - low_.x() + kMargin) * kScale, (high_.y() - place.y() + kMargin) * kScale};
  }

 private:
  void include(const Eigen::Vector2d& place) {
    low_ = low_.cwiseMin(place);
    high_ = high_.cwiseMax(place);
  }

  Eigen::Vector2d low_{1e9, 1e9};
  Eigen::Vector2d high_{-1e9, -1e9};
};

std::string line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const std::string& colour,
                 double width) {
  return fmt::format(
      R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}" stroke-width="{}" stroke-linecap="round"/>)"
      "\n",
      a.x(), a.y(), b.x(), b.y(), colour, width);
}

}  // namespace

std::vector<TagCandidate> planned_tags(const std::vector<TagCandidate>& candidates,
                                       const TagPlan& plan) {
  std::vector<TagCandidate> tags;
  for (const std::size_t chosen : plan.chosen) tags.push_back(candidates[chosen]);
  std::ranges::sort(tags, {}, [](const TagCandidate& tag) {
    const auto& post = tag.tag.post.value();
    return std::tuple(post.row, post.index, post.side);
  });
  for (std::size_t i = 0; i < tags.size(); ++i) {
    tags[i].tag.id = tags[i].placed.id = static_cast<int>(i);
  }
  return tags;
}

std::string with_tags(const std::string& text, const std::vector<TagCandidate>& tags) {
  std::string block = "tags:\n";
  for (const TagCandidate& tag : tags) {
    const auto& post = tag.tag.post.value();
    block += fmt::format(
        "  - {{id: {}, size: {}, post: {{row: {}, index: {}, side: {}, height: {}}}}}\n",
        tag.tag.id, tag.tag.size, post.row, post.index, name_of(post.side), post.height);
  }
  return with_block(text, "tags", block);
}

std::string tag_list(const std::vector<TagCandidate>& tags) {
  std::string text = "tag,row,post,side,height_m,x_m,y_m,facing_deg\n";
  for (const TagCandidate& tag : tags) {
    const auto& post = tag.tag.post.value();
    const Pose& pose = tag.placed.T_world_tag;
    const Eigen::Vector3d face = pose.rotation * -Eigen::Vector3d::UnitZ();
    text +=
        fmt::format("{},{},{},{},{:.2f},{:.3f},{:.3f},{:.1f}\n", tag.tag.id, post.row + 1,
                    post.index + 1, name_of(post.side), post.height, pose.translation.x(),
                    pose.translation.y(), std::atan2(face.y(), face.x()) * 180 / std::numbers::pi);
  }
  return text;
}

std::string plan_svg(const sim::WorldConfig& world, const std::vector<Pose>& poses,
                     const std::vector<TagCandidate>& tags, const TagPlan& plan) {
  const sim::WorldLayout layout = sim::lay_out(world);
  const Plan map(layout, poses);
  const double most = *std::ranges::max_element(plan.errors);
  std::string svg = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0:.0f} {1:.0f}" width="{0:.0f}" height="{1:.0f}" font-family="sans-serif">)"
      "\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      map.width(), map.height());
  for (const sim::RowConfig& row : layout.rows) {
    svg += line(map.at(row.start), map.at(row.end), "#9cb88a", 6);
  }
  for (const sim::TrellisPost& post : layout.posts) {
    const Eigen::Vector2d at = map.at(post.foot);
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"#6b5b45\"/>\n", at.x(),
                       at.y());
  }
  for (std::size_t k = 1; k < poses.size(); ++k) {
    svg += line(map.at(poses[k - 1].translation.head<2>()), map.at(poses[k].translation.head<2>()),
                colour_of(plan.errors[k] / most), 3);
  }
  for (const TagCandidate& tag : tags) {
    const Pose& pose = tag.placed.T_world_tag;
    const Eigen::Vector2d at = map.at(pose.translation.head<2>());
    const Eigen::Vector3d face = pose.rotation * -Eigen::Vector3d::UnitZ();
    const Eigen::Vector2d towards = map.at((pose.translation + 0.45 * face).head<2>());
    const Eigen::Vector2d label = map.at((pose.translation + 0.95 * face).head<2>());
    svg += line(at, towards, "black", 2);
    svg += fmt::format(
        R"(<rect x="{:.1f}" y="{:.1f}" width="10" height="10" fill="black"/><text x="{:.1f}" y="{:.1f}" font-size="13" text-anchor="middle">{}</text>)"
        "\n",
        at.x() - 5, at.y() - 5, label.x(), label.y() + 5, tag.tag.id);
  }
  svg += fmt::format(
      R"(<text x="12" y="22" font-size="15">{} tags; 95 % of the poses within {:.0f} mm, predicted; blue 0, red {:.0f} mm</text>)"
      "\n</svg>\n",
      tags.size(), 1e3 * plan.error, 1e3 * most);
  return svg;
}

}  // namespace vinebench::harness

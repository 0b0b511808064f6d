// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sim/plants/grapevine_mesh.h"
#include "sim/plants/plant_painter.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int kCellWidth = 512, kCellHeight = 256;  // px of a plant's cell in the image
constexpr int kSideWidth = 192, kSlabWidth = 64;    // px
constexpr int kRim = 2;                             // px between neighbours
constexpr int kReliefColumns = 4, kReliefRows = 6;

/// The leaves, shoots and bunches of a half of the canopy, split across or along the row.
Grapevine half_of(const Grapevine& plant, bool slab, float sign) {
  const auto mine = [&](const Vector3f& p) {
    return (slab ? p.x() : p.y()) * sign > 0 || (sign > 0 && (slab ? p.x() : p.y()) == 0);
  };
  Grapevine half = plant;
  std::erase_if(half.leaves, [&](const BladePlacement& leaf) {
    return !mine(leaf.foot + 0.4f * leaf.size * leaf.axes.y);
  });
  std::erase_if(half.shoots, [&](const Tube& t) { return !mine(t.path[t.path.size() / 2]); });
  if (slab) half.wood.clear();
  std::erase_if(half.canes, [&](const Tube& t) { return !mine(t.path[t.path.size() / 2]); });
  std::erase_if(half.bunches, [&](const Bunch& bunch) { return !mine(bunch.top); });
  return half;
}

Eigen::AlignedBox3f box_of(const std::vector<Primitive>& parts) {
  Eigen::AlignedBox3f box;
  for (const Primitive& part : parts) {
    for (const Vertex& v : part.vertices) box.extend(v.position);
  }
  return box;
}

/// Mean of the known depths around each grid point, outwards along `sign`; the middle if there is
/// none.
std::vector<float> relief_of(const cv::Mat& depth, float sign) {
  std::vector<float> relief;
  for (int row = 0; row <= kReliefRows; ++row) {
    for (int column = 0; column <= kReliefColumns; ++column) {
      const cv::Point at(column * depth.cols / kReliefColumns, row * depth.rows / kReliefRows);
      const cv::Size reach(depth.cols / kReliefColumns / 2, depth.rows / kReliefRows / 2);
      const cv::Rect near =
          cv::Rect(at.x - reach.width, at.y - reach.height, 2 * reach.width, 2 * reach.height) &
          cv::Rect(0, 0, depth.cols, depth.rows);
      float sum = 0, count = 0;
      for (int y = near.y; y < near.y + near.height; ++y) {
        for (int x = near.x; x < near.x + near.width; ++x) {
          const float d = depth.at<float>(y, x);
          if (std::isnan(d)) continue;
          sum += d;
          ++count;
        }
      }
      relief.push_back(count > 0 ? sign * sum / count : 0.0f);
    }
  }
  return relief;
}

}  // namespace

FarPlants::FarPlants(const std::vector<Grapevine>& plants, const std::vector<Texture>& textures,
                     const std::vector<Material>& materials)
    : plants_(plants), cards_(plants.size()) {
  const int n = static_cast<int>(plants.size());
  const int columns = n <= 2 ? 1 : n <= 8 ? 2 : n <= 32 ? 4 : 8;
  int rows = 1;
  while (rows * columns < n) rows *= 2;
  texture_ = {"foliage",
              cv::Mat(rows * kCellHeight, columns * kCellWidth, CV_8UC4, cv::Scalar::all(0)),
              false};
  for (std::size_t i = 0; i < plants.size(); ++i) paint(i, textures, materials);
}

void FarPlants::paint(std::size_t plant, const std::vector<Texture>& textures,
                      const std::vector<Material>& materials) {
  const int columns = texture_.rgba.cols / kCellWidth;
  const int index = static_cast<int>(plant);
  const cv::Point origin(index % columns * kCellWidth, index / columns * kCellHeight);
  const CanopyLight light(plants_[plant].leaves);
  for (int i = 0; i < 2; ++i) {
    const float sign = i == 0 ? -1.0f : 1.0f;
    const auto at = static_cast<std::size_t>(i);
    const cv::Rect side(origin.x + i * kSideWidth, origin.y, kSideWidth, kCellHeight);
    const cv::Rect slab(origin.x + 2 * kSideWidth + i * kSlabWidth, origin.y, kSlabWidth,
                        kCellHeight);
    cards_[plant].sides.at(at) = paint_card(half_of(plants_[plant], false, sign), light, false,
                                            sign, side, textures, materials);
    cards_[plant].slabs.at(at) = paint_card(half_of(plants_[plant], true, sign), light, true, sign,
                                            slab, textures, materials);
  }
}

FarPlants::Card FarPlants::paint_card(const Grapevine& part, const CanopyLight& light, bool slab,
                                      float sign, const cv::Rect& cell,
                                      const std::vector<Texture>& textures,
                                      const std::vector<Material>& materials) {
  Card card;
  const std::vector<Primitive> parts = mesh_to_paint(part, light);
  const Eigen::AlignedBox3f box = box_of(parts);
  if (box.isEmpty()) return card;
  card.empty = false;
  const int axis = slab ? 1 : 0;
  card.from = {box.min()[axis], box.min().z()};
  card.to = {std::max(box.max()[axis], box.min()[axis] + 1e-3f), box.max().z()};
  card.place = slab ? (box.min().x() + box.max().x()) / 2 : 0;
  const cv::Rect inner(cell.x + kRim, cell.y + kRim, cell.width - 2 * kRim, cell.height - 2 * kRim);
  const Vector3f right = slab ? Vector3f::UnitY() : Vector3f::UnitX();
  const Vector3f towards = sign * (slab ? Vector3f::UnitX() : Vector3f::UnitY());
  const PlantPainting painting =
      paint_plant(parts, textures, materials, {right, towards, card.from, card.to, inner.size()});
  painting.rgba.copyTo(texture_.rgba(inner));
  card.occlusion = painting.occlusion;
  if (!slab) card.relief = relief_of(painting.depth, sign);
  const Vector2f size(static_cast<float>(texture_.rgba.cols),
                      static_cast<float>(texture_.rgba.rows));
  card.cell.from =
      Vector2f(static_cast<float>(inner.x), static_cast<float>(inner.y)).cwiseQuotient(size);
  card.cell.to = Vector2f(static_cast<float>(inner.br().x), static_cast<float>(inner.br().y))
                     .cwiseQuotient(size);
  return card;
}

/// A sheet of columns x rows squares with the canopy's relief.
void FarPlants::add_side(Primitive& to, const Card& card, float sign, int columns, int rows) {
  if (card.empty) return;
  MeshBuilder builder(to);
  const Vector2f span = card.to - card.from;
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const int at =
          row * kReliefRows / rows * (kReliefColumns + 1) + column * kReliefColumns / columns;
      const float u = static_cast<float>(column) / static_cast<float>(columns);
      const float v = static_cast<float>(row) / static_cast<float>(rows);
      // Leaves face all directions: a sheet must not be as bright as a surface that faces the sun.
      const Vector3f normal(column % 2 == 0 ? -0.6f : 0.6f, sign, 0.4f);
      builder.vertex({card.from.x() + u * span.x(), card.relief.at(static_cast<std::size_t>(at)),
                      card.to.y() - v * span.y()},
                     normal.normalized(), card.cell.at(u, v), card.occlusion);
    }
  }
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
    for (std::uint32_t column = 0; column + 1 < stride; ++column) {
      const std::uint32_t a = first + row * stride + column;
      builder.quad(a + stride, a + stride + 1, a + 1, a);
    }
  }
}

void FarPlants::add_slab(Primitive& to, const Card& card) {
  if (card.empty) return;
  MeshBuilder builder(to);
  const float outward = card.place < 0 ? -0.7f : 0.7f;
  const auto corner = [&](float u, float v) {
    // Seen from the aisle, its edge has the light of the canopy's side.
    const Vector3f normal = Vector3f(outward, u > 0.5f ? 0.7f : -0.7f, 0.4f).normalized();
    return builder.vertex({card.place, card.from.x() + u * (card.to - card.from).x(),
                           card.to.y() - v * (card.to - card.from).y()},
                          normal, card.cell.at(u, v), card.occlusion);
  };
  const std::uint32_t a = corner(0, 1), b = corner(1, 1), c = corner(1, 0), d = corner(0, 0);
  builder.quad(a, b, c, d);
}

std::vector<LevelOfDetail> FarPlants::levels(std::size_t plant) const {
  struct Spec {
    double until;
    int columns, rows;  // of a side's sheet
    int wood_stride, wood_sides;
    int bunch_triangles;
  };
  constexpr std::array<Spec, 3> kSpecs{
      {{8, kReliefColumns, kReliefRows, 5, 4, 150}, {20, 2, 3, 15, 3, 0}, {1e9, 1, 1, 9, 0, 0}}};
  std::vector<LevelOfDetail> levels;
  for (const Spec& spec : kSpecs) {
    LevelOfDetail& level = levels.emplace_back(LevelOfDetail{spec.until, {}});
    add_far_wood(level, plants_[plant], spec.wood_stride, spec.wood_sides);
    add_far_bunches(level, plants_[plant], spec.bunch_triangles);
    Primitive foliage;
    foliage.material = kFoliageMaterial;
    for (std::size_t i = 0; i < 2; ++i) {
      add_side(foliage, cards_[plant].sides.at(i), i == 0 ? -1.0f : 1.0f, spec.columns, spec.rows);
      if (plants_[plant].shelter && spec.wood_sides == 0) continue;  // replaced by the tube
      add_slab(foliage, cards_[plant].slabs.at(i));
    }
    if (!foliage.indices.empty()) level.primitives.push_back(std::move(foliage));
  }
  return levels;
}

}  // namespace vinebench::sim

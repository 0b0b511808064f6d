// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/geometry/smooth_normals.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "sim/assets/geometry/weld_table.h"

namespace vinebench::sim {
namespace {

/// Triangles at one position that share a normal.
struct SmoothGroup {
  Eigen::Vector3f first;  ///< unit normal of the triangle that began it
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
};

class NormalSmoother {
 public:
  NormalSmoother(std::size_t corners, const std::function<Eigen::Vector3f(std::size_t)>& position,
                 float sharpest)
      : least_cosine_(std::cos(sharpest)) {
    ids_.reserve(corners);
    WeldTable<Eigen::Vector3f> places;
    for (std::size_t i = 0; i < corners; ++i) {
      // Zero and minus zero are one place.
      ids_.push_back(places.index_of(position(i) + Eigen::Vector3f::Zero()));
    }
    places_ = places.take();
    result_.of_corner.resize(corners);
  }

  CornerNormals run() {
    // Corners by their place: a counting sort.
    std::vector<std::uint32_t> first(places_.size() + 1);
    for (const std::uint32_t id : ids_) ++first[id + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> sorted(ids_.size()), next(first.begin(), first.end() - 1);
    for (std::uint32_t i = 0; i < ids_.size(); ++i) sorted[next[ids_[i]]++] = i;
    for (std::size_t place = 0; place < places_.size(); ++place) {
      smooth(sorted.data() + first[place], sorted.data() + first[place + 1]);
    }
    return std::move(result_);
  }

 private:
  void smooth(const std::uint32_t* begin, const std::uint32_t* end) {
    const std::size_t base = result_.normals.size();
    groups_.clear();
    for (const std::uint32_t* corner = begin; corner != end; ++corner) {
      const Eigen::Vector3f weighted = weighted_normal(*corner);
      const Eigen::Vector3f unit = weighted.stableNormalized();
      const std::size_t group = group_of(unit);
      groups_[group].sum += weighted;
      result_.of_corner[*corner] = static_cast<std::uint32_t>(base + group);
    }
    for (const SmoothGroup& group : groups_) {
      result_.normals.push_back(group.sum.stableNormalized());
    }
  }

  /// At most a dozen directions are 60 degrees apart, so that a place with many triangles is no
  /// slower a triangle than others. A degenerate triangle joins any.
  std::size_t group_of(const Eigen::Vector3f& unit) {
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      SmoothGroup& group = groups_[i];
      if (group.first.isZero()) group.first = unit;
      if (unit.isZero() || group.first.dot(unit) > least_cosine_) return i;
    }
    groups_.push_back({unit});
    return groups_.size() - 1;
  }

  /// The triangle's unit normal times its angle at the corner; zero if it is degenerate.
  Eigen::Vector3f weighted_normal(std::uint32_t corner) const {
    const std::uint32_t triangle = corner / 3 * 3, turn = corner - triangle;
    const auto place = [&](std::uint32_t k) {
      return places_[ids_[triangle + (turn + k) % 3]].cast<double>().eval();
    };
    const Eigen::Vector3d a = place(1) - place(0), b = place(2) - place(0);
    const Eigen::Vector3d across = a.cross(b);
    const double length = across.norm();
    if (!(length > 0)) return Eigen::Vector3f::Zero();
    return (across * (std::atan2(length, a.dot(b)) / length)).cast<float>();
  }

  float least_cosine_;
  std::vector<std::uint32_t> ids_;  ///< place of each corner
  std::vector<Eigen::Vector3f> places_;
  std::vector<SmoothGroup> groups_;
  CornerNormals result_;
};

}  // namespace

CornerNormals smooth_normals(std::size_t corners,
                             const std::function<Eigen::Vector3f(std::size_t)>& position,
                             float sharpest) {
  return NormalSmoother(corners, position, sharpest).run();
}

}  // namespace vinebench::sim

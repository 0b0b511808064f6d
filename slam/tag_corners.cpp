// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tag_corners.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <vector>

namespace vinebench {
namespace {

constexpr double kStep = 0.5;          // px along the profile
constexpr double kMaxReach = 4.0;      // px to either side of the edge
constexpr double kMinContrast = 20.0;  // grey levels
constexpr double kSlopeShare = 0.15;   // of the steepest; flatter than this is noise
constexpr double kMaxMove = 1.5;       // px
constexpr std::size_t kMinPoints = 8;  // on a side

std::optional<double> grey_at(const cv::Mat& grey, const Eigen::Vector2d& p) {
  const int x = static_cast<int>(std::floor(p.x()));
  const int y = static_cast<int>(std::floor(p.y()));
  if (x < 0 || y < 0 || x + 1 >= grey.cols || y + 1 >= grey.rows) return std::nullopt;
  const double fx = p.x() - x;
  const double fy = p.y() - y;
  const auto at = [&](int dx, int dy) {
    return static_cast<double>(grey.at<std::uint8_t>(y + dy, x + dx));
  };
  return (1 - fy) * ((1 - fx) * at(0, 0) + fx * at(1, 0)) +
         fy * ((1 - fx) * at(0, 1) + fx * at(1, 1));
}

/// Where along `outward` (unit) from p the black turns to white: the centroid of the slope.
std::optional<double> find_edge(const cv::Mat& grey, const Eigen::Vector2d& p,
                                const Eigen::Vector2d& outward, double reach) {
  std::vector<double> slopes;
  double last = 0;
  double steepest = 0;
  for (double s = -reach; s <= reach; s += kStep) {
    const auto value = grey_at(grey, p + s * outward);
    if (!value) return std::nullopt;
    if (s > -reach) {
      slopes.push_back(*value - last);
      steepest = std::max(steepest, slopes.back());
    }
    last = *value;
  }
  double sum = 0;
  double moment = 0;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    if (slopes[i] < kSlopeShare * steepest) continue;
    sum += slopes[i];
    moment += slopes[i] * (-reach + kStep * (static_cast<double>(i) + 0.5));
  }
  if (sum < kMinContrast) return std::nullopt;
  return moment / sum;
}

/// A line of the plane z = 1 as homogeneous coordinates.
std::optional<Eigen::Vector3d> fit_side(const cv::Mat& grey, const PinholeCamera& model,
                                        const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                        const Eigen::Vector2d& outward, double reach) {
  // The ends are left out: there the neighbouring side rounds the edge off.
  const double length = (to - from).norm();
  const double margin = reach + 2;
  std::vector<Eigen::Vector2d> points;
  for (double along = margin; along <= length - margin; along += 1.0) {
    const Eigen::Vector2d p = from + (to - from) * (along / length);
    if (const auto edge = find_edge(grey, p, outward, reach)) {
      points.push_back(model.unproject(p + *edge * outward).head<2>());
    }
  }
  if (points.size() < kMinPoints) return std::nullopt;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& p : points) scatter += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(scatter);
  const Eigen::Vector2d normal = solver.eigenvectors().col(0);
  return Eigen::Vector3d(normal.x(), normal.y(), -normal.dot(mean));
}

}  // namespace

void refine_tag_corners(const cv::Mat& grey, const PinholeCamera& model, double module,
                        std::array<Eigen::Vector2d, 4>& corners) {
  const double reach = kStep * std::floor(std::min(kMaxReach, 0.6 * module) / kStep);
  if (reach < 1.5) return;
  const Eigen::Vector2d centre = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
  std::array<Eigen::Vector3d, 4> sides;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d& to = corners[(i + 1) % 4];
    Eigen::Vector2d outward = Eigen::Vector2d(to.y() - from.y(), from.x() - to.x()).normalized();
    if (outward.dot((from + to) / 2 - centre) < 0) outward = -outward;
    const auto side = fit_side(grey, model, from, to, outward, reach);
    if (!side) return;
    sides[i] = *side;
  }
  std::array<Eigen::Vector2d, 4> refined;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d meeting = sides[(i + 3) % 4].cross(sides[i]);
    refined[i] = model.project(meeting / meeting.z());
    if (!((refined[i] - corners[i]).norm() < kMaxMove)) return;
  }
  corners = refined;
}

}  // namespace vinebench

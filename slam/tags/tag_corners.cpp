// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/tag_corners.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <vector>

namespace vinebench::slam {
namespace {

constexpr double kStep = 0.5;          // px along the profile
constexpr double kMaxReach = 4.0;      // px to either side of the edge
constexpr double kMinContrast = 20.0;  // grey levels
constexpr double kSlopeShare = 0.15;   // of the steepest; flatter than this is noise
constexpr double kMaxMove = 1.5;       // px
constexpr std::size_t kMinPoints = 8;  // on a side
constexpr double kUnrefined = 0.4;     // px, of a corner as AprilTag finds it
constexpr double kLeast = 0.02;        // px, no corner is better than this
/// Profiles a pixel apart share pixels: so many count as one.
constexpr double kNeighbours = 2;

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

/// A side of the tag.
struct Side {
  Eigen::Vector3d line;     ///< homogeneous, in the plane z = 1; the normal is a unit vector
  double end_variance = 0;  ///< px^2, of the line across itself at the side's ends
};

/// The variance of a fitted line at its ends: with n points of variance v along a length L their
/// mean has v / n, the slope v / S with S the sum of their squared distances from the middle, and
/// the ends are L / 2 away from that: v (1 / n + (L / 2)^2 / S).
double end_variance(const Eigen::Vector2d& scatter, double points, double length) {
  const double variance = kNeighbours * scatter[0] / (points - 2);
  return variance * (1 / points + length * length / 4 / scatter[1]);
}

std::optional<Side> fit_side(const cv::Mat& grey, const PinholeCamera& model,
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
  const Eigen::Vector2d scatter_px = model.fx * model.fy * solver.eigenvalues();
  return Side{{normal.x(), normal.y(), -normal.dot(mean)},
              end_variance(scatter_px, static_cast<double>(points.size()), length)};
}

/// Mean variance in x and y of the point where two sides meet, px^2. Errors e of the lines move it
/// by N^-1 e, N the rows of their normals; the columns of N^-1 are 1 / sin long, of the angle
/// between the sides. Seen aslant, corners are the worse for it.
double corner_variance(const Side& a, const Side& b) {
  const Eigen::Vector2d p = a.line.head<2>();
  const Eigen::Vector2d q = b.line.head<2>();
  const double sine = p.x() * q.y() - p.y() * q.x();
  return (a.end_variance + b.end_variance) / (2 * sine * sine);
}

}  // namespace

double refine_tag_corners(const cv::Mat& grey, const PinholeCamera& model, double module,
                          std::array<Eigen::Vector2d, 4>& corners) {
  const double reach = kStep * std::floor(std::min(kMaxReach, 0.6 * module) / kStep);
  if (reach < 1.5) return kUnrefined;
  const Eigen::Vector2d centre = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
  std::array<Side, 4> sides;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d& to = corners[(i + 1) % 4];
    Eigen::Vector2d outward = Eigen::Vector2d(to.y() - from.y(), from.x() - to.x()).normalized();
    if (outward.dot((from + to) / 2 - centre) < 0) outward = -outward;
    const auto side = fit_side(grey, model, from, to, outward, reach);
    if (!side) return kUnrefined;
    sides[i] = *side;
  }
  std::array<Eigen::Vector2d, 4> refined;
  double variance = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d meeting = sides[(i + 3) % 4].line.cross(sides[i].line);
    refined[i] = model.project(meeting / meeting.z());
    if (!((refined[i] - corners[i]).norm() < kMaxMove)) return kUnrefined;
    variance += corner_variance(sides[(i + 3) % 4], sides[i]) / 4;
  }
  corners = refined;
  return std::sqrt(variance + kLeast * kLeast);
}

}  // namespace vinebench::slam

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/tag_corners.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
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
/// Profiles a pixel apart share pixels: so many count as one. Interpolated with shares f and 1 - f,
/// f even in [0, 1], neighbours have a correlation of (1/6) / (2/3) = 1/4, and 1 + 2/4 count as
/// one.
constexpr double kNeighbours = 1.5;
/// Where in a module the border's inner edge is looked for: so many profiles, that far apart.
constexpr int kInModule = 3;
constexpr double kModuleApart = 0.2;
constexpr double kLeastRise = 0.5;     // of the outer edges', of an inner edge
constexpr std::size_t kMinInner = 12;  // profiles of inner edges
constexpr double kMaxBloom = 1;        // px

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

/// Where black turns to white along a profile.
struct Edge {
  double at = 0;    ///< px from the profile's origin: the centroid of the slope
  double rise = 0;  ///< grey levels
};

/// Along `ahead` (unit) from p.
std::optional<Edge> find_edge(const cv::Mat& grey, const Eigen::Vector2d& p,
                              const Eigen::Vector2d& ahead, double reach) {
  std::vector<double> slopes;
  double last = 0;
  double steepest = 0;
  for (double s = -reach; s <= reach; s += kStep) {
    const auto value = grey_at(grey, p + s * ahead);
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
  return Edge{moment / sum, sum};
}

double least_side(const std::array<Eigen::Vector2d, 4>& corners) {
  double shortest = (corners[3] - corners[0]).norm();
  for (std::size_t i = 0; i < 3; ++i) {
    shortest = std::min(shortest, (corners[i + 1] - corners[i]).norm());
  }
  return shortest;
}

/// A side of the tag.
struct Side {
  Eigen::Vector3d line;     ///< homogeneous, in the plane z = 1; the normal is a unit vector
  double end_variance = 0;  ///< px^2, of the line across itself at the side's ends
  double rise = 0;          ///< grey levels from black to white, mean
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
  double rise = 0;
  for (double along = margin; along <= length - margin; along += 1.0) {
    const Eigen::Vector2d p = from + (to - from) * (along / length);
    if (const auto edge = find_edge(grey, p, outward, reach)) {
      points.push_back(model.unproject(p + edge->at * outward).head<2>());
      rise += edge->rise;
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
              end_variance(scatter_px, static_cast<double>(points.size()), length),
              rise / static_cast<double>(points.size())};
}

/// Takes the unit square, (0, 0), (1, 0), (1, 1) and (0, 1), to these corners (Heckbert,
/// "Fundamentals of Texture Mapping and Image Warping", 1989).
Eigen::Matrix3d homography_of(const std::array<Eigen::Vector2d, 4>& corners) {
  const Eigen::Vector2d sum = corners[0] - corners[1] + corners[2] - corners[3];
  Eigen::Matrix2d sides;
  sides << corners[1] - corners[2], corners[3] - corners[2];
  const Eigen::Vector2d far = sides.inverse() * sum;
  Eigen::Matrix3d H;
  H << corners[1] - corners[0] + far.x() * corners[1],
      corners[3] - corners[0] + far.y() * corners[3], corners[0], far.x(), far.y(), 1;
  return H;
}

/// A point of side i of the unit square, so far along it and so deep inside.
Eigen::Vector2d in_square(std::size_t side, double along, double depth) {
  switch (side) {
    case 0:
      return {along, depth};
    case 1:
      return {1 - depth, along};
    case 2:
      return {1 - along, 1 - depth};
    default:
      return {depth, 1 - along};
  }
}

/// By how much white has spread over black at each edge.
struct Bloom {
  double width = 0;     ///< px
  double variance = 0;  ///< px^2
};

/// A camera's encoding and the print move the edge between white and black, as a rule towards the
/// black: of an edge that the lens blurs, more than half is brighter than the mean code. The border
/// is a module wide, and its outer edge moves in as its inner one moves out, where white data are
/// behind it: with N modules in a side, edges that are d off leave the inner one 2 d (1 - 1 / N)
/// nearer than the outer corners say. Nothing where too little of it is seen.
std::optional<Bloom> find_bloom(const cv::Mat& grey, const PinholeCamera& model, int modules,
                                double rise, double reach,
                                const std::array<Eigen::Vector2d, 4>& corners) {
  const double module_px = least_side(corners) / modules;
  std::array<Eigen::Vector2d, 4> flat;
  for (std::size_t i = 0; i < 4; ++i) flat[i] = model.unproject(corners[i]).head<2>();
  const Eigen::Matrix3d H = homography_of(flat);
  const auto pixel = [&](std::size_t side, double along, double depth) {
    const Eigen::Vector3d p = H * in_square(side, along, depth).homogeneous();
    return model.project(p / p.z());
  };
  const double module = 1.0 / modules;
  std::vector<double> nearer;
  for (std::size_t side = 0; side < 4; ++side) {
    for (int m = 1; m + 1 < modules; ++m) {
      for (int k = 0; k < kInModule; ++k) {
        const double along = (m + 0.5 + kModuleApart * (k - kInModule / 2)) * module;
        const Eigen::Vector2d p = pixel(side, along, module);
        const Eigen::Vector2d inward = (pixel(side, along, 1.5 * module) - p).normalized();
        const auto edge = find_edge(grey, p, inward, reach);
        if (edge && edge->rise >= kLeastRise * rise) nearer.push_back(-edge->at);
      }
    }
  }
  if (nearer.size() < kMinInner) return std::nullopt;
  const auto n = static_cast<double>(nearer.size());
  double mean = 0;
  for (const double value : nearer) mean += value / n;
  double variance = 0;
  for (const double value : nearer) variance += (value - mean) * (value - mean) / (n - 1);
  const double per_width = 2 * (1 - module);
  const double as_one = std::max(1.0, kNeighbours / (kModuleApart * module_px));
  const Bloom found{mean / per_width, as_one * variance / n / (per_width * per_width)};
  if (std::abs(found.width) > kMaxBloom) return std::nullopt;
  return found;
}

std::array<Eigen::Vector2d, 4> corners_of(const std::array<Side, 4>& sides,
                                          const PinholeCamera& model) {
  std::array<Eigen::Vector2d, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d meeting = sides[(i + 3) % 4].line.cross(sides[i].line);
    corners[i] = model.project(meeting / meeting.z());
  }
  return corners;
}

/// `distance` in the plane z = 1, away from `inside`.
void move_outward(const Eigen::Vector2d& inside, double distance, Side& side) {
  const bool points_outward = side.line.dot(inside.homogeneous()) < 0;
  side.line.z() -= points_outward ? distance : -distance;
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

double refine_tag_corners(const cv::Mat& grey, const PinholeCamera& model, int modules,
                          std::array<Eigen::Vector2d, 4>& corners) {
  const double module = least_side(corners) / modules;
  const double reach = kStep * std::floor(std::min(kMaxReach, 0.6 * module) / kStep);
  if (reach < 1.5) return kUnrefined;
  const Eigen::Vector2d centre = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
  std::array<Side, 4> sides;
  double rise = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d& to = corners[(i + 1) % 4];
    Eigen::Vector2d outward = Eigen::Vector2d(to.y() - from.y(), from.x() - to.x()).normalized();
    if (outward.dot((from + to) / 2 - centre) < 0) outward = -outward;
    const auto side = fit_side(grey, model, from, to, outward, reach);
    if (!side) return kUnrefined;
    sides[i] = *side;
    rise += side->rise / 4;
  }
  double variance = 0;
  if (const auto bloom = find_bloom(grey, model, modules, rise, reach, corners_of(sides, model))) {
    const Eigen::Vector2d inside = model.unproject(centre).head<2>();
    const double distance = bloom->width / std::sqrt(model.fx * model.fy);
    for (Side& side : sides) {
      move_outward(inside, distance, side);
      side.end_variance += bloom->variance;
    }
  }
  const std::array<Eigen::Vector2d, 4> refined = corners_of(sides, model);
  for (std::size_t i = 0; i < 4; ++i) {
    if (!((refined[i] - corners[i]).norm() < kMaxMove)) return kUnrefined;
    variance += corner_variance(sides[(i + 3) % 4], sides[i]) / 4;
  }
  corners = refined;
  return std::sqrt(variance + kLeast * kLeast);
}

}  // namespace vinebench::slam

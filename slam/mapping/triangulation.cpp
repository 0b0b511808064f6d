// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/mapping/triangulation.h"

#include <algorithm>
#include <cmath>

#include "slam/frame/measurements.h"

namespace vinebench::slam {
namespace {

/// Rays that meet at less than a degree give no useful depth.
const double kMinParallax = 1.0 - std::cos(1.0 * 3.14159265358979 / 180.0);

/// Features nearer to each other than this may be one corner; in standard deviations.
constexpr double kSameCorner = 3;

/// Features of one view in want of a landmark, with their rays in the map frame.
struct Candidate {
  int feature;
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
  PixelMeasurement measurement;
};

std::vector<Candidate> candidates(const Keyframe& keyframe, std::size_t v,
                                  const EstimatorRig& rig) {
  const StereoView& view = keyframe.frame->views[v];
  std::vector<Candidate> result;
  for (std::size_t f = 0; f < view.detected(); ++f) {
    if (keyframe.landmarks[v][f] >= 0 || view.stereo[f].depth > 0) continue;
    PixelMeasurement m = measure(view, static_cast<int>(f), rig.noise);
    m.velocity = keyframe.frame->velocity;
    const Pose T_map_cam =
        row_pose(*keyframe.frame, v, m.pixel.y(), keyframe.T_map_body, rig) * rig.T_body_cams[v];
    const Eigen::Vector3d ray = rig.left_cameras[v].lens.unproject(m.pixel);
    result.push_back(
        {static_cast<int>(f), T_map_cam.translation, (T_map_cam.rotation * ray).normalized(), m});
  }
  return result;
}

double depth_of(const Eigen::Vector3d& p_map, const Keyframe& keyframe, std::size_t v,
                const EstimatorRig& rig) {
  return (rig.left_cameras[v].T_cam_body * (keyframe.T_map_body.inverse() * p_map)).z();
}

/// A feature on another one's epipolar line.
struct Alike {
  const Candidate* feature;
  int distance;  ///< bits
};

/// Those of `of_b` on the epipolar line of a's candidate; `baseline` is a unit vector.
std::vector<Alike> alike_on_line(const Keyframe& a, const Candidate& candidate,
                                 const Eigen::Vector3d& baseline,
                                 const std::vector<Candidate>& of_b, const Keyframe& b,
                                 std::size_t v, const EstimatorRig& rig) {
  const Eigen::Vector3d plane = baseline.cross(candidate.direction).normalized();
  const std::vector<Descriptor>& in_b = b.frame->views[v].features.descriptors;
  const Descriptor& wanted =
      a.frame->views[v].features.descriptors[static_cast<std::size_t>(candidate.feature)];
  std::vector<Alike> line;
  for (const Candidate& other : of_b) {
    // Distance from the epipolar plane, in the image's standard deviations.
    const double off = std::abs(plane.dot(other.direction)) * rig.left_cameras[v].lens.fx;
    if (off > 2.0 * other.measurement.sigma) continue;
    line.push_back(
        {&other, hamming_distance(wanted, in_b[static_cast<std::size_t>(other.feature)])});
  }
  return line;
}

/// Whether nothing elsewhere on the line looks nearly as alike.
bool is_unique(const Alike& best, const std::vector<Alike>& line, double second_best) {
  const PixelMeasurement& at = best.feature->measurement;
  return std::ranges::none_of(line, [&](const Alike& other) {
    const PixelMeasurement& there = other.feature->measurement;
    // A corner may be found on several levels of the pyramid.
    const double same = kSameCorner * std::max(at.sigma, there.sigma);
    return (there.pixel - at.pixel).norm() > same && best.distance >= second_best * other.distance;
  });
}

}  // namespace

std::optional<Eigen::Vector3d> intersect_rays(const Eigen::Vector3d& p_a,
                                              const Eigen::Vector3d& d_a,
                                              const Eigen::Vector3d& p_b,
                                              const Eigen::Vector3d& d_b) {
  const double cosine = d_a.dot(d_b);
  if (1.0 - cosine < kMinParallax) return std::nullopt;
  const Eigen::Vector3d offset = p_b - p_a;
  const double denominator = 1.0 - cosine * cosine;
  const double s = (offset.dot(d_a) - cosine * offset.dot(d_b)) / denominator;
  const double t = (cosine * offset.dot(d_a) - offset.dot(d_b)) / denominator;
  if (s <= 0 || t <= 0) return std::nullopt;
  return 0.5 * (p_a + s * d_a + p_b + t * d_b);
}

std::vector<EpipolarMatch> match_epipolar(const Keyframe& a, const Keyframe& b, int view,
                                          const EstimatorRig& rig, const EpipolarSearch& search) {
  const auto v = static_cast<std::size_t>(view);
  const Eigen::Vector3d p_a =
      view_pose(*a.frame, v, a.T_map_body, rig) * rig.T_body_cams[v].translation;
  const Eigen::Vector3d p_b =
      view_pose(*b.frame, v, b.T_map_body, rig) * rig.T_body_cams[v].translation;
  std::vector<EpipolarMatch> matches;
  if ((p_a - p_b).norm() < 0.02) return matches;
  const std::vector<Candidate> of_b = candidates(b, v, rig);
  const Eigen::Vector3d baseline = (p_b - p_a).normalized();
  for (const Candidate& candidate : candidates(a, v, rig)) {
    const auto met = [&](const Candidate& other) -> std::optional<Eigen::Vector3d> {
      const auto p_map =
          intersect_rays(candidate.origin, candidate.direction, other.origin, other.direction);
      if (!p_map || depth_of(*p_map, a, v, rig) < search.min_depth ||
          depth_of(*p_map, b, v, rig) < search.min_depth) {
        return std::nullopt;
      }
      const Reprojection in_a(rig.left_cameras[v], candidate.measurement);
      const Reprojection in_b(rig.left_cameras[v], other.measurement);
      const bool seen = in_a.chi_squared(a.T_map_body, *p_map) <= kChiSquared2 &&
                        in_b.chi_squared(b.T_map_body, *p_map) <= kChiSquared2;
      return seen ? p_map : std::nullopt;
    };
    const std::vector<Alike> line = alike_on_line(a, candidate, baseline, of_b, b, v, rig);
    const Alike* best = nullptr;
    EpipolarMatch match;
    for (const Alike& alike : line) {
      if (alike.distance > search.max_hamming || (best && alike.distance >= best->distance)) {
        continue;
      }
      if (const auto p_map = met(*alike.feature)) {
        best = &alike;
        match = {candidate.feature, alike.feature->feature, *p_map};
      }
    }
    if (best && is_unique(*best, line, search.second_best)) matches.push_back(match);
  }
  return matches;
}

}  // namespace vinebench::slam

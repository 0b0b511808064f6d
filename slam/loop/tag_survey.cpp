// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/tag_survey.h"

#include <Eigen/Cholesky>

#include "core/geometry/step_covariance.h"

namespace vinebench::slam {
namespace {

/// Gauss-Newton; survey errors are small, so that two steps are nearly all.
constexpr int kWorldSteps = 5;

}  // namespace

std::vector<RegisteredTag> with_accuracy(std::vector<RegisteredTag> tags,
                                         const SurveyAccuracy& otherwise) {
  for (RegisteredTag& tag : tags) {
    if (is_exact(tag.survey)) tag.survey = otherwise;
  }
  return tags;
}

bool is_exact(const SurveyAccuracy& survey) {
  return survey.position == 0 && survey.rotation == 0;
}

Matrix6d survey_covariance(const SurveyAccuracy& survey) {
  return isotropic_covariance(survey.position, survey.rotation);
}

Vector6d misplacement(const FoundTag& tag, const Pose& T_map_world) {
  const Pose off = (T_map_world * tag.T_world_tag).inverse() * tag.T_map_tag;
  Vector6d step;
  step << off.translation, log_so3(off.rotation);
  return step;
}

Pose likeliest_world(const std::vector<FoundTag>& tags) {
  Pose T_map_world = tags.front().T_map_tag * tags.front().T_world_tag.inverse();
  if (tags.size() == 1) return T_map_world;
  for (int i = 0; i < kWorldSteps; ++i) {
    Matrix6d H = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    for (const FoundTag& tag : tags) {
      const Matrix6d J = carried_step(tag.T_world_tag);
      const Eigen::LDLT<Matrix6d> covariance(tag.covariance);
      H += J.transpose() * covariance.solve(J);
      g += J.transpose() * covariance.solve(misplacement(tag, T_map_world));
    }
    T_map_world = T_map_world * step_of(H.ldlt().solve(g));
  }
  return T_map_world;
}

std::optional<Pose> world_by_tags(const Map& map) {
  std::vector<FoundTag> found;
  for (const MapTag& tag : map.tags()) {
    if (tag.fixed) return map.world();
    if (!tag.survey) continue;
    found.push_back({tag.survey->T_world_tag, tag.T_map_tag, tag.survey->covariance});
  }
  return found.size() < 2 ? map.world() : likeliest_world(found);
}

}  // namespace vinebench::slam

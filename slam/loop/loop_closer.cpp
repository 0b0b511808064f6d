// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/loop_closer.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/util/error.h"
#include "slam/loop/levelling.h"
#include "slam/loop/loop_correction.h"
#include "slam/optimisation/bundle_adjustment.h"

namespace vinebench::slam {
namespace {

/// 99.9 % of the chi-square distribution with six degrees of freedom.
constexpr double kChiSquared6 = 22.46;

/// Two sightings farther apart in time are not in a row.
constexpr double kInARow = 0.5;  // s

/// How much a tag's place may change from one frame to the next besides the sightings' noise.
constexpr double kFrameOffset = 0.005;  // m
constexpr double kFrameTurn = 0.01;     // rad

/// How far a body may be carried, standard deviations.
constexpr double kAnywhere = 100;  // m
constexpr double kAnyTurn = 3;     // rad

template <class A, class B>
bool same_tag(const A& a, const B& b) {
  return a.id == b.id && a.family == b.family;
}

double square(double x) {
  return x * x;
}

Matrix6d diagonal_covariance(double offset, double turn) {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(offset * offset), Eigen::Vector3d::Constant(turn * turn);
  return variances.asDiagonal();
}

/// The last keyframe of this run before `later` that saw a tag for which `is_wanted`, and how.
template <class Predicate>
const TagSighting* last_sighting(const Map& map, int later, Predicate is_wanted, int& keyframe_id) {
  for (int k = later - 1; k >= 0 && !map.keyframe(k).inherited(); --k) {
    for (const TagSighting& sighting : map.keyframe(k).frame->tags) {
      if (!is_wanted(sighting)) continue;
      keyframe_id = k;
      return &sighting;
    }
  }
  return nullptr;
}

}  // namespace

const RegisteredTag* LoopCloser::registered(const TagSighting& sighting) const {
  for (const RegisteredTag& tag : registered_) {
    if (same_tag(tag, sighting)) return &tag;
  }
  return nullptr;
}

const LoopCloser::Visit* LoopCloser::visit(const TagSighting& sighting) const {
  for (const Visit& visit : visits_) {
    if (same_tag(visit, sighting)) return &visit;
  }
  return nullptr;
}

/// The last visit that says where the tag is: its own, or, of a registered tag, that of any.
const LoopCloser::Visit* LoopCloser::reference(const TagSighting& sighting) const {
  if (registered(sighting) == nullptr) return visit(sighting);
  const Visit* last = nullptr;
  for (const Visit& visit : visits_) {
    TagSighting name;
    name.family = visit.family;
    name.id = visit.id;
    if (registered(name) == nullptr) continue;
    if (last == nullptr || visit.last_seen > last->last_seen) last = &visit;
  }
  return last;
}

bool LoopCloser::was_left(const TagSighting& sighting, Stamp stamp, double path_length) const {
  if (!settings_.loop.enabled) return false;
  const Visit* last = reference(sighting);
  return last != nullptr && last->in_keyframe &&
         to_seconds(stamp - last->last_seen) >= settings_.loop.away_seconds &&
         path_length - last->path_length >= settings_.loop.away_distance;
}

const TagSighting* LoopCloser::loop_sighting(const FrameFeatures& frame, double path_length) const {
  for (const TagSighting& sighting : frame.tags) {
    if (was_left(sighting, frame.stamp, path_length)) return &sighting;
  }
  return nullptr;
}

bool LoopCloser::sees_loop(const FrameFeatures& frame, double path_length) const {
  return loop_sighting(frame, path_length) != nullptr;
}

void LoopCloser::remember_visit(const TagSighting& sighting, Stamp stamp, double path_length,
                                bool in_keyframe) {
  Visit now{sighting.family, sighting.id, stamp, path_length, in_keyframe, covariance(sighting)};
  if (const Visit* before = visit(sighting)) {
    now.in_keyframe |= before->in_keyframe;
    now.mapped = before->mapped;
  }
  if (registered(sighting) != nullptr) now.mapped.setZero();
  std::erase_if(visits_, [&](const Visit& visit) { return same_tag(visit, sighting); });
  visits_.push_back(now);
}

void LoopCloser::take_over(const Map& map) {
  for (const MapTag& tag : map.tags()) {
    for (const RegisteredTag& known : registered_) {
      if (same_tag(known, tag) && tag.fixed) {
        T_map_world_ = tag.T_map_tag * known.T_world_tag.inverse();
      }
    }
  }
}

std::optional<Pose> LoopCloser::world_pose(const std::vector<TagSighting>& sightings) const {
  std::vector<PlacedSighting> seen;
  for (const TagSighting& sighting : sightings) {
    const RegisteredTag* tag = sighting.ambiguous ? nullptr : registered(sighting);
    if (tag != nullptr) seen.push_back({tag->T_world_tag, tag->size, &sighting});
  }
  return locate_by_tags(seen, cameras_, settings_.loop.corner_sigma);
}

std::optional<Pose> LoopCloser::map_pose(const std::vector<TagSighting>& sightings,
                                         const Map& map) const {
  std::vector<PlacedSighting> seen;
  for (const TagSighting& sighting : sightings) {
    const bool rejected = std::ranges::count(rejected_, std::pair(sighting.family, sighting.id));
    if (sighting.ambiguous || rejected) continue;
    if (const auto tag = placed(sighting, map)) seen.push_back(*tag);
  }
  return locate_by_tags(seen, cameras_, settings_.loop.corner_sigma);
}

/// Where the tag is in the map, if that is known: it was mapped, or it is registered and the map
/// lies in the world.
std::optional<PlacedSighting> LoopCloser::placed(const TagSighting& sighting,
                                                 const Map& map) const {
  if (const MapTag* tag = map.find_tag(sighting.family, sighting.id)) {
    return PlacedSighting{tag->T_map_tag, tag->size, &sighting};
  }
  const RegisteredTag* tag = registered(sighting);
  if (tag == nullptr || !T_map_world_) return std::nullopt;
  return PlacedSighting{*T_map_world_ * tag->T_world_tag, tag->size, &sighting};
}

/// Of the tag's pose against the body.
Matrix6d LoopCloser::covariance(const TagSighting& sighting) const {
  const RegisteredTag* tag = registered(sighting);
  return tag_covariance(sighting, tag != nullptr ? tag->size : settings_.tag_size, cameras_,
                        settings_.loop.corner_sigma);
}

/// Of a registered tag in the world, in its own frame; zero of others.
Matrix6d LoopCloser::survey_covariance(const TagSighting& sighting) const {
  if (registered(sighting) == nullptr) return Matrix6d::Zero();
  const LoopConfig& told = settings_.loop;
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(told.survey_position),
      Eigen::Vector3d::Constant(told.survey_rotation_deg * std::numbers::pi / 180);
  return sigma.cwiseAbs2().asDiagonal();
}

Matrix6d LoopCloser::localisation_covariance(const std::vector<TagSighting>& sightings) const {
  std::optional<Matrix6d> surest;
  for (const TagSighting& sighting : sightings) {
    if (sighting.ambiguous) continue;
    const Matrix6d of_body = carry_covariance(covariance(sighting) + survey_covariance(sighting),
                                              T_body_tag(sighting, cameras_).inverse());
    if (!surest || of_body.trace() < surest->trace()) surest = of_body;
  }
  return surest.value_or(Matrix6d::Zero());
}

/// Of the way from `since` to `path_length`: the greatest drift along one axis is made the edge of
/// what the chi-square test lets pass when the sighting is exact. A turn in an odometry gap
/// moves the body sideways on all of the way after it.
Matrix6d LoopCloser::drift(double since, double path_length) const {
  const LoopConfig& limits = settings_.loop;
  const double way = path_length - since;
  const double turn = limits.max_turn_deg + limits.max_turn_deg_per_metre * way;
  const double edge = std::sqrt(kChiSquared6);
  double offset2 = square((limits.max_offset + limits.max_drift * way) / edge);
  double turn2 = square(turn * std::numbers::pi / 180 / edge);
  for (const Gap& gap : gaps_) {
    if (gap.path_length < since) continue;
    const double turned = gap.covariance.bottomRightCorner<3, 3>().trace();
    offset2 += gap.covariance.topLeftCorner<3, 3>().trace() +
               turned * square(path_length - gap.path_length);
    turn2 += turned;
  }
  return diagonal_covariance(std::sqrt(offset2), std::sqrt(turn2));
}

/// Whether the tag is where the map has it, or its place is not known.
bool LoopCloser::is_in_place(const TagSighting& sighting, const Pose& T_map_body,
                             double path_length, const Map& map) const {
  const auto known = placed(sighting, map);
  if (!known) return true;
  const Visit* last = reference(sighting);
  const Pose T_body_seen = T_body_tag(sighting, cameras_);
  Matrix6d expected =
      covariance(sighting) +
      carry_covariance(drift(last != nullptr ? last->path_length : 0, path_length), T_body_seen);
  if (const Visit* own = visit(sighting)) expected += own->mapped;
  return pose_chi_squared(T_map_body * T_body_seen, known->T_ref_tag, expected) <= kChiSquared6;
}

/// Whether another tag of the same name is seen elsewhere, and the map does not say which is meant.
bool LoopCloser::is_doubled(const TagSighting& sighting, const FrameFeatures& frame,
                            const Pose& T_map_body, double path_length, const Map& map) const {
  const Matrix6d own = covariance(sighting) + diagonal_covariance(kFrameOffset, kFrameTurn);
  return std::ranges::any_of(frame.tags, [&](const TagSighting& other) {
    if (&other == &sighting || !same_tag(other, sighting) || other.ambiguous) return false;
    if (!is_in_place(other, T_map_body, path_length, map)) return false;
    return pose_chi_squared(T_body_tag(sighting, cameras_), T_body_tag(other, cameras_),
                            own + covariance(other)) > kChiSquared6;
  });
}

/// Whether the last frame saw the tag in the same place.
bool LoopCloser::is_confirmed(const Return& now) const {
  return std::ranges::any_of(returns_, [&](const Return& before) {
    if (!same_tag(before.sighting, now.sighting)) return false;
    if (to_seconds(now.stamp - before.stamp) > kInARow) return false;
    const Matrix6d expected = covariance(now.sighting) + covariance(before.sighting) +
                              diagonal_covariance(kFrameOffset, kFrameTurn);
    return pose_chi_squared(now.T_map_tag, before.T_map_tag, expected) <= kChiSquared6;
  });
}

/// Whether there was an odometry gap since a visit that says where the tag is.
bool LoopCloser::crossed_gap(const TagSighting& sighting) const {
  const Visit* last = reference(sighting);
  return last != nullptr && !gaps_.empty() && gaps_.back().path_length >= last->path_length;
}

std::optional<Pose> LoopCloser::pose_across_gap(const std::vector<TagSighting>& sightings,
                                                const Pose& T_map_body, double path_length,
                                                const Map& map) const {
  std::vector<PlacedSighting> elsewhere;
  for (const TagSighting& sighting : sightings) {
    if (sighting.ambiguous || !crossed_gap(sighting)) continue;
    if (is_in_place(sighting, T_map_body, path_length, map)) continue;
    if (const auto tag = placed(sighting, map)) elsewhere.push_back(*tag);
  }
  return locate_by_tags(elsewhere, cameras_, settings_.loop.corner_sigma);
}

int LoopCloser::open_gap(const std::vector<TagSighting>& sightings, Map& map) {
  for (const TagSighting& sighting : sightings) {
    std::erase(rejected_, std::pair(sighting.family, sighting.id));
  }
  Gap& last = gaps_.back();
  last.covariance = diagonal_covariance(kAnywhere, kAnyTurn);
  map.keyframe(last.keyframe).link->covariance = last.covariance;
  return last.keyframe;
}

void LoopCloser::reject(const TagSighting& sighting) {
  const std::pair name(sighting.family, sighting.id);
  if (!std::ranges::count(rejected_, name)) rejected_.push_back(name);
}

std::vector<RejectedTag> LoopCloser::gate(FrameFeatures& frame, const Pose& T_map_body,
                                          double path_length, const Map& map) {
  std::vector<TagSighting> believed;
  std::vector<RejectedTag> rejected;
  std::vector<Return> returns;
  for (const TagSighting& sighting : frame.tags) {
    const auto leave_out = [&](TagRejection reason) {
      rejected.push_back({sighting.family, sighting.id, sighting.camera, reason});
    };
    if (sighting.ambiguous) {
      leave_out(TagRejection::kAmbiguous);
    } else if (!is_in_place(sighting, T_map_body, path_length, map)) {
      reject(sighting);
      leave_out(TagRejection::kMisplaced);
    } else if (is_doubled(sighting, frame, T_map_body, path_length, map)) {
      reject(sighting);
      leave_out(TagRejection::kDuplicate);
    } else if (was_left(sighting, frame.stamp, path_length)) {
      returns.push_back({sighting, frame.stamp, T_map_body * T_body_tag(sighting, cameras_)});
      if (is_confirmed(returns.back())) believed.push_back(sighting);
    } else {
      believed.push_back(sighting);
    }
  }
  frame.tags = std::move(believed);
  returns_ = std::move(returns);
  return rejected;
}

void LoopCloser::add_tag(const TagSighting& sighting, const Pose& T_map_body, Map& map) {
  MapTag tag{sighting.family, sighting.id, settings_.tag_size,
             T_map_body * T_body_tag(sighting, cameras_), false};
  if (const RegisteredTag* known = registered(sighting)) {
    tag.size = known->size;
    tag.T_map_tag = *T_map_world_ * known->T_world_tag;
    tag.fixed = true;
  }
  map.tags().push_back(tag);
}

void LoopCloser::record(const FrameFeatures& frame, const Pose& T_map_body, double path_length,
                        Map& map) {
  // A loop that waits to be closed stays one.
  if (sees_loop(frame, path_length)) return;
  const bool is_keyframe =
      !map.keyframes().empty() && map.keyframes().back().frame->index == frame.index;
  if (!T_map_world_) {
    if (const auto T_world_body = world_pose(frame.tags)) {
      T_map_world_ = T_map_body * T_world_body->inverse();
    }
  }
  for (const TagSighting& sighting : frame.tags) {
    if (registered(sighting) != nullptr && !T_map_world_) continue;
    if (map.find_tag(sighting.family, sighting.id) == nullptr) add_tag(sighting, T_map_body, map);
    remember_visit(sighting, frame.stamp, path_length, is_keyframe);
  }
}

LoopClosure LoopCloser::close(int keyframe_id, double path_length, const EstimatorRig& rig,
                              Map& map) {
  const Keyframe& later = map.keyframe(keyframe_id);
  const TagSighting* sighting = loop_sighting(*later.frame, path_length);
  const auto tag = sighting ? placed(*sighting, map) : std::nullopt;
  const bool by_world = tag && registered(*sighting) != nullptr;
  int first = keyframe_id;
  const auto is_wanted = [&](const TagSighting& seen) {
    return by_world ? registered(seen) != nullptr : same_tag(seen, *sighting);
  };
  const TagSighting* earlier = tag ? last_sighting(map, keyframe_id, is_wanted, first) : nullptr;
  if (earlier == nullptr) {
    fail("loop closing: keyframe {} sees no tag that an earlier one saw and left", keyframe_id);
  }
  const Pose before = later.T_map_body;
  const Pose T_tag_later = T_body_tag(*sighting, cameras_).inverse();
  const Pose T_earlier_tag =
      T_body_tag(*earlier, cameras_) * placed(*earlier, map)->T_ref_tag.inverse() * tag->T_ref_tag;
  LoopClosure closure;
  closure.tag_id = sighting->id;
  closure.earlier = map.keyframe(first).frame->stamp;
  closure.later = later.frame->stamp;
  closure.T_earlier_later = T_earlier_tag * T_tag_later;
  const Matrix6d measured =
      carry_covariance(covariance(*sighting) + covariance(*earlier), T_tag_later);
  spread_correction(map, first, keyframe_id, tag->T_ref_tag * T_tag_later, measured);
  for (const TagSighting& seen : later.frame->tags) {
    if (registered(seen) != nullptr && !T_map_world_) continue;
    if (map.find_tag(seen.family, seen.id) == nullptr) add_tag(seen, later.T_map_body, map);
    remember_visit(seen, later.frame->stamp, path_length, true);
  }
  adjust_globally(rig, map);
  if (!same_tag(*earlier, *sighting)) {
    // One sighting's turn swings what is measured by way of another tag: all of them know better.
    closure.T_earlier_later = map.keyframe(first).T_map_body.inverse() * later.T_map_body;
  } else {
    closure.covariance = measured;
  }
  closure.correction =
      (map.keyframe(keyframe_id).T_map_body.translation - before.translation).norm();
  return closure;
}

/// Of a registered tag's place against the map, in the tag's own frame, by the surest of the
/// keyframes' sightings (what is wrong with one is wrong with its neighbours too) and its survey.
std::optional<Matrix6d> LoopCloser::place_covariance(const MapTag& tag, const Map& map) const {
  std::optional<Matrix6d> surest;
  for (const Keyframe& keyframe : map.keyframes()) {
    for (const TagSighting& sighting : keyframe.frame->tags) {
      if (!same_tag(sighting, tag)) continue;
      const Matrix6d of_tag = covariance(sighting) + survey_covariance(sighting);
      if (!surest || of_tag.trace() < surest->trace()) surest = of_tag;
    }
  }
  return surest;
}

void LoopCloser::level(Map& map) const {
  if (!settings_.inertial || !T_map_world_) return;
  const auto is_fixed = [](const MapTag& tag) { return tag.fixed; };
  if (std::ranges::count_if(map.tags(), is_fixed) != 1) return;
  const MapTag& tag = *std::ranges::find_if(map.tags(), is_fixed);
  const auto place = place_covariance(tag, map);
  if (!place) return;
  const Eigen::Vector3d down = T_map_world_->rotation * -Eigen::Vector3d::UnitZ();
  level_about(map, tag.T_map_tag, place->bottomRightCorner<3, 3>(), down, *settings_.inertial);
}

void LoopCloser::adjust_globally(const EstimatorRig& rig, Map& map) const {
  level(map);
  AdjustmentOptions options;
  options.iterations = settings_.global_iterations;
  options.tag_corner_sigma = settings_.loop.corner_sigma;
  options.global = true;
  options.inertial = settings_.inertial;
  adjust(map, global_window(map), rig, options);
  malloc_trim(0);  // of what a long drive's adjustment took, the C library would keep most
}

}  // namespace vinebench::slam

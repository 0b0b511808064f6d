// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/tag_gates.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/step_covariance.h"

namespace vinebench::slam {
namespace {

/// Two sightings farther apart in time are not in a row.
constexpr double kInARow = 0.5;  // s

/// How much a tag's place may change from one frame to the next besides the sightings' noise.
constexpr double kFrameOffset = 0.005;  // m
constexpr double kFrameTurn = 0.01;     // rad

/// A sighting that says less of where the body is closes no loop, as a nearer one will come; root
/// mean square of the three axes.
constexpr double kSureOffset = 0.03;                        // m
constexpr double kSureTurn = 1.0 * std::numbers::pi / 180;  // rad

/// A tag that is placed worse by its first sighting, from far away, would bend the map to itself.
constexpr double kPlacedOffset = 0.003;                       // m
constexpr double kPlacedTurn = 0.2 * std::numbers::pi / 180;  // rad

/// How far a body may be carried, standard deviations.
constexpr double kAnywhere = 100;  // m
constexpr double kAnyTurn = 3;     // rad

template <class Named>
std::pair<std::string, int> name_of(const Named& tag) {
  return {tag.family, tag.id};
}

double square(double x) {
  return x * x;
}

/// Root mean square of the three axes, of each.
bool is_within(const Matrix6d& covariance, double offset, double turn) {
  return covariance.topLeftCorner<3, 3>().trace() <= 3 * square(offset) &&
         covariance.bottomRightCorner<3, 3>().trace() <= 3 * square(turn);
}

/// What is known beforehand of a tag that does not stand exactly where it was surveyed.
std::optional<SurveyedPlace> survey_of(const RegisteredTag& tag) {
  if (is_exact(tag.survey)) return std::nullopt;
  return SurveyedPlace{tag.T_world_tag, survey_covariance(tag.survey)};
}

}  // namespace

const RegisteredTag* TagGates::told(const std::string& family, int id) const {
  const auto tag = std::ranges::find_if(
      registered_, [&](const RegisteredTag& t) { return t.id == id && t.family == family; });
  return tag != registered_.end() ? &*tag : nullptr;
}

bool TagGates::is_disowned(const std::string& family, int id) const {
  return std::ranges::count(disowned_, std::pair(family, id)) > 0;
}

Matrix6d TagGates::covariance(const TagSighting& sighting) const {
  const RegisteredTag* tag = told(sighting.family, sighting.id);
  return tag_covariance(sighting, tag != nullptr ? tag->size : tag_size_, cameras_,
                        config_.corner_sigma);
}

Matrix6d TagGates::survey_covariance(const TagSighting& sighting) const {
  const RegisteredTag* tag = registered(sighting);
  return tag != nullptr ? slam::survey_covariance(tag->survey) : Matrix6d::Zero();
}

std::optional<PlacedSighting> TagGates::placed(const TagSighting& sighting, const Map& map) const {
  if (const MapTag* tag = map.find_tag(sighting.family, sighting.id)) {
    return PlacedSighting{tag->T_map_tag, tag->size, &sighting};
  }
  const RegisteredTag* tag = registered(sighting);
  if (tag == nullptr || !map.world()) return std::nullopt;
  return PlacedSighting{*map.world() * tag->T_world_tag, tag->size, &sighting};
}

std::optional<Pose> TagGates::world_pose(const std::vector<TagSighting>& sightings) const {
  std::vector<PlacedSighting> seen;
  for (const TagSighting& sighting : sightings) {
    const RegisteredTag* tag = sighting.ambiguous ? nullptr : registered(sighting);
    if (tag != nullptr) seen.push_back({tag->T_world_tag, tag->size, &sighting});
  }
  return locate_by_tags(seen, cameras_, config_.corner_sigma);
}

std::optional<Pose> TagGates::map_pose(const std::vector<TagSighting>& sightings,
                                       const Map& map) const {
  std::vector<PlacedSighting> seen;
  for (const TagSighting& sighting : sightings) {
    if (sighting.ambiguous || std::ranges::count(rejected_, name_of(sighting)) > 0) continue;
    if (const auto tag = placed(sighting, map)) seen.push_back(*tag);
  }
  return locate_by_tags(seen, cameras_, config_.corner_sigma);
}

Matrix6d TagGates::localisation_covariance(const std::vector<TagSighting>& sightings) const {
  std::optional<Matrix6d> surest;
  for (const TagSighting& sighting : sightings) {
    if (sighting.ambiguous) continue;
    const Matrix6d of_body = carry_covariance(covariance(sighting) + survey_covariance(sighting),
                                              T_body_tag(sighting, cameras_).inverse());
    if (!surest || of_body.trace() < surest->trace()) surest = of_body;
  }
  return surest.value_or(Matrix6d::Zero());
}

bool TagGates::is_sure(const TagSighting& sighting) const {
  const Matrix6d of_body =
      carry_covariance(covariance(sighting), T_body_tag(sighting, cameras_).inverse());
  return is_within(of_body, kSureOffset, kSureTurn);
}

bool TagGates::places_well(const TagSighting& sighting) const {
  return is_within(covariance(sighting), kPlacedOffset, kPlacedTurn);
}

void TagGates::take_over(Map& map) const {
  std::vector<FoundTag> found;
  for (MapTag& tag : map.tags()) {
    const RegisteredTag* known = tag.fixed ? registered(tag) : nullptr;
    if (known == nullptr) continue;
    tag.survey = survey_of(*known);
    tag.fixed = !tag.survey;
    found.push_back(
        {known->T_world_tag, tag.T_map_tag,
         isotropic_covariance(kFrameOffset, kFrameTurn) + slam::survey_covariance(known->survey)});
  }
  if (!found.empty()) map.world() = likeliest_world(found);
}

MapTag& TagGates::add_tag(const TagSighting& sighting, const Pose& T_map_body, Map& map) const {
  MapTag tag{sighting.family, sighting.id, tag_size_, T_map_body * T_body_tag(sighting, cameras_)};
  if (const RegisteredTag* known = registered(sighting)) {
    tag.size = known->size;
    tag.survey = survey_of(*known);
    tag.fixed = !tag.survey;
    if (tag.fixed) tag.T_map_tag = *map.world() * known->T_world_tag;
  }
  return map.tags().emplace_back(tag);
}

const TagGates::Visit* TagGates::visit(const TagSighting& sighting) const {
  for (const Visit& visit : visits_) {
    if (same_tag(visit, sighting)) return &visit;
  }
  return nullptr;
}

/// The last visit that says where the tag is: its own, or, of a registered tag, that of any.
const TagGates::Visit* TagGates::reference(const TagSighting& sighting) const {
  if (registered(sighting) == nullptr) return visit(sighting);
  const Visit* last = nullptr;
  for (const Visit& visit : visits_) {
    if (registered(visit) == nullptr) continue;
    if (last == nullptr || visit.last_seen > last->last_seen) last = &visit;
  }
  return last;
}

bool TagGates::was_left(const TagSighting& sighting, Stamp stamp, double path_length) const {
  if (!config_.enabled) return false;
  const Visit* last = reference(sighting);
  return last != nullptr && last->in_keyframe &&
         to_seconds(stamp - last->last_seen) >= config_.away_seconds &&
         path_length - last->path_length >= config_.away_distance;
}

const TagSighting* TagGates::loop_sighting(const FrameFeatures& frame, double path_length) const {
  for (const TagSighting& sighting : frame.tags) {
    if (was_left(sighting, frame.stamp, path_length)) return &sighting;
  }
  return nullptr;
}

void TagGates::remember_visit(const TagSighting& sighting, Stamp stamp, double path_length,
                              bool in_keyframe) {
  Visit now{sighting.family, sighting.id, stamp, path_length, in_keyframe, covariance(sighting)};
  if (const Visit* before = visit(sighting)) {
    now.in_keyframe |= before->in_keyframe;
    now.mapped = before->mapped;
  }
  const RegisteredTag* known = registered(sighting);
  if (known != nullptr && is_exact(known->survey)) now.mapped.setZero();
  std::erase_if(visits_, [&](const Visit& visit) { return same_tag(visit, sighting); });
  visits_.push_back(now);
}

/// Of the way from `since` to `path_length`: the greatest drift along one axis is made the edge of
/// what the chi-square test lets pass when the sighting is exact. A turn in an odometry gap
/// moves the body sideways on all of the way after it.
Matrix6d TagGates::drift(double since, double path_length) const {
  const double way = path_length - since;
  const double turn = config_.max_turn_deg + config_.max_turn_deg_per_metre * way;
  const double edge = std::sqrt(kPoseLimit);
  double offset2 = square((config_.max_offset + config_.max_drift * way) / edge);
  double turn2 = square(turn * std::numbers::pi / 180 / edge);
  for (const Gap& gap : gaps_) {
    if (gap.path_length < since) continue;
    const double turned = gap.covariance.bottomRightCorner<3, 3>().trace();
    offset2 += gap.covariance.topLeftCorner<3, 3>().trace() +
               turned * square(path_length - gap.path_length);
    turn2 += turned;
  }
  return isotropic_covariance(std::sqrt(offset2), std::sqrt(turn2));
}

/// What the surveys of a registered tag that is not mapped yet and of the one seen last add to
/// where it is expected, in its own frame: the other's turn swings all that lies beyond.
Matrix6d TagGates::doubt_of_survey(const TagSighting& sighting) const {
  const RegisteredTag* tag = registered(sighting);
  const Visit* last = reference(sighting);
  if (tag == nullptr || last == nullptr || is_exact(tag->survey)) return Matrix6d::Zero();
  const RegisteredTag& other = *registered(*last);
  const Matrix6d of_other = slam::survey_covariance(other.survey) + last->mapped;
  return slam::survey_covariance(tag->survey) +
         carry_covariance(of_other, other.T_world_tag.inverse() * tag->T_world_tag);
}

/// Whether the tag is where the map has it, or its place is not known.
bool TagGates::is_in_place(const TagSighting& sighting, const Pose& T_map_body, double path_length,
                           const Map& map) const {
  const auto known = placed(sighting, map);
  if (!known) return true;
  const Visit* last = reference(sighting);
  const Pose T_body_seen = T_body_tag(sighting, cameras_);
  Matrix6d expected =
      covariance(sighting) +
      carry_covariance(drift(last != nullptr ? last->path_length : 0, path_length), T_body_seen);
  const Visit* own = visit(sighting);
  expected += own != nullptr ? own->mapped : doubt_of_survey(sighting);
  return pose_chi_squared(T_map_body * T_body_seen, known->T_ref_tag, expected) <= kPoseLimit;
}

/// Whether another tag of the same name is seen elsewhere, and the map does not say which is meant.
bool TagGates::is_doubled(const TagSighting& sighting, const FrameFeatures& frame,
                          const Pose& T_map_body, double path_length, const Map& map) const {
  const Matrix6d own = covariance(sighting) + isotropic_covariance(kFrameOffset, kFrameTurn);
  return std::ranges::any_of(frame.tags, [&](const TagSighting& other) {
    if (&other == &sighting || !same_tag(other, sighting) || other.ambiguous) return false;
    if (!is_in_place(other, T_map_body, path_length, map)) return false;
    return pose_chi_squared(T_body_tag(sighting, cameras_), T_body_tag(other, cameras_),
                            own + covariance(other)) > kPoseLimit;
  });
}

/// Whether the frame before saw the tag in the same place.
bool TagGates::is_confirmed(const Return& now, const std::vector<Return>& before) const {
  return std::ranges::any_of(before, [&](const Return& then) {
    if (!same_tag(then.sighting, now.sighting)) return false;
    if (to_seconds(now.stamp - then.stamp) > kInARow) return false;
    const Matrix6d expected = covariance(now.sighting) + covariance(then.sighting) +
                              isotropic_covariance(kFrameOffset, kFrameTurn);
    return pose_chi_squared(now.T_map_tag, then.T_map_tag, expected) <= kPoseLimit;
  });
}

/// Whether there was an odometry gap since a visit that says where the tag is.
bool TagGates::crossed_gap(const TagSighting& sighting) const {
  const Visit* last = reference(sighting);
  return last != nullptr && !gaps_.empty() && gaps_.back().path_length >= last->path_length;
}

std::optional<Pose> TagGates::pose_across_gap(const std::vector<TagSighting>& sightings,
                                              const Pose& T_map_body, double path_length,
                                              const Map& map) const {
  std::vector<PlacedSighting> elsewhere;
  for (const TagSighting& sighting : sightings) {
    if (sighting.ambiguous || !crossed_gap(sighting)) continue;
    if (is_in_place(sighting, T_map_body, path_length, map)) continue;
    if (const auto tag = placed(sighting, map)) elsewhere.push_back(*tag);
  }
  return locate_by_tags(elsewhere, cameras_, config_.corner_sigma);
}

int TagGates::open_gap(const std::vector<TagSighting>& sightings, Map& map) {
  for (const TagSighting& sighting : sightings) std::erase(rejected_, name_of(sighting));
  Gap& last = gaps_.back();
  last.covariance = isotropic_covariance(kAnywhere, kAnyTurn);
  map.keyframe(last.keyframe).link->covariance = last.covariance;
  return last.keyframe;
}

void TagGates::reject(const TagSighting& sighting) {
  if (std::ranges::count(rejected_, name_of(sighting)) == 0) {
    rejected_.push_back(name_of(sighting));
  }
}

std::vector<RejectedTag> TagGates::gate(FrameFeatures& frame, const Pose& T_map_body,
                                        double path_length, const Map& map) {
  std::vector<TagSighting> believed;
  std::vector<RejectedTag> rejected;
  std::vector<Return> returns;
  std::vector<Return> misplaced;
  for (const TagSighting& sighting : frame.tags) {
    const auto leave_out = [&](TagRejection reason) {
      rejected.push_back({sighting.family, sighting.id, sighting.camera, reason});
    };
    const Return now{sighting, frame.stamp, T_map_body * T_body_tag(sighting, cameras_)};
    if (sighting.ambiguous) {
      leave_out(TagRejection::kAmbiguous);
    } else if (!is_in_place(sighting, T_map_body, path_length, map)) {
      reject(sighting);
      leave_out(TagRejection::kMisplaced);
      if (is_confirmed(now, misplaced_)) hear(now, path_length, map);
      misplaced.push_back(now);
    } else if (is_doubled(sighting, frame, T_map_body, path_length, map)) {
      reject(sighting);
      leave_out(TagRejection::kDuplicate);
    } else if (was_left(sighting, frame.stamp, path_length)) {
      returns.push_back(now);
      if (is_confirmed(now, returns_) && is_sure(sighting)) believed.push_back(sighting);
    } else {
      believed.push_back(sighting);
    }
  }
  frame.tags = std::move(believed);
  returns_ = std::move(returns);
  misplaced_ = std::move(misplaced);
  return rejected;
}

/// Enters a registered tag that two frames in a row saw elsewhere.
void TagGates::hear(const Return& misplaced, double path_length, const Map& map) {
  const TagSighting& sighting = misplaced.sighting;
  const RegisteredTag* tag = registered(sighting);
  if (tag == nullptr || map.keyframes().empty()) return;
  const Keyframe& last = map.keyframes().back();
  dissent_.hear({sighting.family, sighting.id, tag->T_world_tag, last.id,
                 last.T_map_body.inverse() * misplaced.T_map_tag,
                 covariance(sighting) + survey_covariance(sighting), path_length, sighting});
  unsettled_ = true;
}

/// Whether all of the group was seen after an odometry gap, and no registered tag that is believed.
bool TagGates::dissents_since_gap(const std::vector<TagWitness>& group) const {
  if (gaps_.empty()) return false;
  const double gap = gaps_.back().path_length;
  const auto since = [&](const auto& seen) { return seen.path_length >= gap; };
  return std::ranges::all_of(group, since) && std::ranges::none_of(visits_, [&](const Visit& v) {
           return registered(v) != nullptr && since(v);
         });
}

/// Lets the group say how the map lies in the world.
void TagGates::adopt(const std::vector<TagWitness>& group, Map& map) {
  std::vector<FoundTag> found;
  for (const TagWitness& witness : group) {
    found.push_back(witness.found(map));
    std::erase(rejected_, name_of(witness));
  }
  map.world() = likeliest_world(found);
  for (MapTag& tag : map.tags()) {
    if (!tag.registered()) continue;
    tag.fixed = false;
    tag.survey.reset();
    disowned_.push_back(name_of(tag));
  }
}

std::optional<Pose> TagGates::settle_dissent(const Pose& T_map_body, Map& map) {
  if (!std::exchange(unsettled_, false)) return std::nullopt;
  auto group = dissent_.agreeing(
      map, [&](double since, double path_length) { return drift(since, path_length); });
  if (group.size() > 1 && dissents_since_gap(group)) {
    for (const TagWitness& witness : group) std::erase(rejected_, name_of(witness));
    const FoundTag last = group.back().found(map);
    dissent_.forget();
    return *map.world() * last.T_world_tag * last.T_map_tag.inverse() * T_map_body;
  }
  // One that was seen elsewhere before was moved meanwhile: it says nothing of the survey.
  std::erase_if(group,
                [&](const TagWitness& w) { return map.find_tag(w.family, w.id) != nullptr; });
  const auto believed = std::ranges::count_if(map.tags(), &MapTag::registered);
  if (static_cast<long>(group.size()) <= believed) return std::nullopt;
  adopt(group, map);
  dissent_.forget();
  return std::nullopt;
}

}  // namespace vinebench::slam

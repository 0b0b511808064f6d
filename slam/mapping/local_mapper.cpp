// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/mapping/local_mapper.h"

#include <algorithm>
#include <cmath>

#include "slam/frame/measurements.h"
#include "slam/mapping/triangulation.h"
#include "slam/matching/match_refiner.h"
#include "slam/matching/projection_matcher.h"

namespace vinebench::slam {
namespace {

/// Keyframes after which features that no landmark is tied to lose their patches, 0.19 of a
/// keyframe's 0.66 MB. One that is tied later all the same is found by the patches of others.
constexpr int kPatchesForAll = 300;

/// A landmark is, by definition, what is seen where it was first found.
void place(StereoView& view, std::size_t feature) {
  if (view.placed.empty()) view.placed.assign(view.features.size(), 0);
  view.placed[feature] = 1;
}

}  // namespace

int LocalMapper::insert(const TrackedFrame& tracked, const EstimatorRig& rig, Map& map) const {
  const int id = map.add_keyframe(tracked.frame, tracked.motion.T_map_body, tracked.associations);
  std::vector<int> touched;
  for (std::size_t v = 0; v < tracked.frame->views.size(); ++v) {
    const StereoView& view = tracked.frame->views[v];
    for (std::size_t f = 0; f < view.features.size(); ++f) {
      int landmark = map.keyframe(id).landmarks[v][f];
      const auto depth =
          landmark < 0 && f < view.detected()
              ? first_depth(rig.left_cameras[v], settings_.far_depth_baselines, view, f)
              : std::nullopt;
      if (depth) {
        const Eigen::Vector3d p_map = stereo_point(*tracked.frame, v, static_cast<int>(f), *depth,
                                                   tracked.motion.T_map_body, rig);
        landmark = map.add_landmark(p_map, {id, static_cast<int>(v), static_cast<int>(f)});
        if (settings_.refinement) place(tracked.frame->views[v], f);
      }
      if (landmark >= 0) touched.push_back(landmark);
    }
  }
  for (const int landmark : touched) map.refresh(landmark, rig.T_body_cams);
  if (settings_.refinement) {
    map.keyframe(id).patches = cut_patches(*tracked.frame, map.keyframe(id).landmarks, rig.noise);
  }
  for (StereoView& view : tracked.frame->views) view.close();
  if (id >= kPatchesForAll) {
    Keyframe& old = map.keyframe(id - kPatchesForAll);
    for (std::size_t v = 0; v < old.patches.size(); ++v) {
      if (old.patches[v].size() > 0) old.patches[v].keep_tied(old.landmarks[v]);
    }
  }
  return id;
}

void LocalMapper::extend(int keyframe, const EstimatorRig& rig, Map& map) const {
  cull(keyframe, map);
  triangulate(keyframe, rig, map);
  fuse(keyframe, rig, map);
}

AdjustmentOptions LocalMapper::adjustment_options() const {
  AdjustmentOptions options;
  options.iterations = settings_.mapping.iterations;
  options.tag_corner_sigma = settings_.tag_corner_sigma;
  options.inertial = settings_.inertial;
  return options;
}

std::unique_ptr<AdjustmentJob> LocalMapper::local_adjustment(int keyframe, const Map& map,
                                                             const EstimatorRig& rig) const {
  return std::make_unique<AdjustmentJob>(map, local_window(map, keyframe, settings_.mapping.window),
                                         rig, adjustment_options());
}

void LocalMapper::cull(int keyframe, Map& map) const {
  const int due = keyframe - settings_.mapping.trial_keyframes;
  for (const Landmark& landmark : map.begun_with(due)) {
    if (landmark.removed) continue;
    if (count_keyframes(landmark) < settings_.mapping.min_observations) {
      map.remove_landmark(landmark.id);
    }
  }
}

void LocalMapper::fuse(int keyframe, const EstimatorRig& rig, Map& map) const {
  const std::vector<int> neighbours = map.covisible(keyframe, settings_.mapping.neighbours);
  const std::vector<int> mine = landmark_ids(map.keyframe(keyframe).landmarks);
  std::vector<int> theirs;
  for (const int neighbour : neighbours) {
    fuse_into(mine, neighbour, rig, map);
    const std::vector<int> ids = landmark_ids(map.keyframe(neighbour).landmarks);
    theirs.insert(theirs.end(), ids.begin(), ids.end());
  }
  std::sort(theirs.begin(), theirs.end());
  theirs.erase(std::unique(theirs.begin(), theirs.end()), theirs.end());
  fuse_into(theirs, keyframe, rig, map);
}

void LocalMapper::fuse_into(const std::vector<int>& landmarks, int keyframe_id,
                            const EstimatorRig& rig, Map& map) const {
  // The same search as tracking's second one: poses of neighbours agree to a few pixels.
  const ProjectionSearch search{3.0, settings_.max_hamming, 1.0};
  const Keyframe& keyframe = map.keyframe(keyframe_id);
  const Pose T_map_body = keyframe.T_map_body;
  for (std::size_t v = 0; v < rig.left_cameras.size(); ++v) {
    const Pose T_body_map = view_pose(*keyframe.frame, v, T_map_body, rig).inverse();
    for (const int id : landmarks) {
      const Landmark& landmark = map.landmark(id);
      if (landmark.removed) continue;
      const bool sees = std::any_of(
          landmark.observations.begin(), landmark.observations.end(), [&](const Observation& o) {
            return o.keyframe == keyframe_id && o.view == static_cast<int>(v);
          });
      if (sees) continue;
      const StereoView& view = map.keyframe(keyframe_id).frame->views[v];
      const int f = find_feature(landmark, view, static_cast<int>(v), T_body_map, rig,
                                 map.level_scale(), search, nullptr);
      if (f < 0) continue;
      const int other = map.keyframe(keyframe_id).landmarks[v][static_cast<std::size_t>(f)];
      if (other < 0) {
        map.add_observation(id, {keyframe_id, static_cast<int>(v), f});
      } else if (other != id) {
        const bool other_is_better =
            count_keyframes(map.landmark(other)) > count_keyframes(landmark);
        map.merge(other_is_better ? id : other, other_is_better ? other : id);
      }
    }
  }
}

void LocalMapper::triangulate(int keyframe, const EstimatorRig& rig, Map& map) const {
  for (const int neighbour : map.covisible(keyframe, settings_.mapping.neighbours)) {
    for (std::size_t v = 0; v < rig.left_cameras.size(); ++v) {
      triangulate_between(keyframe, neighbour, static_cast<int>(v), rig, map);
    }
  }
}

void LocalMapper::triangulate_between(int newer, int older, int view, const EstimatorRig& rig,
                                      Map& map) const {
  const auto v = static_cast<std::size_t>(view);
  const std::vector<EpipolarMatch> matches =
      match_epipolar(map.keyframe(newer), map.keyframe(older), view, rig,
                     {settings_.max_hamming * 3 / 4, settings_.second_best, settings_.min_depth});
  for (const EpipolarMatch& match : matches) {
    if (map.keyframe(newer).landmarks[v][static_cast<std::size_t>(match.feature_a)] >= 0 ||
        map.keyframe(older).landmarks[v][static_cast<std::size_t>(match.feature_b)] >= 0) {
      continue;
    }
    const int id = map.add_landmark(match.p_map, {newer, view, match.feature_a});
    map.add_observation(id, {older, view, match.feature_b});
    map.refresh(id, rig.T_body_cams);
  }
}

}  // namespace vinebench::slam

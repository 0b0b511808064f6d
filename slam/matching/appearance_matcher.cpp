// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/matching/appearance_matcher.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace vinebench::slam {
namespace {

/// Keyframes nearer than this, looking the same way, are one place.
constexpr double kSamePlace = 0.5;                              // m
constexpr double kSameHeading = 30.0 * std::numbers::pi / 180;  // rad

constexpr int kNeighbours = 6;

struct Nearest {
  int landmark = -1;
  int distance = 257;  ///< bits
  int next_landmark = -1;
  int next = 257;  ///< bits, of the next most like
};

Nearest nearest(const Map& map, const std::vector<int>& landmarks, const Descriptor& descriptor) {
  Nearest found;
  for (const int id : landmarks) {
    const int distance = hamming_distance(map.landmark(id).descriptor, descriptor);
    if (distance < found.distance) {
      found.next = std::exchange(found.distance, distance);
      found.next_landmark = std::exchange(found.landmark, id);
    } else if (distance < found.next) {
      found.next = distance;
      found.next_landmark = id;
    }
  }
  return found;
}

/// Descriptors of features spread evenly over the views and their lists.
std::vector<Descriptor> spread_features(const FrameFeatures& frame, int queries) {
  std::size_t total = 0;
  for (const StereoView& view : frame.views) total += view.features.size();
  const std::size_t count = std::min(total, static_cast<std::size_t>(queries));
  std::vector<Descriptor> all;
  for (const StereoView& view : frame.views) {
    all.insert(all.end(), view.features.descriptors.begin(), view.features.descriptors.end());
  }
  std::vector<Descriptor> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(all[i * total / count]);
  return chosen;
}

/// One to each keyframe that sees the landmark.
void vote_for(const Landmark& landmark, std::vector<int>& votes) {
  int last = -1;
  for (const Observation& o : landmark.observations) {
    if (o.keyframe != last) ++votes[static_cast<std::size_t>(o.keyframe)];
    last = o.keyframe;
  }
}

bool same_place(const Keyframe& a, const Keyframe& b) {
  return (a.T_map_body.translation - b.T_map_body.translation).norm() < kSamePlace &&
         angle_of(a.T_map_body.rotation.conjugate() * b.T_map_body.rotation) < kSameHeading;
}

}  // namespace

std::vector<double> resemblance(const Map& map, const FrameFeatures& frame, int queries,
                                int max_hamming) {
  std::vector<int> known;
  std::vector<int> landmarks(map.keyframes().size(), 0);
  for (const Landmark& landmark : map.landmarks()) {
    if (landmark.removed) continue;
    known.push_back(landmark.id);
    vote_for(landmark, landmarks);
  }
  std::vector<int> votes(map.keyframes().size(), 0);
  int cast = 0;
  const auto vote = [&](int id, int distance) {
    if (distance > max_hamming) return;
    vote_for(map.landmark(id), votes);
    ++cast;
  };
  // Two votes a feature, so that of two places that look the same both are found.
  for (const Descriptor& descriptor : spread_features(frame, queries)) {
    const Nearest found = nearest(map, known, descriptor);
    vote(found.landmark, found.distance);
    vote(found.next_landmark, found.next);
  }
  std::vector<double> scores(votes.size(), 0);
  for (std::size_t k = 0; k < votes.size(); ++k) {
    const double chance = static_cast<double>(cast) * landmarks[k] /
                          std::max<double>(1, static_cast<double>(known.size()));
    scores[k] = (votes[k] - chance) / std::sqrt(chance + 1);
  }
  return scores;
}

std::vector<int> keyframes_alike(const Map& map, const std::vector<double>& resemblance,
                                 int at_most) {
  std::vector<std::pair<double, int>> ranked;  // negated resemblance, keyframe
  for (std::size_t k = 0; k < resemblance.size(); ++k) {
    ranked.emplace_back(-resemblance[k], static_cast<int>(k));
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<int> chosen;
  for (const auto& [negated, id] : ranked) {
    if (static_cast<int>(chosen.size()) == at_most) break;
    const bool known = std::any_of(chosen.begin(), chosen.end(), [&, k = id](int other) {
      return same_place(map.keyframe(k), map.keyframe(other));
    });
    if (!known) chosen.push_back(id);
  }
  return chosen;
}

std::vector<int> landmarks_around(const Map& map, int keyframe) {
  std::vector<int> ids = landmark_ids(map.keyframe(keyframe).landmarks);
  for (const int neighbour : map.covisible(keyframe, kNeighbours)) {
    const std::vector<int> more = landmark_ids(map.keyframe(neighbour).landmarks);
    ids.insert(ids.end(), more.begin(), more.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

Associations match_by_appearance(const Map& map, const std::vector<int>& landmarks,
                                 const FrameFeatures& frame, int max_hamming, double second_best) {
  Associations associations = no_associations(frame);
  for (std::size_t v = 0; v < frame.views.size(); ++v) {
    const std::vector<Descriptor>& descriptors = frame.views[v].features.descriptors;
    std::vector<std::pair<int, int>> taken_by(map.landmarks().size(), {257, -1});
    for (std::size_t f = 0; f < descriptors.size(); ++f) {
      const Nearest found = nearest(map, landmarks, descriptors[f]);
      if (found.distance > max_hamming || found.distance >= second_best * found.next) continue;
      auto& [distance, feature] = taken_by[static_cast<std::size_t>(found.landmark)];
      if (found.distance >= distance) continue;
      if (feature >= 0) associations[v][static_cast<std::size_t>(feature)] = -1;
      distance = found.distance;
      feature = static_cast<int>(f);
      associations[v][f] = found.landmark;
    }
  }
  return associations;
}

}  // namespace vinebench::slam

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"

namespace vinebench::slam {

/// What is asked of a relocalisation. Rows of vines look alike: a false pose is worse than none.
struct RelocaliserOptions {
  int queries = 300;           ///< features of a frame that vote for keyframes
  int candidates = 5;          ///< places in the map that are looked at closely
  int max_hamming = 60;        ///< bits
  double second_best = 0.85;   ///< the best must be below this share of the second best
  int samples = 300;           ///< drawn of three matches each, a candidate
  double pixel_limit = 4;      ///< px of the feature's level, of an inlier while sampling
  int min_consensus = 15;      ///< inliers of the sampling
  int min_inliers = 40;        ///< in the end, over all cameras
  double min_share = 0.5;      ///< of the matches in the end, and of each camera's
  double max_rival = 0.6;      ///< another place must have less than this share of the inliers
  double memory = 0.5;         ///< s, in which the resemblance that earlier frames had fades
  double max_speed = 2;        ///< m/s, between two frames in a row that must agree
  double max_turn = 2;         ///< rad/s, likewise
  double max_gap_seconds = 1;  ///< between the two frames
  bool unsure = false;         ///< also what most matches contradict, if there is a hint of it
};

/// A pose found in one frame, with the evidence for it.
struct Relocation {
  Pose T_map_body;
  int inliers = 0;
  /// Most of the matches say so, of all cameras and of each. Else, only that each camera has more
  /// matches there than chance gives it where it looks elsewhere: a hint, as under another sun.
  bool is_sure = true;
  Matrix6d information = Matrix6d::Zero();  ///< as MotionEstimate has it
};

/// Whether a frame was taken near one of these keyframes, by appearance alone: it is matched with
/// the landmarks of each, and a pose is sought that many of them agree on (three points in one
/// camera: Gao et al. 2003; RANSAC: Fischler and Bolles 1981), then adjusted over all cameras. None
/// unless the evidence is strong (or a hint, if that is asked for) and no other place fits nearly
/// as well. Draws depend on the frame's index alone.
std::optional<Relocation> relocate_among(const Map& map, const EstimatorRig& rig,
                                         const FrameFeatures& frame,
                                         const std::vector<int>& keyframes,
                                         const RelocaliserOptions& options);

/// Believes a relocation that is sure once two frames, each by itself, agree on it: two in a row,
/// or with others between them, if the wheels say the same of the way from one to the other.
/// Believes hints once three frames agree by the wheels, and two more for each that contradicts.
/// Looks closely where this frame and those just before it together resemble the map most: under
/// another sun a place is hardly more like itself than others are.
class Relocaliser {
 public:
  explicit Relocaliser(const RelocaliserOptions& options = {}) : options_(options) {
    options_.unsure = true;
  }

  /// Whether the last frame resembled a place, which the next one may confirm.
  bool has_candidate() const { return !found_.empty() && found_.back().stamp == stamp_; }

  /// The last frame was found otherwise: it confirms no candidate.
  void forget() { found_.clear(); }

  /// The body's pose in the map, or none (yet).
  std::optional<Pose> find(const Map& map, const EstimatorRig& rig, const FrameFeatures& frame);

 private:
  /// What a frame found, lately.
  struct Found {
    Pose T_map_body;
    bool is_sure = true;
    Stamp stamp = 0;
    std::optional<Pose> way = Pose{};  ///< of the body since then, by its wheels
    bool is_last = true;               ///< no frame was between
  };

  void remember(const std::vector<double>& resemblance, Stamp stamp);
  void follow(const FrameFeatures& frame);
  bool follows_at_once(const Found& before, const Relocation& now, Stamp stamp) const;
  bool believes(const Relocation& now, Stamp stamp) const;

  RelocaliserOptions options_;
  std::vector<double> resemblance_;  ///< of each keyframe, to this frame and those before it
  Stamp stamp_ = 0;                  ///< of the last frame
  std::vector<Found> found_;         ///< the oldest first
};

}  // namespace vinebench::slam

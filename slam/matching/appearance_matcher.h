// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "slam/map/map.h"

namespace vinebench::slam {

/// How much each keyframe of the map resembles the frame: each of `queries` features, spread over
/// the frame, votes for the keyframes of the two landmarks of the map that are most like it; by how
/// many standard deviations a keyframe has more votes than its share of all landmarks would give
/// it. Brute force: its time grows with the landmarks of the map.
std::vector<double> resemblance(const Map& map, const FrameFeatures& frame, int queries,
                                int max_hamming);

/// Ids of the keyframes that resemble it most, best first, one for each place.
std::vector<int> keyframes_alike(const Map& map, const std::vector<double>& resemblance,
                                 int at_most);

/// Landmarks of a keyframe and of those that share most with it, ascending.
std::vector<int> landmarks_around(const Map& map, int keyframe);

/// Ties features to landmarks by appearance alone, whichever camera saw either: each to the
/// landmark most like it, where no other is nearly as like, nor a feature of that view more like
/// that landmark.
Associations match_by_appearance(const Map& map, const std::vector<int>& landmarks,
                                 const FrameFeatures& frame, int max_hamming, double second_best);

}  // namespace vinebench::slam

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/placement/tag_plan.h"

namespace vinebench::harness {

/// The planned tags in the order of rows and posts, numbered from 0.
std::vector<TagCandidate> planned_tags(const std::vector<TagCandidate>& candidates,
                                       const TagPlan& plan);

/// The text of a world file with these tags in place of those that it has.
std::string with_tags(const std::string& text, const std::vector<TagCandidate>& tags);

/// For the person with the ladder: a line for each tag with its row, post and side (seen along the
/// row from its start), height, place and direction, in m and degrees. Rows and posts count from 1.
std::string tag_list(const std::vector<TagCandidate>& tags);

/// The vineyard from above as SVG: rows, posts, the drive coloured by its predicted error, and the
/// tags with their numbers.
std::string plan_svg(const sim::WorldConfig& world, const std::vector<Pose>& poses,
                     const std::vector<TagCandidate>& tags, const TagPlan& plan);

}  // namespace vinebench::harness

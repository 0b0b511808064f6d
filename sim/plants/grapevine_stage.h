// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vinebench::sim {

/// A growth stage of the extended BBCH scale for grapes (Lorenz et al. 1995). Shares are relative
/// to the vine in full leaf at harvest.
struct GrowthStage {
  int bbch = 89;
  const char* name = "harvest";
  float shoot = 1;         ///< length of the shoots
  float leaf = 1;          ///< length of the leaves
  float foliage = 1;       ///< leaf area
  float autumn = 0;        ///< share of leaves with autumn colour
  float bunch = 1;         ///< length of the bunches; 0 without any
  float berry = 1;         ///< diameter of the berries
  float ripe = 1;          ///< share of berries with ripe colour
  float lignified = 0.6f;  ///< shoots from green to brown

  /// Width of the bunches, as a share: bunches are narrower before the berries swell.
  float bunch_width() const { return 0.2f + 0.8f * berry; }
};

/// Stages 0, 9, 65, 75, 79, 83, 89 and 95. Throws Error that names them for any other.
const GrowthStage& growth_stage(int bbch);

/// Share of the ground's green that has dried or died back at that stage, 0 to 1.
double withered_share(int bbch);

/// Cloud cover of most days at that stage, 0 to 1: winter is dull.
double usual_overcast(int bbch);

}  // namespace vinebench::sim

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/plants/grapevine.h"

namespace vinebench::sim {

/// How finely a bunch is drawn.
struct BunchDetail {
  int triangles = 0;    ///< of all the berries of a bunch, at most; 0 draws one solid
  bool fine = false;    ///< berries that are round to their backs, where they face outwards
  int sides = 6;        ///< of the solid, the core of the berries
  bool coarse = false;  ///< the solid has two rings of sides, not four

  constexpr int solid_triangles() const { return 2 * sides * (coarse ? 2 : 4); }
};

/// Appends a bunch; its vertices carry `part`. The lowest one lies at the bunch's very bottom.
void add_bunch(Primitive& primitive, const Bunch& bunch, int part, const BunchDetail& detail);

/// Berries on the surface of the bunch, those inside left out.
int visible_berries(const Bunch& bunch);

}  // namespace vinebench::sim

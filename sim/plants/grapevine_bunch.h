// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/plants/grapevine_shape.h"

namespace vinebench::sim {

/// Level of detail of a bunch.
struct BunchDetail {
  int triangles = 0;    ///< of all berries of a bunch, at most; 0: one solid
  bool fine = false;    ///< hemispheres that face outwards
  int sides = 6;        ///< of the solid, the core of the berries
  bool coarse = false;  ///< the solid has two rings of sides, not four

  constexpr int solid_triangles() const { return 2 * sides * (coarse ? 2 : 4); }
};

/// Appends a bunch; its vertices have `part`. The lowest vertex is at the bunch's bottom.
void add_bunch(Primitive& primitive, const Bunch& bunch, int part, const BunchDetail& detail);

/// Number of berries on the surface of the bunch.
int visible_berries(const Bunch& bunch);

}  // namespace vinebench::sim

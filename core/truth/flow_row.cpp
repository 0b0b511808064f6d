// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/flow_row.h"

#include <limits>

// The rows are compiled once for each kind of vectors; the processor's is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/truth/flow_row.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vinebench::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr double kNearest = 1e-3;      // m in front of a camera; nearer points are not in its image
constexpr double kShare = 1e-3;        // of depth: levels of detail, rounding
constexpr double kResolution = 4e-6;   // 1/m: depth of 32 bits from 0.03 m on, twice
constexpr double kSlopeShare = 0.25;   // px, of the depth's slope
constexpr double kMostBySlope = 0.01;  // of depth

using Lanes = hn::CappedTag<double, 8>;
using OneLane = hn::CappedTag<double, 1>;

/// Calls `lanes` with a tag and the pixel that its lanes begin at, for all of a row.
template <class Take>
HWY_INLINE void for_row(std::size_t width, const Take& take) {
  std::size_t x = 0;
  for (; x + hn::Lanes(Lanes()) <= width; x += hn::Lanes(Lanes())) take(Lanes(), x);
  for (; x < width; ++x) take(OneLane(), x);
}

template <class D>
HWY_INLINE hn::Vec<D> load_depths(D d, const float* depths) {
  return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, D>(), depths));
}

template <class D>
HWY_INLINE void place_lanes(D d, std::size_t at, const float* depths, const double* columns,
                            const RowInView& row, const std::array<double*, 3>& points) {
  const auto depth = load_depths(d, depths + at);
  const auto sky = hn::Eq(depth, hn::Zero(d));
  const auto reach = hn::IfThenElse(sky, hn::Set(d, 1.0), depth);
  const auto column = hn::LoadU(d, columns + at);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto ray =
        hn::Add(hn::Mul(hn::Set(d, row.across[axis]), column), hn::Set(d, row.ahead[axis]));
    const auto moved = hn::IfThenZeroElse(sky, hn::Set(d, row.moved[axis]));
    hn::StoreU(hn::Add(hn::Mul(reach, ray), moved), d, points[axis] + at);
  }
}

void place_row(const float* depths, const double* columns, std::size_t width, const RowInView& row,
               const std::array<double*, 3>& points) {
  for_row(width, [&](auto d, std::size_t at)
                     HWY_ATTR { place_lanes(d, at, depths, columns, row, points); });
}

/// Of several points in b's camera frame.
template <class V>
struct Points {
  V x, y, z;
};

/// Which of the points at `inside`, whose nearest pixels of b are u and v, b sees. The plane seen
/// there is n . p = n . (seen * ray); a ray of z = 1 meets it at the depth n . (seen * ray) / n .
/// ray'.
template <class D, class M, class I>
HWY_INLINE M seen_lanes(D d, const FlowTarget& b, M inside, M sky, I u, I v,
                        const Points<hn::Vec<D>>& p) {
  const hn::Rebind<std::int32_t, D> integers;
  const hn::Rebind<float, D> floats;
  const auto pixel = hn::Add(hn::Mul(v, hn::Set(integers, b.width)), u);
  const auto seen = hn::PromoteTo(d, hn::GatherIndex(floats, b.depth, pixel));
  const auto empty = hn::Eq(seen, hn::Zero(d));
  const auto first = hn::Mul(pixel, hn::Set(integers, 3));
  const auto n_x = hn::PromoteTo(d, hn::GatherIndex(floats, b.normals, first));
  const auto n_y = hn::PromoteTo(d, hn::GatherIndex(floats, b.normals + 1, first));
  const auto n_z = hn::PromoteTo(d, hn::GatherIndex(floats, b.normals + 2, first));
  const auto ray = [&](I at, double centre, double focal) HWY_ATTR {
    return hn::Div(hn::Sub(hn::PromoteTo(d, at), hn::Set(d, centre)), hn::Set(d, focal));
  };
  const auto facing =
      hn::Add(hn::Add(hn::Mul(n_x, ray(u, b.cx, b.fx)), hn::Mul(n_y, ray(v, b.cy, b.fy))), n_z);
  // Both sides times n . ray' * z: divisions are for the few that do not agree at once.
  const auto along = hn::Add(hn::Mul(n_x, p.x), hn::Add(hn::Mul(n_y, p.y), hn::Mul(n_z, p.z)));
  const auto off = hn::Abs(hn::Mul(p.z, hn::Sub(along, hn::Mul(seen, facing))));
  const auto usual =
      hn::Mul(seen, hn::Add(hn::Set(d, kShare), hn::Mul(hn::Set(d, kResolution), seen)));
  const auto along_size = hn::Abs(along);
  const auto solid =
      hn::And(hn::AndNot(hn::Or(sky, empty), inside), hn::Gt(along_size, hn::Zero(d)));
  const auto agrees = hn::And(solid, hn::Le(off, hn::Mul(usual, along_size)));
  const auto visible = hn::Or(agrees, hn::And(inside, hn::And(sky, empty)));
  const auto others = hn::AndNot(agrees, solid);
  if (hn::AllFalse(d, others)) return visible;
  const auto a = hn::Div(n_x, hn::Set(d, b.fx));
  const auto c = hn::Div(n_y, hn::Set(d, b.fy));
  const auto steepness = hn::Sqrt(hn::Add(hn::Mul(a, a), hn::Mul(c, c)));
  const auto slope = hn::Div(hn::Mul(seen, steepness), hn::Abs(facing));
  const auto allowed =
      hn::Min(hn::Mul(hn::Set(d, kSlopeShare), slope), hn::Mul(hn::Set(d, kMostBySlope), seen));
  const auto too_far = hn::Sub(hn::Div(off, along_size), usual);
  return hn::Or(visible, hn::And(others, hn::Le(too_far, allowed)));
}

template <class D>
HWY_INLINE void find_lanes(D d, std::size_t at, const FlowTarget& b, const float* depths, int y,
                           const std::array<const double*, 3>& points, float* flow,
                           std::uint8_t* visible) {
  const hn::Rebind<std::int32_t, D> integers;
  const hn::Rebind<float, D> floats;
  const hn::Rebind<std::uint8_t, D> bytes;
  const Points<hn::Vec<D>> p{hn::LoadU(d, points[0] + at), hn::LoadU(d, points[1] + at),
                             hn::LoadU(d, points[2] + at)};
  const auto project = [&](hn::Vec<D> across, double focal, double centre) HWY_ATTR {
    return hn::Add(hn::Mul(hn::Set(d, focal), hn::Div(across, p.z)), hn::Set(d, centre));
  };
  const auto u = project(p.x, b.fx, b.cx);
  const auto v = project(p.y, b.fy, b.cy);
  const auto ahead = hn::Gt(p.z, hn::Set(d, kNearest));
  const auto none = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
  const auto flow_u = hn::Sub(u, hn::Iota(d, static_cast<double>(at)));
  const auto flow_v = hn::Sub(v, hn::Set(d, static_cast<double>(y)));
  hn::StoreInterleaved2(hn::DemoteTo(floats, hn::IfThenElse(ahead, flow_u, none)),
                        hn::DemoteTo(floats, hn::IfThenElse(ahead, flow_v, none)), floats,
                        flow + 2 * at);
  // As PinholeCamera::contains(): positions begin at -0.5.
  const auto within = [&](hn::Vec<D> position, int size) HWY_ATTR {
    return hn::And(hn::Ge(position, hn::Set(d, -0.5)), hn::Lt(position, hn::Set(d, size - 0.5)));
  };
  const auto inside = hn::And(ahead, hn::And(within(u, b.width), within(v, b.height)));
  auto shown = inside;
  if (!hn::AllFalse(d, inside)) {
    const auto nearest = [&](hn::Vec<D> position, int size) HWY_ATTR {
      const auto safe = hn::IfThenElseZero(inside, hn::Add(position, hn::Set(d, 0.5)));
      return hn::Min(hn::DemoteTo(integers, safe), hn::Set(integers, size - 1));
    };
    const auto sky = hn::Eq(load_depths(d, depths + at), hn::Zero(d));
    shown = seen_lanes(d, b, inside, sky, nearest(u, b.width), nearest(v, b.height), p);
  }
  const auto grey = hn::DemoteTo(integers, hn::IfThenElseZero(shown, hn::Set(d, 255.0)));
  hn::StoreU(hn::DemoteTo(bytes, grey), bytes, visible + at);
}

void find_row(const FlowTarget& b, const float* depths, int y,
              const std::array<const double*, 3>& points, std::size_t width, float* flow,
              std::uint8_t* visible) {
  for_row(width, [&](auto d, std::size_t at)
                     HWY_ATTR { find_lanes(d, at, b, depths, y, points, flow, visible); });
}

}  // namespace vinebench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vinebench {

HWY_EXPORT(place_row);
HWY_EXPORT(find_row);

void place_points(const float* depths, const std::vector<double>& columns, const RowInView& row,
                  FlowPoints& points) {
  HWY_DYNAMIC_DISPATCH(place_row)
  (depths, columns.data(), columns.size(), row,
   {points.x.data(), points.y.data(), points.z.data()});
}

void find_points(const FlowTarget& b, const float* depths, int y, const FlowPoints& points,
                 float* flow, std::uint8_t* visible) {
  HWY_DYNAMIC_DISPATCH(find_row)
  (b, depths, y, {points.x.data(), points.y.data(), points.z.data()}, points.z.size(), flow,
   visible);
}

}  // namespace vinebench
#endif

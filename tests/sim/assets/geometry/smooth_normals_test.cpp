// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/geometry/smooth_normals.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

constexpr float kDegree = static_cast<float>(M_PI / 180);

CornerNormals normals_of(const std::vector<Vector3f>& corners, float sharpest = 60 * kDegree) {
  return smooth_normals(
      corners.size(), [&](std::size_t i) { return corners[i]; }, sharpest);
}

/// Two squares along the y axis, one level and one that goes down by that angle.
std::vector<Vector3f> roof(float degrees) {
  const float x = std::cos(degrees * kDegree), z = -std::sin(degrees * kDegree);
  const Vector3f a(-1, 0, 0), b(0, 0, 0), c(0, 1, 0), d(-1, 1, 0), e(x, 0, z), f(x, 1, z);
  return {a, b, c, a, c, d, b, e, f, b, f, c};
}

TEST(SmoothNormalsTest, FacesWithinTheAngleShareTheirMeanAndOthersKeepAnEdge) {
  const CornerNormals curve = normals_of(roof(50)), edge = normals_of(roof(70));
  // Each square has a right angle at either end of the ridge, in one triangle or in two: half way.
  for (const std::size_t corner : {1u, 2u, 6u, 11u}) {
    const Vector3f& normal = curve.normals[curve.of_corner[corner]];
    EXPECT_LT((normal - Vector3f(std::sin(25 * kDegree), 0, std::cos(25 * kDegree))).norm(), 1e-6f);
  }
  EXPECT_EQ(curve.normals.size(), 6u);
  EXPECT_EQ(edge.normals.size(), 8u);  // two at either end of the ridge
  EXPECT_LT((edge.normals[edge.of_corner[1]] - Vector3f::UnitZ()).norm(), 1e-6f);
  EXPECT_LT((edge.normals[edge.of_corner[6]] -
             Vector3f(std::sin(70 * kDegree), 0, std::cos(70 * kDegree)))
                .norm(),
            1e-6f);
}

TEST(SmoothNormalsTest, ADegenerateTriangleTakesTheNormalsOfItsNeighbours) {
  const Vector3f a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  for (const bool first : {false, true}) {
    std::vector<Vector3f> corners{a, b, c};
    corners.insert(first ? corners.begin() : corners.end(), {a, b, b});
    const CornerNormals normals = normals_of(corners);
    EXPECT_EQ(normals.normals.size(), 3u);
    for (const Vector3f& normal : normals.normals) EXPECT_EQ(normal, Vector3f::UnitZ());
  }
  for (const Vector3f& normal : normals_of({a, a, a}).normals) EXPECT_EQ(normal, Vector3f::Zero());
}

TEST(SmoothNormalsTest, MinusZeroIsZero) {
  const Vector3f a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), same(-0.0f, -0.0f, -0.0f), d(-1, 0, 0.1f);
  const CornerNormals normals = normals_of({a, b, c, same, c, d});
  EXPECT_EQ(normals.of_corner[0], normals.of_corner[3]);
}

// A fan of 200 000 triangles about one place: quadratic work would take minutes.
TEST(SmoothNormalsTest, APlaceOfManyTrianglesIsNotSlow) {
  constexpr std::size_t kTriangles = 200'000;
  const auto rim = [](std::size_t i) {
    const float turn = 2 * static_cast<float>(M_PI) * static_cast<float>(i) / kTriangles;
    return Vector3f(std::cos(turn), std::sin(turn), 0);
  };
  const CornerNormals normals = smooth_normals(
      3 * kTriangles,
      [&](std::size_t i) { return i % 3 == 0 ? Vector3f(0, 0, 1) : rim(i / 3 + i % 3 - 1); },
      60 * kDegree);
  // Normals of a cone of 45 degrees: those at opposite sides are 90 degrees apart, and a group is
  // all within 60 of its first.
  EXPECT_LE(normals.normals.size(), kTriangles + 1 + 4);
}

}  // namespace
}  // namespace vinebench::sim

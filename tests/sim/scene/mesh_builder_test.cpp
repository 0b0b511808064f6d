// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/mesh_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vinebench::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Area of all triangles, and a sixth of the determinants: the volume where the mesh is closed.
struct Measures {
  double area = 0;
  double volume = 0;
};

Measures measures_of(const Primitive& primitive) {
  Measures measures;
  for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
    const auto p = [&](std::size_t k) -> Vector3d {
      return primitive.vertices.at(primitive.indices[i + k]).position.cast<double>();
    };
    measures.area += (p(1) - p(0)).cross(p(2) - p(0)).norm() / 2;
    measures.volume += p(0).dot(p(1).cross(p(2))) / 6;
  }
  return measures;
}

TEST(AxesTest, AreRightHandedWithXTowardsTheHint) {
  const Axes axes = axes_along({0, 0, 2}, {1, 0, 5});
  EXPECT_TRUE(axes.z.isApprox(Vector3f::UnitZ()));
  EXPECT_TRUE(axes.x.isApprox(Vector3f::UnitX()));  // the hint without its share along z
  EXPECT_TRUE(axes.y.isApprox(Vector3f::UnitY()));
  const Axes any = axes_along({0, 0, 1}, {0, 0, 1});  // a hint along the direction says nothing
  EXPECT_NEAR(any.x.dot(any.z), 0, 1e-6f);
  EXPECT_NEAR(any.x.norm(), 1, 1e-6f);
}

TEST(TextureCellTest, SpansItsPartOfTheTexture) {
  const TextureCell cell{{0.5f, 0.25f}, {1.0f, 0.75f}};
  EXPECT_TRUE(cell.at(0, 0).isApprox(Eigen::Vector2f(0.5f, 0.25f)));
  EXPECT_TRUE(cell.at(0.5f, 1).isApprox(Eigen::Vector2f(0.75f, 0.75f)));
}

// A prism of 12 sides inscribed in a cylinder of 0.1 m radius and 2 m length: a side is
// 2 r sin(15 deg), a cap 12 r^2 sin(30 deg) / 2.
TEST(MeshBuilderTest, ATubeHasThePrismsArea) {
  Primitive primitive;
  MeshBuilder(primitive, 3)
      .tube({{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}, {0.1f, 0.1f, 0.1f}}, 12, 1, true);
  constexpr double kSide = std::numbers::pi / 12;
  const double expected = 12 * 2 * (2 * 0.1 * std::sin(kSide)) + 6 * 0.01 * std::sin(2 * kSide);
  EXPECT_NEAR(measures_of(primitive).area, expected, 1e-5);
  for (const Vertex& vertex : primitive.vertices) EXPECT_EQ(vertex.part, 3);
}

TEST(MeshBuilderTest, ATubesNormalsPointAwayFromItsPath) {
  Primitive primitive;
  MeshBuilder(primitive).tube({{{0, 0, 0}, {0, 0, 1}}, {0.1f, 0.1f}}, 6, 1, false);
  for (const Vertex& vertex : primitive.vertices) {
    const Vector3f out(vertex.position.x(), vertex.position.y(), 0);
    EXPECT_NEAR(vertex.normal.dot(out), 0.1f, 1e-6f);
  }
  // v runs along the tube in metres, u once around.
  EXPECT_NEAR(primitive.vertices.back().uv.y(), 1, 1e-6f);
  EXPECT_NEAR(primitive.vertices.back().uv.x(), 1, 1e-6f);
}

TEST(MeshBuilderTest, ACardIsALeafOfFourTrianglesWithItsWholeImage) {
  BladePlacement leaf;
  leaf.foot = {1, 2, 3};
  leaf.axes = {Vector3f::UnitX(), Vector3f::UnitY(), Vector3f::UnitZ()};
  leaf.size = 2;
  leaf.curl = 0;
  leaf.shading_normal = Vector3f::Zero();
  leaf.tint = {200, 210, 190};
  Primitive primitive;
  MeshBuilder(primitive).card(leaf);
  ASSERT_EQ(primitive.vertices.size(), 6u);
  EXPECT_EQ(primitive.indices.size(), 12u);
  Eigen::AlignedBox3f box;
  Eigen::AlignedBox2f image;
  for (const Vertex& vertex : primitive.vertices) {
    box.extend(vertex.position);
    image.extend(vertex.uv);
    EXPECT_EQ(vertex.colour, leaf.tint);
  }
  // Across 2 x 1.5 about the foot; along from -0.48 to 1.02 sizes; the rim folded up by a quarter
  // of its distance from the midrib.
  EXPECT_LT((box.min() - Vector3f(1 - 1.5f, 2 - 0.96f, 3)).norm(), 1e-5f);
  EXPECT_LT((box.max() - Vector3f(1 + 1.5f, 2 + 2.04f, 3 + 2 * 0.25f * 0.75f)).norm(), 1e-5f);
  EXPECT_EQ(image.min(), Eigen::Vector2f::Zero());
  EXPECT_EQ(image.max(), Eigen::Vector2f::Ones());
}

TEST(LeafOutlineTest, EveryDetailHasTheSameArea) {
  for (const float lobes : {0.0f, 0.5f, 1.0f}) {
    const float area = leaf_outline_area(lobes);
    for (const int detail : {0, 1, 2}) {
      Primitive primitive;
      MeshBuilder builder(primitive);
      const auto& outline = leaf_outline(detail, lobes);
      for (const Eigen::Vector2f& p : outline) {
        builder.vertex({p.x(), p.y(), 0}, Vector3f::UnitZ(), p);
      }
      // Signed fans from the first point give the polygon's area, whatever its shape.
      double twice = 0;
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Eigen::Vector2f& a = outline[i];
        const Eigen::Vector2f& b = outline[(i + 1) % outline.size()];
        twice += static_cast<double>(a.x() * b.y() - a.y() * b.x());
      }
      EXPECT_NEAR(std::abs(twice) / 2, static_cast<double>(area), 1e-4) << detail << " " << lobes;
    }
  }
  EXPECT_GT(leaf_outline_area(0), leaf_outline_area(1));  // sinuses take area away
}

// Five by five points of four by four squares; x and y are those of the flat cell, z hangs by
// curl r^2, rises by a quarter of |x|, and waves by at most 0.045 r^2.
TEST(MeshBuilderTest, AFineCardIsACurvedGridOverItsCell) {
  BladePlacement leaf;
  leaf.foot = {1, 2, 3};
  leaf.axes = {Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitY(), Eigen::Vector3f::UnitZ()};
  leaf.size = 0.1f;
  leaf.curl = 0.3f;
  leaf.shading_normal.setZero();
  leaf.cell = {{0, 0}, {1, 1}};
  Primitive primitive;
  MeshBuilder(primitive).card(leaf, 4);
  ASSERT_EQ(primitive.vertices.size(), 25u);
  ASSERT_EQ(primitive.indices.size(), 3u * 2 * 16);
  for (const Vertex& v : primitive.vertices) {
    const Eigen::Vector3f p = (v.position - leaf.foot) / leaf.size;
    EXPECT_NEAR(p.x(), (2 * v.uv.x() - 1) * kLeafHalf, 1e-4);
    EXPECT_NEAR(p.y(), kLeafBottom + (1 - v.uv.y()) * 2 * kLeafHalf, 1e-4);
    const float rim = p.head<2>().squaredNorm();
    EXPECT_NEAR(p.z(), -0.3f * rim + 0.25f * std::abs(p.x()), 0.045f * rim + 1e-4f);
    EXPECT_NEAR(v.normal.norm(), 1, 1e-5);
  }
  for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {  // seen from +z
    const auto at = [&](std::size_t k) {
      return primitive.vertices[primitive.indices[i + k]].position;
    };
    EXPECT_GT((at(1) - at(0)).cross(at(2) - at(0)).z(), 0);
  }
}

TEST(MeshBuilderTest, ABerryIsRoundAndDarkerTowardsItsBack) {
  Primitive primitive;
  const Eigen::Vector3f centre(1, 2, 3), outward(0, -1, 0);
  MeshBuilder(primitive).berry(centre, 0.01f, outward, true, {{}, {200, 210, 220}, 0.8f});
  ASSERT_EQ(primitive.indices.size(), 3u * 18);  // six, and twice six below
  for (const Vertex& v : primitive.vertices) {
    const float forward = v.normal.dot(outward);
    // A radius from the middle; 5 % more beside the pole, so that the outline keeps its area.
    EXPECT_NEAR((v.position - centre).norm(), forward > 0.99f ? 0.01f : 0.0105f, 1e-5);
    EXPECT_NEAR(v.occlusion, 0.8f * (forward > 0.99f ? 1 : forward > 0 ? 0.88f : 0.55f), 1e-5);
    EXPECT_EQ(v.colour[1], 210);
  }
}

}  // namespace
}  // namespace vinebench::sim

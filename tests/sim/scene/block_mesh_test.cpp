// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/block_mesh.h"

#include <gtest/gtest.h>

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

Vector3f across(const Primitive& part, std::size_t triangle) {
  const auto corner = [&](std::size_t k) {
    return part.vertices.at(part.indices.at(3 * triangle + k)).position;
  };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0));
}

TEST(BlockMeshTest, SrgbBecomesLinear) {
  // The standard's two branches: c / 12.92 for dark ones, ((c + 0.055) / 1.055)^2.4 above; 0.5
  // gives 0.2140.
  const Vector3f linear = linear_colour({0.04, 0.5, 1});
  EXPECT_NEAR(linear.x(), 0.04 / 12.92, 1e-7);
  EXPECT_NEAR(linear.y(), 0.2140, 1e-4);
  EXPECT_NEAR(linear.z(), 1, 1e-6);
}

TEST(BlockMeshTest, AFaceLooksWhereItsSidesTurnTo) {
  Primitive part;
  MeshBuilder builder(part);
  // Seen from -y: x to the right, z up.
  add_face(builder, {1, 2, 3}, {0.5f, 0, 0}, {0, 0, 0.25f}, {{0.2f, 0.4f}, {0.6f, 0.8f}}, 0.3f);
  ASSERT_EQ(part.vertices.size(), 4u);
  ASSERT_EQ(part.indices.size(), 6u);
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_LT((across(part, t).normalized() - Vector3f(0, -1, 0)).norm(), 1e-6f);
  }
  for (const Vertex& v : part.vertices) {
    EXPECT_EQ(v.normal, Vector3f(0, -1, 0));
    const bool foot = v.position.z() == 2.75f, left = v.position.x() == 0.5f;
    EXPECT_EQ(v.position.y(), 2);
    EXPECT_EQ(v.position.z(), foot ? 2.75f : 3.25f);
    EXPECT_EQ(v.position.x(), left ? 0.5f : 1.5f);
    EXPECT_EQ(v.occlusion, foot ? 0.3f : 1.0f);
    // The cell's first row is its top.
    EXPECT_LT((v.uv - Eigen::Vector2f(left ? 0.2f : 0.6f, foot ? 0.8f : 0.4f)).norm(), 1e-6f);
  }
}

TEST(BlockMeshTest, ABlockIsClosedAndFacesOutward) {
  Primitive part;
  MeshBuilder builder(part);
  const Vector3f centre(1, -2, 0.5f), half(0.1f, 0.2f, 0.3f);
  add_block(builder, centre, half, 0.4f);
  ASSERT_EQ(part.indices.size(), 36u);
  Vector3f area = Vector3f::Zero(), open = Vector3f::Zero();
  double volume = 0;
  for (std::size_t t = 0; t < 12; ++t) {
    const Vector3f twice = across(part, t);
    const Vertex& v = part.vertices.at(part.indices.at(3 * t));
    EXPECT_GT(twice.dot(v.normal), 0);
    area += twice.cwiseAbs() / 2;
    open += twice;
    volume += static_cast<double>(twice.dot(v.position - centre)) / 6;
  }
  // Two faces each of 4 half y half z, and so on; outward they enclose 8 half x half y half z.
  EXPECT_LT((area - Vector3f(0.48f, 0.24f, 0.16f)).norm(), 1e-6f);
  EXPECT_LT(open.norm(), 1e-6f);
  EXPECT_NEAR(volume, 0.048, 1e-6);
}

TEST(BlockMeshTest, ABlocksTopIsLitWhole) {
  Primitive part;
  MeshBuilder builder(part);
  add_block(builder, {0, 0, 0}, {1, 1, 1}, 0.4f);
  for (const Vertex& v : part.vertices) {
    const bool dim = v.normal.z() < 0 ? v.uv.y() == 1 : v.normal.z() == 0 && v.position.z() < 0;
    EXPECT_EQ(v.occlusion, dim ? 0.4f : 1.0f) << v.position.transpose();
  }
}

}  // namespace
}  // namespace vinebench::sim

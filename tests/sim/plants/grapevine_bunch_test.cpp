// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/grapevine_bunch.h"

#include <gtest/gtest.h>

#include <limits>

namespace vinebench::sim {
namespace {

Bunch bunch() {
  Bunch bunch;
  bunch.top = {0.2f, 0, 1};
  bunch.berry_seed = 5;
  return bunch;
}

float lowest(const Primitive& primitive) {
  float z = std::numeric_limits<float>::max();
  for (const Vertex& vertex : primitive.vertices) z = std::min(z, vertex.position.z());
  return z;
}

TEST(BunchTest, HangsToItsLengthInEveryDetail) {
  for (const BunchDetail& detail :
       {BunchDetail{}, BunchDetail{400, false, 6, true}, BunchDetail{4000, true, 8, false}}) {
    Primitive primitive;
    add_bunch(primitive, bunch(), 1, detail);
    EXPECT_NEAR(lowest(primitive), 1 - 0.12f, 1e-4f) << detail.triangles;  // the default length
  }
}

TEST(BunchTest, ASolidHasItsTriangles) {
  const BunchDetail detail{0, false, 5, true};
  EXPECT_EQ(detail.solid_triangles(), 20);  // two rings of five quads
  Primitive primitive;
  add_bunch(primitive, bunch(), 7, detail);
  EXPECT_LE(primitive.indices.size(), 3u * 20);
  for (const Vertex& vertex : primitive.vertices) EXPECT_EQ(vertex.part, 7);
}

TEST(BunchTest, KeepsToItsBudget) {
  Primitive primitive;
  const BunchDetail detail{600, false, 6, true};
  add_bunch(primitive, bunch(), 1, detail);
  EXPECT_GT(primitive.indices.size() / 3, static_cast<std::size_t>(detail.solid_triangles()));
  EXPECT_LE(primitive.indices.size() / 3,
            static_cast<std::size_t>(detail.triangles + detail.solid_triangles()));
}

TEST(BunchTest, SmallerBerriesAreMore) {
  Bunch small = bunch();
  small.berry_radius /= 2;
  EXPECT_GT(visible_berries(small), 2 * visible_berries(bunch()));
}

}  // namespace
}  // namespace vinebench::sim

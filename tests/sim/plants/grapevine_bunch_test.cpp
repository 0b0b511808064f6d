// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/grapevine_bunch.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

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

/// Mean number of the berries' variants, from the columns and rows of their cells.
double mean_variant(float ripeness) {
  Bunch ripening = bunch();
  ripening.ripeness = ripeness;
  Primitive primitive;
  add_bunch(primitive, ripening, 1, {4000, true, 7, false});
  double sum = 0, count = 0;
  for (const Vertex& vertex : primitive.vertices) {
    if (vertex.uv.x() < 0.5f) continue;  // the core's cell is the left half
    sum += (vertex.uv.x() > 0.75f ? 1 : 0) + (vertex.uv.y() > 0.5f ? 2 : 0);
    ++count;
  }
  return sum / count;
}

// Of four variants the mean is 1.5; a bunch that is 0.4 of them ahead has most of its berries at 3.
TEST(BunchTest, BerriesRipenWithTheirBunch) {
  EXPECT_NEAR(mean_variant(0), 1.5, 0.3);
  EXPECT_GT(mean_variant(0.4f), 2.3);
  EXPECT_LT(mean_variant(-0.4f), 0.7);
}

/// The berries' poles: vertices that have the whole light of their neighbourhood.
std::vector<Eigen::Vector3f> poles(const Bunch& of) {
  Primitive primitive;
  add_bunch(primitive, of, 1, {200000, true, 7, false});
  std::vector<Eigen::Vector3f> found;
  for (std::size_t i = 0; i + 12 < primitive.vertices.size(); ++i) {
    const Vertex& vertex = primitive.vertices[i];
    const bool pole =
        vertex.uv.x() > 0.5f && vertex.occlusion > primitive.vertices[i + 1].occlusion;
    if (pole && primitive.vertices[i + 1].occlusion > primitive.vertices[i + 7].occlusion) {
      found.push_back(vertex.position - of.berry_radius * vertex.normal);  // about its middle
    }
  }
  return found;
}

// Packed berries cut into each other by at most 1 - (0.90 - 0.16 compactness) of their size; their
// radii differ by up to 16 % from the mean that poles() takes off.
TEST(BunchTest, BerriesKeepApart) {
  Bunch loose = bunch(), compact = bunch();
  loose.compactness = 0;
  compact.compactness = 1;
  const std::vector<Eigen::Vector3f> middles = poles(loose);
  ASSERT_GT(middles.size(), 30u);
  for (std::size_t i = 0; i < middles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const float least = (0.90f * 0.84f - 0.16f) * 2 * loose.berry_radius;
      EXPECT_GT((middles[i] - middles[j]).norm(), least);
    }
  }
  EXPECT_GT(poles(compact).size(), middles.size());
}

}  // namespace
}  // namespace vinebench::sim

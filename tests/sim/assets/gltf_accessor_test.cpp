// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/gltf_accessor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// A model of one buffer of those numbers, one view of all of it and one accessor.
template <class T>
tinygltf::Model model_of(const std::vector<T>& numbers, int component, int type,
                         std::size_t count) {
  tinygltf::Model model;
  model.buffers.resize(1);
  model.buffers[0].data.resize(numbers.size() * sizeof(T));
  std::memcpy(model.buffers[0].data.data(), numbers.data(), numbers.size() * sizeof(T));
  model.bufferViews.resize(1);
  model.bufferViews[0].buffer = 0;
  model.bufferViews[0].byteLength = model.buffers[0].data.size();
  model.accessors.resize(1);
  model.accessors[0].bufferView = 0;
  model.accessors[0].componentType = component;
  model.accessors[0].type = type;
  model.accessors[0].count = count;
  return model;
}

tinygltf::Model three_points() {
  return model_of<float>({0, 1, 2, 3, 4, 5, 6, 7, 8}, TINYGLTF_COMPONENT_TYPE_FLOAT,
                         TINYGLTF_TYPE_VEC3, 3);
}

std::string problem(const tinygltf::Model& model, int accessor = 0) {
  const std::string error =
      error_of([&] { GltfNumbers(model, accessor, TINYGLTF_TYPE_VEC3, "vine.gltf"); });
  EXPECT_THAT(error, AnyOf(IsEmpty(), HasSubstr("vine.gltf: ")));
  return error;
}

TEST(GltfAccessorTest, ReadsElementsOneAfterTheOther) {
  const GltfNumbers points(three_points(), 0, TINYGLTF_TYPE_VEC3, "vine.gltf");
  EXPECT_EQ(points.size(), 3u);
  EXPECT_EQ(error_of([&] { points.expect_real("vine.gltf"); }), "");
  EXPECT_THAT(error_of([&] { points.expect_whole("vine.gltf"); }),
              AllOf(HasSubstr("vine.gltf: accessor 0"), HasSubstr("expected whole numbers")));
}

TEST(GltfAccessorTest, OffsetsAndStridesSkipBytes) {
  tinygltf::Model model = three_points();
  for (int i = 0; i < 9; ++i) {
    const GltfNumbers points(model, 0, TINYGLTF_TYPE_VEC3, "vine.gltf");
    EXPECT_EQ(points.real(static_cast<std::size_t>(i / 3), i % 3), static_cast<float>(i));
  }
  // From the second number on, pairs of points that overlap: 1 2 3 and 5 6 7.
  model.bufferViews[0].byteOffset = 4;
  model.bufferViews[0].byteLength = 32;
  model.bufferViews[0].byteStride = 16;
  model.accessors[0].count = 2;
  const GltfNumbers interleaved(model, 0, TINYGLTF_TYPE_VEC3, "vine.gltf");
  EXPECT_EQ(interleaved.real(0, 0), 1);
  EXPECT_EQ(interleaved.real(1, 0), 5);
  EXPECT_EQ(interleaved.real(1, 2), 7);
  model.accessors[0].byteOffset = 4;
  const GltfNumbers shifted(model, 0, TINYGLTF_TYPE_VEC3, "vine.gltf");
  EXPECT_EQ(shifted.real(0, 0), 2);
  EXPECT_EQ(shifted.real(1, 2), 8);
}

TEST(GltfAccessorTest, AnElementMustEndWithinItsView) {
  tinygltf::Model model = three_points();
  EXPECT_EQ(problem(model), "");
  model.accessors[0].count = 4;
  EXPECT_THAT(problem(model), HasSubstr("4 elements does not fit"));
  model.accessors[0].count = 3;
  model.accessors[0].byteOffset = 1;
  EXPECT_THAT(problem(model), HasSubstr("does not fit"));
  model.accessors[0].byteOffset = 1000;
  EXPECT_THAT(problem(model), HasSubstr("does not fit"));
  model.accessors[0].byteOffset = 0;
  model.bufferViews[0].byteStride = 13;  // 2 * 13 + 12 > 36
  EXPECT_THAT(problem(model), HasSubstr("does not fit"));
  model.bufferViews[0].byteStride = 8;  // less than an element
  EXPECT_THAT(problem(model), HasSubstr("does not fit"));
  model.bufferViews[0].byteStride = 0;
  model.accessors[0].count = (std::size_t{1} << 62) + 1;  // 12 times this overflows to 12
  EXPECT_THAT(problem(model), HasSubstr("does not fit"));
}

TEST(GltfAccessorTest, WhatIsNotThereIsNamed) {
  tinygltf::Model model = three_points();
  EXPECT_THAT(problem(model, 1), HasSubstr("names accessor 1 of 1"));
  EXPECT_THAT(problem(model, -1), HasSubstr("names accessor -1 of 1"));
  model.accessors[0].type = TINYGLTF_TYPE_VEC2;
  EXPECT_THAT(problem(model), HasSubstr("unexpected type"));
  model.accessors[0].type = TINYGLTF_TYPE_VEC3;
  model.accessors[0].sparse.isSparse = true;
  EXPECT_THAT(problem(model), HasSubstr("is sparse"));
  model.accessors[0].sparse.isSparse = false;
  model.accessors[0].bufferView = -1;
  EXPECT_THAT(problem(model), HasSubstr("names no buffer view"));
}

TEST(GltfAccessorTest, AViewIsThoseBytesOfItsBuffer) {
  tinygltf::Model model =
      model_of<char>({'a', 'b', 'c', 'd'}, TINYGLTF_COMPONENT_TYPE_BYTE, TINYGLTF_TYPE_SCALAR, 4);
  model.bufferViews[0].byteOffset = 1;
  model.bufferViews[0].byteLength = 2;
  EXPECT_EQ(gltf_view(model, 0, "vine.gltf"), "bc");
  const auto error = [&](int view = 0) {
    return error_of([&] { gltf_view(model, view, "vine.gltf"); });
  };
  EXPECT_THAT(error(1), HasSubstr("vine.gltf: names buffer view 1 of 1"));
  model.bufferViews[0].byteLength = 4;
  EXPECT_THAT(error(), HasSubstr("ends at byte 5 of a buffer of 4"));
  model.bufferViews[0].byteOffset = static_cast<std::size_t>(-2);  // ends at byte 2
  EXPECT_THAT(error(), HasSubstr("buffer view 0"));
  model.bufferViews[0].buffer = 1;
  EXPECT_THAT(error(), HasSubstr("names buffer 1 of 1"));
}

TEST(GltfAccessorTest, NormalisedIntegersAreSharesOfTheLargest) {
  tinygltf::Model bytes =
      model_of<std::int8_t>({127, -64, -128}, TINYGLTF_COMPONENT_TYPE_BYTE, TINYGLTF_TYPE_VEC3, 1);
  const auto real = [&](const tinygltf::Model& model, int component) {
    return GltfNumbers(model, 0, TINYGLTF_TYPE_VEC3, "vine.gltf").real(0, component);
  };
  EXPECT_EQ(real(bytes, 1), -64);
  bytes.accessors[0].normalized = true;
  EXPECT_EQ(real(bytes, 0), 1);
  EXPECT_NEAR(real(bytes, 1), -64.0 / 127, 1e-7);
  EXPECT_EQ(real(bytes, 2), -1);  // by the standard: -128 / 127 is held at -1
  tinygltf::Model shorts = model_of<std::uint16_t>(
      {65535, 13107, 0}, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC3, 1);
  shorts.accessors[0].normalized = true;
  EXPECT_EQ(real(shorts, 0), 1);
  EXPECT_NEAR(real(shorts, 1), 0.2, 1e-7);
}

TEST(GltfAccessorTest, WholeNumbersHaveOneTwoOrFourBytes) {
  const auto first = [](const tinygltf::Model& model) {
    const GltfNumbers numbers(model, 0, TINYGLTF_TYPE_SCALAR, "vine.gltf");
    numbers.expect_whole("vine.gltf");
    return numbers.whole(1);
  };
  EXPECT_EQ(first(model_of<std::uint8_t>({1, 200}, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                                         TINYGLTF_TYPE_SCALAR, 2)),
            200u);
  EXPECT_EQ(first(model_of<std::uint16_t>({1, 60000}, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                                          TINYGLTF_TYPE_SCALAR, 2)),
            60000u);
  const auto large = model_of<std::uint32_t>({1, 4000000000u}, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                             TINYGLTF_TYPE_SCALAR, 2);
  EXPECT_EQ(first(large), 4000000000u);
  EXPECT_THAT(error_of([&] {
                GltfNumbers(large, 0, TINYGLTF_TYPE_SCALAR, "vine.gltf").expect_real("vine.gltf");
              }),
              HasSubstr("expected real numbers"));
}

}  // namespace
}  // namespace vinebench::sim

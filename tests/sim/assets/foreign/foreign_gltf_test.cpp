// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "core/files/files.h"
#include "sim/assets/asset_file.h"
#include "tests/support/foreign_mesh_case.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using File = std::filesystem::path;

class ForeignGltfTest : public ForeignMeshTest {};

TEST_F(ForeignGltfTest, VertexColoursOfAGltfAreLinear) {
  // The normals of the first part, (0, 0, 1) in the file: blue.
  const File file = write_gltf_plant(folder_, ",\"COLOR_0\":1");
  EXPECT_EQ(warning_of(file), "");
  const Asset asset = load(file);
  for (const Primitive& primitive : primitives(asset)) {
    for (const Vertex& vertex : primitive.vertices) {
      EXPECT_THAT(vertex.colour, ElementsAre(0, 0, 255));
    }
  }
  EXPECT_THAT(vertex_colour({0.2140f, 2, -1}), ElementsAre(testing::AnyOf(126, 127), 255, 0));
}

TEST_F(ForeignGltfTest, WhatAGltfHasBesidesIsWarnedOf) {
  EXPECT_EQ(warning_of(write_gltf_plant(folder_)), "");
  const auto warning = [&](const std::string& attributes, const std::string& more) {
    return warning_of(write_gltf_plant(folder_, attributes, more));
  };
  EXPECT_THAT(warning("", R"(,"animations":[{"channels":[],"samplers":[]}])"),
              HasSubstr("animations are left out"));
  EXPECT_THAT(warning(",\"COLOR_0\":1,\"COLOR_1\":1", ""),
              HasSubstr("more than one set of vertex colours"));
  EXPECT_THAT(warning(",\"TEXCOORD_1\":1", ""), HasSubstr("more than one UV set"));
}

TEST_F(ForeignGltfTest, AGltfWithoutItsImageIsDrawnInItsColour) {
  std::string text = read_file(
      write_gltf_plant(folder_, "", R"(,"textures":[{"source":0}],"images":[{"uri":"gone.png"}])"));
  const std::string from = R"("name":"Bark")";
  text.replace(text.find(from), from.size(),
               from + R"(,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}})");
  const File file = folder_.write("bare.gltf", text);
  EXPECT_THAT(warning_of(file), AllOf(HasSubstr("material 'Bark' is drawn in its colour alone"),
                                      HasSubstr("gone.png")));
  EXPECT_EQ(load(file).textures.size(), 0u);
  EXPECT_THAT(error_of([&] { load_asset(file); }), HasSubstr("gone.png"));  // as for our own
  cv::imwrite((folder_ / "gone.png").string(), cv::Mat(2, 2, CV_8UC3, cv::Scalar(10, 20, 200)));
  EXPECT_EQ(warning_of(file), "");
  const Asset asset = load(file);
  ASSERT_EQ(asset.textures.size(), 1u);
  EXPECT_EQ(asset.textures[0].rgba.at<cv::Vec4b>(0, 0), cv::Vec4b(200, 20, 10, 255));
}

TEST_F(ForeignGltfTest, ExtensionsOfLooksAreLeftOutAndThoseOfGeometryAreErrors) {
  const auto with = [&](const std::string& extension) {
    return write_gltf_plant(folder_, "",
                            R"(,"extensionsRequired":[")" + extension + R"("],)" +
                                R"("textures":[{"extensions":{")" + extension +
                                R"(":{"source":0}}}],"images":[{"uri":"a.webp"}])");
  };
  std::string text = read_file(with("EXT_texture_webp"));
  const std::string from = R"("name":"Bark")";
  text.replace(text.find(from), from.size(),
               from + R"(,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}})");
  EXPECT_THAT(warning_of(folder_.write("webp.gltf", text)),
              AllOf(HasSubstr("material 'Bark'"), HasSubstr("EXT_texture_webp")));
  EXPECT_EQ(warning_of(with("KHR_materials_unlit")), "");
  const File draco = with("KHR_draco_mesh_compression");
  EXPECT_THAT(error_of([&] { load(draco); }), HasSubstr("KHR_draco_mesh_compression"));
}

TEST_F(ForeignGltfTest, PrimitivesThatAreNoTrianglesAreLeftOut) {
  std::string text = read_file(write_gltf_plant(folder_));
  const std::string last = R"("indices":4,"material":1)";
  text.replace(text.find(last), last.size(), last + ",\"mode\":1");
  const File file = folder_.write("lines.gltf", text);
  EXPECT_THAT(warning_of(file), HasSubstr("lines and points are left out"));
  expect_box(load(file), {-0.05f, 0, 0}, {0.05f, 0, 1});
}

}  // namespace
}  // namespace vinebench::sim

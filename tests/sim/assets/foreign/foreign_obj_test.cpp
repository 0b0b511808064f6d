// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/support/foreign_mesh_case.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using File = std::filesystem::path;

class ForeignObjTest : public ForeignMeshTest {};

TEST_F(ForeignObjTest, PrimitivesOfOneMaterialAreJoined) {
  std::string text = "o a\nusemtl m\n";
  for (int i = 0; i < 50; ++i) {
    text += fmt::format("o part{0}\nv {0} 0 0\nv {0} 1 0\nv {0} 0 1\nf {1} {2} {3}\n", i, 3 * i + 1,
                        3 * i + 2, 3 * i + 3);
  }
  const Asset asset = load(folder_.write("many.obj", text));
  ASSERT_EQ(primitives(asset).size(), 1u);
  EXPECT_EQ(triangle_count(asset.model.levels[0]), 50);
  EXPECT_EQ(asset.model.bounds.max(), Vector3f(49, 1, 1));
}

/// An .obj of one textured triangle.
std::string textured_obj() {
  return "mtllib skin.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 -1 0\n"
         "usemtl Skin\nf 1/1/1 2/2/1 3/3/1\n";
}

TEST_F(ForeignObjTest, ImagesAreUsedFromTheMeshsFolderWhateverTheirPath) {
  cv::imwrite((folder_ / "skin.png").string(), cv::Mat(2, 2, CV_8UC3, cv::Scalar(10, 20, 200)));
  for (const char* path : {"skin.png", "C:\\work\\skin.png", "/nowhere/skin.png"}) {
    folder_.write("skin.mtl", fmt::format("newmtl Skin\nKd 1 1 1\nmap_Kd {}\n", path));
    const File file = folder_.write("skin.obj", textured_obj());
    EXPECT_EQ(warning_of(file), "") << path;
    const Asset asset = load(file);
    ASSERT_EQ(asset.textures.size(), 1u) << path;
    EXPECT_EQ(asset.textures[0].rgba.at<cv::Vec4b>(0, 0), cv::Vec4b(200, 20, 10, 255));
    EXPECT_EQ(material(asset, primitives(asset)[0]).texture, 0);
  }
}

TEST_F(ForeignObjTest, AnImageThatIsMissingOrUnsupportedLeavesTheColour) {
  const auto expect_colour = [&](const char* image, const char* reason) {
    folder_.write("skin.mtl", fmt::format("newmtl Skin\nKd 1 0 0\nmap_Kd {}\n", image));
    const File file = folder_.write("skin.obj", textured_obj());
    EXPECT_THAT(warning_of(file), AllOf(HasSubstr("material 'Skin' is drawn in its colour alone"),
                                        HasSubstr(image), HasSubstr(reason)));
    const Asset asset = load(file);
    EXPECT_THAT(asset.textures, IsEmpty());
    EXPECT_EQ(material(asset, primitives(asset)[0]).colour, Vector3f(1, 0, 0));
  };
  expect_colour("gone.png", "no such file");
  folder_.write("skin.tga", std::string(18, '\0') + "not supported");
  expect_colour("skin.tga", "expected an image (PNG, JPEG, TIFF)");
  folder_.write("broken.png", "\x89PNG\r\n\x1a\nno more");
  expect_colour("broken.png", "broken.png: expected an image");
}

TEST_F(ForeignObjTest, AMissingMaterialLibraryIsWarnedOf) {
  EXPECT_THAT(warning_of(folder_.write("skin.obj", textured_obj())),
              HasSubstr("material library skin.mtl: no such file"));
}

TEST_F(ForeignObjTest, LooksThatAreNotDrawnAreWarnedOf) {
  folder_.write("skin.mtl", "newmtl Skin\nKd 1 1 1\nd 0.5\nmap_d mask.png\nmap_Bump bump.png\n");
  EXPECT_THAT(warning_of(folder_.write("skin.obj", textured_obj())),
              AllOf(HasSubstr("material 'Skin' is drawn opaque"), HasSubstr("image of opacity"),
                    HasSubstr("image of bumps")));
}

TEST_F(ForeignObjTest, LinesAreLeftOutAndWarnedOf) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 0 1\nvn 0 -1 0\nf 1//1 2//1 3//1\n";
  const File file = folder_.write("wire.obj", triangle + "o wire\nl 1 2\nl 2 3\n");
  EXPECT_THAT(warning_of(file), HasSubstr("lines and points are left out"));
  EXPECT_EQ(triangle_count(load(file).model.levels[0]), 1);
}

TEST_F(ForeignObjTest, VertexColoursOfAnObjAreUsed) {
  const Asset asset = load(folder_.write(
      "c.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 0 1 0.5 0.5 0.5\nvn 0 -1 0\nf 1//1 2//1 3//1\n"));
  ASSERT_TRUE(material(asset, primitives(asset)[0]).vertex_colours);
  // sRGB 0.5 is 0.2140 linear, and that to the power 1 / 2.2 of 255 is 126.5.
  const std::vector<Vertex>& vertices = primitives(asset)[0].vertices;
  EXPECT_THAT(vertices.at(0).colour, ElementsAre(255, 0, 0));
  EXPECT_THAT(vertices.at(1).colour, ElementsAre(0, 255, 0));
  EXPECT_NEAR(vertices.at(2).colour[0], 126.5, 0.51);
  EXPECT_FALSE(material(load(write_obj_plant(folder_)), {}).vertex_colours);
}

}  // namespace
}  // namespace vinebench::sim

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "sim/assets/asset_file.h"
#include "tests/support/special_files.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

const char* const kObj = "v 0 0 0\nv 1 0 0\nv 0 0 2\nvt 0 0\nvt 1 0\nvt 0 1\n";

/// The vertex at that position, m; fails the test if there is none.
Vertex vertex_at(const Asset& asset, const Eigen::Vector3f& place) {
  for (const Primitive& primitive : asset.model.levels.at(0).primitives) {
    for (const Vertex& v : primitive.vertices) {
      if ((v.position - place).norm() < 1e-5f) return v;
    }
  }
  ADD_FAILURE() << "no vertex at " << place.transpose();
  return {};
}

TEST(MeshImporterTest, ObjIsZUpWithTheFirstRowOfItsImageOnTop) {
  const test::TestFolder folder;
  cv::imwrite((folder / "skin.png").string(), cv::Mat(2, 2, CV_8UC3, cv::Scalar(10, 20, 200)));
  folder.write("vine.mtl", "newmtl skin\nKd 1 1 1\nmap_Kd skin.png\n");
  const auto file = folder.write(
      "vine.obj", std::string("mtllib vine.mtl\n") + kObj + "usemtl skin\nf 1/1 2/2 3/3\n");
  const Asset asset = load_asset(file);
  EXPECT_EQ(triangle_count(asset.model.levels.at(0)), 1);
  const Vertex top = vertex_at(asset, {0, 0, 2});
  // OBJ counts v from below: 1 is the image's first row, which is 0 for us.
  EXPECT_LT((top.uv - Eigen::Vector2f(0, 0)).norm(), 1e-6f);
  EXPECT_LT((vertex_at(asset, {1, 0, 0}).uv - Eigen::Vector2f(1, 1)).norm(), 1e-6f);
  EXPECT_LT((top.normal - Eigen::Vector3f(0, -1, 0)).norm(), 1e-5f);
  const int material = asset.model.levels.at(0).primitives.at(0).material;
  const Material& skin = asset.materials.at(static_cast<std::size_t>(material));
  EXPECT_EQ(skin.colour, Eigen::Vector3f(1, 1, 1));
  EXPECT_EQ(asset.textures.at(static_cast<std::size_t>(skin.texture)).rgba.at<cv::Vec4b>(0, 0),
            cv::Vec4b(200, 20, 10, 255));
}

// Two squares that meet along the y axis, one level and the other going down by that angle.
TEST(MeshImporterTest, AnEdgeStaysSharpAndACurveSmooth) {
  const test::TestFolder folder;
  for (const double degrees : {20.0, 90.0}) {
    const double x = std::cos(degrees * M_PI / 180), z = -std::sin(degrees * M_PI / 180);
    const auto file = folder.write(
        "roof.obj", fmt::format("v -1 0 0\nv 0 0 0\nv 0 1 0\nv -1 1 0\nv {0} 0 {1}\nv {0} 1 {1}\n"
                                "f 1 2 3 4\nf 2 5 6 3\n",
                                x, z));
    std::vector<float> upward;  // z of the normals at the edge's first point
    const Asset asset = load_asset(file);
    for (const Primitive& primitive : asset.model.levels.at(0).primitives) {
      for (const Vertex& v : primitive.vertices) {
        if (v.position.norm() < 1e-5f) upward.push_back(v.normal.z());
      }
    }
    // Half of 20 degrees between both, or each its own.
    const float mean = static_cast<float>(std::cos(10 * M_PI / 180));
    for (const float up : upward) {
      if (degrees == 20) {
        EXPECT_NEAR(up, mean, 1e-3);
      } else {
        EXPECT_NEAR(std::min(std::abs(up), std::abs(up - 1)), 0, 1e-3);
      }
    }
    EXPECT_EQ(upward.size(), degrees == 20 ? 1u : 2u);
  }
}

TEST(MeshImporterTest, BrokenObjIsNamedWithWhatIsWrong) {
  const test::TestFolder folder;
  const auto problem = [&](const std::string& text) {
    const auto file = folder.write("vine.obj", text);
    const std::string error = error_of([&] { load_asset(file); });
    EXPECT_THAT(error, HasSubstr(file.string())) << text;
    return error;
  };
  problem("no mesh at all");
  problem(kObj);  // no face
  problem(std::string(kObj) + "f 1 2 9\n");
  EXPECT_THAT(problem("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr("finite"));
  folder.write("vine.mtl", "newmtl skin\nmap_Kd gone.png\n");
  EXPECT_THAT(problem(std::string("mtllib vine.mtl\n") + kObj + "usemtl skin\nf 1/1 2/2 3/3\n"),
              HasSubstr("gone.png"));
}

// Each of them was a crash inside assimp.
TEST(MeshImporterTest, ABrokenMaterialLibraryIsNamedWithItsLine) {
  const test::TestFolder folder;
  const auto file = folder.write(
      "vine.obj", std::string("mtllib vine.mtl\n") + kObj + "usemtl skin\nf 1/1 2/2 3/3\n");
  const auto problem = [&](std::string_view library) {
    folder.write("vine.mtl", library);
    const std::string error = error_of([&] { load_asset(file); });
    EXPECT_THAT(error, AllOf(HasSubstr(file.string()), HasSubstr("vine.mtl"))) << library;
    return error;
  };
  for (const std::string property : {"map_Kd", "map_d", "map_Bump", "bump", "disp", "refl"}) {
    EXPECT_THAT(problem(property + " skin.png\nnewmtl skin\n"), HasSubstr("vine.mtl:1"));
  }
  EXPECT_THAT(problem(std::string_view("\xff\xfen\0e\0w\0", 8)), HasSubstr("UTF-8"));
  std::filesystem::remove(folder / "vine.mtl");
  test::make_pipe(folder, "vine.mtl");
  EXPECT_THAT(error_of([&] { load_asset(file); }), HasSubstr("a pipe or a device"));
}

TEST(MeshImporterTest, AWideObjIsNamed) {
  const test::TestFolder folder;
  std::string wide = "\xff\xfe";
  for (const char* c = kObj; *c != 0; ++c) wide += {*c, '\0'};
  const auto file = folder.write("vine.obj", wide);
  EXPECT_THAT(error_of([&] { load_asset(file); }),
              AllOf(HasSubstr(file.string()), HasSubstr("UTF-8")));
}

// A regular polygon, which assimp would divide for minutes.
TEST(MeshImporterTest, APolygonOfThousandsOfCornersIsNamed) {
  const test::TestFolder folder;
  for (const int corners : {1000, 1001}) {
    std::string text, face = "f";
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * M_PI * i / corners;
      text += fmt::format("v {} {} 0\n", std::cos(angle), std::sin(angle));
      face += fmt::format(" {}", i + 1);
    }
    const auto file = folder.write("disc.obj", text + face + "\n");
    const std::string error = error_of([&] { load_asset(file); });
    if (corners == 1000) {
      EXPECT_EQ(error, "");
    } else {
      EXPECT_THAT(error, HasSubstr("at most 1000 corners"));
    }
  }
}

/// A binary STL of those triangles, three corners each.
std::string stl(const std::vector<Eigen::Vector3f>& corners) {
  std::string bytes(80, ' ');
  const auto count = static_cast<std::uint32_t>(corners.size() / 3);
  const auto append = [&](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  append(&count, 4);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const Eigen::Vector3f normal(0, -1, 0);
    append(normal.data(), 12);
    for (std::size_t k = 0; k < 3; ++k) append(corners[i + k].data(), 12);
    bytes.append(2, '\0');
  }
  return bytes;
}

TEST(MeshImporterTest, StlIsZUpInMetres) {
  const test::TestFolder folder;
  const auto file = folder.write("vine.stl", stl({{0, 0, 0}, {1.5f, 0, 0}, {0, 0.25f, 2}}));
  const Asset asset = load_asset(file);
  EXPECT_EQ(triangle_count(asset.model.levels.at(0)), 1);
  vertex_at(asset, {1.5f, 0, 0});
  vertex_at(asset, {0, 0.25f, 2});
  EXPECT_EQ(asset.model.bounds.max(), Eigen::Vector3f(1.5f, 0.25f, 2));
}

TEST(MeshImporterTest, BrokenStlIsNamed) {
  const test::TestFolder folder;
  const std::string whole = stl({{0, 0, 0}, {1, 0, 0}, {0, 0, 2}, {0, 0, 0}, {0, 0, 2}, {1, 0, 3}});
  for (const std::size_t size : {30u, 84u, 100u, 140u}) {
    const auto file = folder.write("short.stl", whole.substr(0, size));
    EXPECT_THAT(error_of([&] { load_asset(file); }), HasSubstr(file.string())) << size;
  }
  const auto nan = folder.write("nan.stl", stl({{0, 0, 0}, {1, kNoNumber, 0}, {0, 0, 2}}));
  EXPECT_THAT(error_of([&] { load_asset(nan); }),
              AllOf(HasSubstr(nan.string()), HasSubstr("finite")));
}

/// One triangle (0, 0, 0), (1, 0, 0), (0, 0, 2) in a document of that axis and unit.
std::string triangle_dae(const std::string& axis, const std::string& unit) {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="u" meter=")" +
         unit + R"("/><up_axis>)" + axis + R"(</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 0 2</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

TEST(MeshImporterTest, DaeHasTheAxisAndUnitThatItSays) {
  const test::TestFolder folder;
  const Asset upright = load_asset(folder.write("z.dae", triangle_dae("Z_UP", "1")));
  vertex_at(upright, {1, 0, 0});
  vertex_at(upright, {0, 0, 2});
  const Asset turned = load_asset(folder.write("y.dae", triangle_dae("Y_UP", "1")));
  vertex_at(turned, {1, 0, 0});
  vertex_at(turned, {0, -2, 0});  // its z points to us, which is -y with z up
  const Asset centimetres = load_asset(folder.write("cm.dae", triangle_dae("Z_UP", "0.01")));
  vertex_at(centimetres, {0.01f, 0, 0});
  vertex_at(centimetres, {0, 0, 0.02f});
}

TEST(MeshImporterTest, BrokenDaeIsNamed) {
  const test::TestFolder folder;
  for (const std::string& text :
       {std::string("<COLLADA>"), std::string("text"), triangle_dae("Z_UP", "1").substr(0, 700)}) {
    const auto file = folder.write("broken.dae", text);
    EXPECT_THAT(error_of([&] { load_asset(file); }), HasSubstr(file.string()));
  }
}

}  // namespace
}  // namespace vinebench::sim

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/asset_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Texture chequers(const std::string& name, bool repeat) {
  cv::Mat rgba(4, 8, CV_8UC4);
  for (int i = 0; i < 32; ++i) {
    const auto shade = static_cast<std::uint8_t>(8 * i);
    rgba.at<cv::Vec4b>(i / 8, i % 8) = {shade, 10, 200, static_cast<std::uint8_t>(255 - shade)};
  }
  return {name, rgba, repeat};
}

/// A triangle without symmetry: no two of its coordinates are equal.
Primitive triangle(int material, float shift = 0) {
  Primitive p;
  p.material = material;
  const Eigen::Vector3f a(0.1f + shift, 0.2f, 0.3f), b(1.5f, -0.7f, 0.4f), c(0.6f, 0.9f, 1.9f);
  const Eigen::Vector3f normal = (b - a).cross(c - a).normalized();
  p.vertices = {{a, normal, {0.1f, 0.2f}, 0.25f},
                {b, normal, {0.9f, 0.3f}, 1},
                {c, normal, {0.4f, 0.8f}, 0.5f}};
  p.indices = {0, 1, 2};
  return p;
}

Asset two_levels() {
  Asset asset;
  asset.add(chequers("leaf", true));
  asset.add(chequers("bark", false));
  asset.add(make_material("leaf", Label::kLeaf, 0));
  asset.materials[0].cutout = true;
  asset.materials[0].double_sided = true;
  asset.materials[0].translucency = 0.35f;
  asset.add(make_material("bark", Label::kTrunk, 1));
  asset.materials[1].colour = {0.1f, 0.2f, 0.7f};
  asset.add(make_material("plain", Label::kBunch, -1));
  asset.materials[2].vertex_colours = true;
  asset.model.name = "vine";
  asset.model.levels = {{2.5, {triangle(0), triangle(1, 0.05f)}}, {1e9, {triangle(2, -0.1f)}}};
  std::uint8_t shade = 0;
  for (Vertex& vertex : asset.model.levels[1].primitives[0].vertices) {
    vertex.colour = {shade, 129, static_cast<std::uint8_t>(255 - shade)};
    shade = static_cast<std::uint8_t>(shade + 77);
  }
  asset.update_bounds();
  return asset;
}

void expect_same(const Vertex& a, const Vertex& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.uv, b.uv);
  EXPECT_EQ(a.occlusion, b.occlusion);
  EXPECT_EQ(a.colour, b.colour);
}

TEST(GlbTest, EveryBitComesBack) {
  const test::TestFolder folder;
  const Asset asset = two_levels();
  const Asset back = load_asset(folder.write("vine.glb", to_glb(asset)));
  ASSERT_EQ(back.textures.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.textures[i].name, asset.textures[i].name);
    EXPECT_EQ(back.textures[i].repeat, asset.textures[i].repeat);
    EXPECT_EQ(cv::norm(back.textures[i].rgba, asset.textures[i].rgba, cv::NORM_INF), 0);
  }
  ASSERT_EQ(back.materials.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Material &a = asset.materials[i], &b = back.materials[i];
    EXPECT_EQ(std::tie(a.name, a.label, a.colour, a.texture, a.cutout, a.double_sided,
                       a.translucency, a.vertex_colours),
              std::tie(b.name, b.label, b.colour, b.texture, b.cutout, b.double_sided,
                       b.translucency, b.vertex_colours));
  }
  EXPECT_EQ(back.model.name, "vine");
  ASSERT_EQ(back.model.levels.size(), 2u);
  for (std::size_t l = 0; l < 2; ++l) {
    const LevelOfDetail &a = asset.model.levels[l], &b = back.model.levels[l];
    EXPECT_EQ(a.until, b.until);
    ASSERT_EQ(a.primitives.size(), b.primitives.size());
    for (std::size_t p = 0; p < a.primitives.size(); ++p) {
      EXPECT_EQ(a.primitives[p].material, b.primitives[p].material);
      EXPECT_EQ(a.primitives[p].indices, b.primitives[p].indices);
      for (std::size_t v = 0; v < 3; ++v) {
        expect_same(a.primitives[p].vertices[v], b.primitives[p].vertices[v]);
      }
    }
  }
  EXPECT_EQ(back.model.bounds.min(), asset.model.bounds.min());
  EXPECT_EQ(to_glb(back), to_glb(asset));
}

TEST(DecodedImagesTest, TheSameBytesAreDecodedOnce) {
  const cv::Mat rgba = chequers("leaf", true).rgba;
  std::vector<std::uint8_t> png;
  cv::Mat bgra;
  cv::cvtColor(rgba, bgra, cv::COLOR_RGBA2BGRA);
  cv::imencode(".png", bgra, png);
  const std::string bytes(png.begin(), png.end()), copy = bytes;
  DecodedImages images;
  const cv::Mat first = images.decode(bytes, "first");
  EXPECT_EQ(cv::norm(first, rgba, cv::NORM_INF), 0);
  EXPECT_EQ(images.decode(copy, "second").data, first.data);
  EXPECT_THAT(error_of([&] { images.decode("nothing", "third"); }), HasSubstr("third"));
}

TEST(VertexColourTest, EveryByteComesBackFromItsLight) {
  for (int byte = 0; byte < 256; ++byte) {
    const std::array<std::uint8_t, 3> colour{static_cast<std::uint8_t>(byte),
                                             static_cast<std::uint8_t>(255 - byte), 255};
    EXPECT_EQ(vertex_colour(linear_colour(colour)), colour);
  }
}

/// A .gltf of one triangle with corners (0, 0, 0), (1, 0, 0), (0, 2, 0) and an embedded buffer.
std::string gltf(const std::string& node = "\"mesh\":0", const std::string& more = "",
                 const std::string& accessor = "\"count\":3,\"type\":\"VEC3\"") {
  // Nine little-endian floats: 1 is 0000803f, 2 is 00000040.
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{)" + node +
         R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0})" + more +
         R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,)" + accessor +
         R"(}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")"
         R"(data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA"}]})";
}

const Vertex& vertex(const Asset& asset, std::size_t index) {
  return asset.model.levels.at(0).primitives.at(0).vertices.at(index);
}

TEST(GltfTest, YUpBecomesZUp) {
  const test::TestFolder folder;
  const Asset asset = load_asset(folder.write("a.gltf", gltf()));
  EXPECT_EQ(vertex(asset, 1).position, Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(vertex(asset, 2).position, Eigen::Vector3f(0, 0, 2));  // was 2 up y
  // The file has no normals; its front is towards +z there, which is -y here.
  EXPECT_LT((vertex(asset, 0).normal - Eigen::Vector3f(0, -1, 0)).norm(), 1e-6f);
}

TEST(GltfTest, NodesMoveTurnAndScale) {
  const test::TestFolder folder;
  // A quarter turn about glTF's y (up): its x goes to -z, which is our +y; 3 times as large; moved
  // 5 up.
  const Asset asset = load_asset(
      folder.write("a.gltf", gltf(R"("mesh":0,"scale":[3,3,3],"translation":[0,5,0],)"
                                  R"("rotation":[0,0.7071067811865476,0,0.7071067811865476])")));
  EXPECT_LT((vertex(asset, 1).position - Eigen::Vector3f(0, 3, 5)).norm(), 1e-5f);
  EXPECT_LT((vertex(asset, 2).position - Eigen::Vector3f(0, 0, 11)).norm(), 1e-5f);
  EXPECT_NEAR(vertex(asset, 0).normal.norm(), 1, 1e-5);
}

TEST(GltfTest, AMirroringNodeKeepsTheFrontInFront) {
  const test::TestFolder folder;
  const Asset asset = load_asset(folder.write("a.gltf", gltf(R"("mesh":0,"scale":[-1,1,1])")));
  const Primitive& p = asset.model.levels.at(0).primitives.at(0);
  const auto at = [&](int i) {
    return p.vertices.at(p.indices.at(static_cast<std::size_t>(i))).position;
  };
  const Eigen::Vector3f front = (at(1) - at(0)).cross(at(2) - at(0));
  EXPECT_GT(front.dot(p.vertices[0].normal), 0);
}

TEST(GltfTest, BrokenFilesAreNamedWithWhatIsWrong) {
  const test::TestFolder folder;
  const auto problem = [&](const std::string& text) {
    const auto file = folder.write("broken.gltf", text);
    const std::string error = error_of([&] { load_asset(file); });
    EXPECT_THAT(error, HasSubstr(file.string()));
    return error;
  };
  EXPECT_THAT(problem(""), HasSubstr("empty"));
  EXPECT_THAT(problem("no glTF"), HasSubstr("expected glTF 2.0"));
  EXPECT_THAT(problem("{\"asset\":{\"version\":\"2.0\"}}"), HasSubstr("no triangles"));
  EXPECT_THAT(problem(gltf("\"name\":\"bare\"")), HasSubstr("no triangles"));
  EXPECT_THAT(problem(gltf("\"mesh\":7")), HasSubstr("names mesh 7 of 1"));
  EXPECT_THAT(problem(gltf("\"mesh\":0,\"children\":[0]")), HasSubstr("deep"));
  EXPECT_THAT(problem(gltf("\"mesh\":0", ",\"material\":2")), HasSubstr("names material 2"));
  EXPECT_THAT(problem(gltf("\"mesh\":0", ",\"mode\":1")), HasSubstr("expected triangles"));
  EXPECT_THAT(problem(gltf("\"mesh\":0", "", "\"count\":4,\"type\":\"VEC3\"")),
              HasSubstr("does not fit"));
  EXPECT_THAT(problem(gltf("\"mesh\":0", "", "\"count\":2,\"type\":\"VEC3\"")),
              HasSubstr("three for each triangle"));
  EXPECT_THAT(problem(gltf("\"mesh\":0", "", "\"count\":3,\"type\":\"VEC2\"")),
              HasSubstr("unexpected type"));
  EXPECT_THAT(problem(gltf("\"mesh\":0", "", "\"count\":4611686018427387905,\"type\":\"VEC3\"")),
              HasSubstr("does not fit"));
}

TEST(GltfTest, AMissingBufferOrImageIsNamed) {
  const test::TestFolder folder;
  std::string text = gltf();
  const std::size_t at = text.find("data:");
  text = text.substr(0, at) + "gone.bin\"}]}";
  const auto no_buffer = folder.write("buffer.gltf", text);
  EXPECT_THAT(error_of([&] { load_asset(no_buffer); }),
              AllOf(HasSubstr(no_buffer.string()), HasSubstr("gone.bin")));
  const std::string material =
      R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
      R"("textures":[{"source":0}],"images":[{"uri":"gone.png"}]})";
  text = gltf("\"mesh\":0", ",\"material\":0");
  text.pop_back();
  const auto no_image = folder.write("image.gltf", text + material);
  EXPECT_THAT(error_of([&] { load_asset(no_image); }),
              AllOf(HasSubstr(no_image.string()), HasSubstr("gone.png")));
  folder.write("gone.png", "not an image");
  EXPECT_THAT(error_of([&] { load_asset(no_image); }), HasSubstr("expected an image"));
  cv::imwrite((folder / "gone.png").string(), cv::Mat(2, 2, CV_8UC3, cv::Scalar(10, 20, 200)));
  const Asset asset = load_asset(no_image);
  EXPECT_EQ(asset.textures.at(0).rgba.at<cv::Vec4b>(1, 1),
            cv::Vec4b(200, 20, 10, 255));  // from BGR
}

TEST(GlbTest, CutShortAnywhereIsAnError) {
  const test::TestFolder folder;
  const std::string whole = to_glb(two_levels());
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 97) {
    const auto file = folder.write("short.glb", whole.substr(0, size));
    EXPECT_THAT(error_of([&] { load_asset(file); }), HasSubstr(file.string())) << size;
  }
}

TEST(GlbTest, FlippedBytesNeverCrash) {
  const test::TestFolder folder;
  const std::string whole = to_glb(two_levels());
  int errors = 0;
  for (std::size_t at = 0; at < whole.size(); at += 13) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x15);
    const auto file = folder.write("flipped.glb", flipped);
    errors += error_of([&] { load_asset(file); }).empty() ? 0 : 1;
  }
  EXPECT_GT(errors, 20);  // most bytes are JSON, where nearly any change is an error
}

TEST(GlbTest, NumbersThatAreNoneAndIndicesOutOfRangeAreNamed) {
  const test::TestFolder folder;
  Asset asset = two_levels();
  asset.model.levels[0].primitives[0].vertices[1].position.x() = kNan;
  const auto nan = folder.write("nan.glb", to_glb(asset));
  EXPECT_THAT(error_of([&] { load_asset(nan); }),
              AllOf(HasSubstr(nan.string()), HasSubstr("vertex 1 is not a finite number")));
  asset = two_levels();
  asset.model.levels[1].primitives[0].indices[2] = 3;
  const auto index = folder.write("index.glb", to_glb(asset));
  EXPECT_THAT(error_of([&] { load_asset(index); }),
              AllOf(HasSubstr(index.string()), HasSubstr("names vertex 3 of 3")));
}

TEST(MeshFileTest, AMissingFileAndAnUnknownKindAreNamed) {
  const test::TestFolder folder;
  for (const std::string name : {"gone.glb", "gone.gltf", "gone.obj", "gone.stl", "gone.dae"}) {
    EXPECT_THAT(error_of([&] { load_asset(folder / name); }), HasSubstr((folder / name).string()));
  }
  const auto ply = folder.write("vine.ply", "ply\n");
  EXPECT_THAT(error_of([&] { load_asset(ply); }),
              AllOf(HasSubstr(ply.string()), HasSubstr(".glb, .gltf, .obj, .stl or .dae")));
  for (const std::string name : {"empty.obj", "empty.stl", "empty.dae", "empty.glb"}) {
    const auto file = folder.write(name, "");
    EXPECT_THAT(error_of([&] { load_asset(file); }),
                AllOf(HasSubstr(file.string()), HasSubstr("empty")));
  }
}

}  // namespace
}  // namespace vinebench::sim

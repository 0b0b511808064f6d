// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/foreign/foreign_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <set>

#include "sim/assets/asset_file.h"
#include "tests/support/foreign_plant.h"
#include "tests/support/warnings.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;
using test::error_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using File = std::filesystem::path;

class ForeignMeshTest : public testing::Test {
 protected:
  Asset load(const File& file, const MeshImport& import = {},
             std::optional<Label> label = std::nullopt) const {
    return load_foreign_meshes({file}, import, label, "vines.mesh_import").at(0);
  }
  /// The one warning of a file, which names it; empty without one.
  std::string warning_of(const File& file) const {
    const test::Warnings warnings;
    load(file);
    if (warnings.all.empty()) return "";
    EXPECT_EQ(warnings.all.size(), 1u);
    EXPECT_THAT(warnings.all[0], testing::StartsWith(file.string() + ": "));
    return warnings.all[0];
  }
  /// Every format with names, the same plant each.
  std::vector<File> named_plants() const {
    return {write_obj_plant(folder_), write_dae_plant(folder_), write_gltf_plant(folder_),
            write_glb_plant(folder_)};
  }
  static const std::vector<Primitive>& primitives(const Asset& asset) {
    return asset.model.levels.at(0).primitives;
  }
  static const Material& material(const Asset& asset, const Primitive& primitive) {
    return asset.materials.at(static_cast<std::size_t>(primitive.material));
  }
  /// The label at each height of the plant's two parts: below 1 m and above.
  static std::pair<std::set<Label>, std::set<Label>> labels(const Asset& asset) {
    std::pair<std::set<Label>, std::set<Label>> found;
    for (const Primitive& primitive : primitives(asset)) {
      for (const Vertex& vertex : primitive.vertices) {
        const Label label = material(asset, primitive).label;
        if (vertex.position.z() < 0.5f) found.first.insert(label);
        if (vertex.position.z() > 1.5f) found.second.insert(label);
      }
    }
    return found;
  }
  static std::size_t vertices(const Asset& asset) {
    std::size_t count = 0;
    for (const Primitive& primitive : primitives(asset)) count += primitive.vertices.size();
    return count;
  }
  static void expect_box(const Asset& asset, const Vector3f& min, const Vector3f& max) {
    EXPECT_LT((asset.model.bounds.min() - min).norm(), 1e-5f) << asset.model.bounds.min();
    EXPECT_LT((asset.model.bounds.max() - max).norm(), 1e-5f) << asset.model.bounds.max();
  }

  test::TestFolder folder_;
};

using Labels = std::pair<std::set<Label>, std::set<Label>>;

TEST_F(ForeignMeshTest, EveryFormatStandsUprightAndIsALeafByDefault) {
  std::vector<File> files = named_plants();
  files.push_back(write_stl_plant(folder_));
  for (const File& file : files) {
    const Asset asset = load(file);
    expect_box(asset, {-0.4f, 0, 0}, {0.4f, 0, 1.6f});
    EXPECT_EQ(labels(asset), Labels({Label::kLeaf}, {Label::kLeaf})) << file;
    for (const Primitive& primitive : primitives(asset)) {
      for (const Vertex& vertex : primitive.vertices) {
        EXPECT_LT((vertex.normal - Vector3f(0, -1, 0)).norm(), 1e-5f) << file;
      }
    }
    EXPECT_EQ(vertices(asset), 8u) << file;  // four a rectangle: equal ones are joined
  }
}

TEST_F(ForeignMeshTest, MaterialsAndPartsNameTheLabelsInEveryFormat) {
  MeshImport by_material, by_part;
  by_material.labels = {{"Bark", Label::kTrunk}, {"Green", Label::kCane}};
  by_part.labels = {{"Trunk", Label::kTrunk}, {"Foliage", Label::kCane}};
  for (const File& file : named_plants()) {
    for (const MeshImport& import : {by_material, by_part}) {
      EXPECT_EQ(labels(load(file, import)), Labels({Label::kTrunk}, {Label::kCane})) << file;
    }
  }
}

TEST_F(ForeignMeshTest, TheDefaultLabelIsThatOfAllWithoutOne) {
  MeshImport import;
  import.labels = {{ "Bark", Label::kPost }};
  import.default_label = Label::kBunch;
  EXPECT_EQ(labels(load(write_obj_plant(folder_), import)),
            Labels({Label::kPost}, {Label::kBunch}));
  EXPECT_EQ(labels(load(write_stl_plant(folder_), import = {1, {}, 0, {}, Label::kTrunk})),
            Labels({Label::kTrunk}, {Label::kTrunk}));
  // An occluder's class holds in place of the file's labels, unless a default is given.
  EXPECT_EQ(labels(load(write_stl_plant(folder_), {}, Label::kCrate)),
            Labels({Label::kCrate}, {Label::kCrate}));
  EXPECT_EQ(labels(load(write_stl_plant(folder_), import, Label::kCrate)),
            Labels({Label::kTrunk}, {Label::kTrunk}));
}

// The foliage's triangles of two materials: one is named, the other has the label of the part.
TEST_F(ForeignMeshTest, TheMaterialCountsBeforeThePartAndThePartBeforeThoseAroundIt) {
  const File file = folder_.write("two.dae", [&] {
    std::string text = read_file(write_dae_plant(folder_));
    // A node around both.
    const std::string from = "<visual_scene id=\"s\">", to = "</visual_scene>";
    text.replace(text.find(from), from.size(), from + "<node id=\"Vine\" name=\"Vine\">");
    return text.replace(text.find(to), to.size(), "</node>" + to);
  }());
  MeshImport import;
  import.labels = {{ "Vine", Label::kCane }};
  EXPECT_EQ(labels(load(file, import)), Labels({Label::kCane}, {Label::kCane}));
  import.labels["Trunk"] = Label::kPost;
  EXPECT_EQ(labels(load(file, import)), Labels({Label::kPost}, {Label::kCane}));
  import.labels["Bark"] = Label::kTrunk;
  EXPECT_EQ(labels(load(file, import)), Labels({Label::kTrunk}, {Label::kCane}));
}

TEST_F(ForeignMeshTest, AMistypedNameNamesTheNearest) {
  MeshImport import;
  import.labels = {{ "Brak", Label::kTrunk }};
  const File file = write_obj_plant(folder_);
  EXPECT_THAT(error_of([&] { load(file, import); }),
              AllOf(HasSubstr("vines.mesh_import.labels.Brak: "), HasSubstr(file.string()),
                    HasSubstr("did you mean 'Bark'?"), HasSubstr("Foliage, Green")));
  // A name of any of the files will do.
  const File other = write_stl_plant(folder_);
  import.labels = {{ "Bark", Label::kTrunk }};
  EXPECT_EQ(load_foreign_meshes({other, file}, import, std::nullopt, "k").size(), 2u);
}

TEST_F(ForeignMeshTest, EachBunchHasANumberAndOtherPartsNone) {
  MeshImport import;
  import.labels = {{"Trunk", Label::kBunch}, { "Foliage", Label::kBunch }};
  std::set<int> numbers;
  const Asset bunches = load(write_gltf_plant(folder_), import),
              leaves = load(write_gltf_plant(folder_));
  for (const Primitive& primitive : primitives(bunches)) {
    for (const Vertex& vertex : primitive.vertices) numbers.insert(vertex.part);
  }
  EXPECT_THAT(numbers, ElementsAre(1, 2));
  for (const Primitive& primitive : primitives(leaves)) {
    for (const Vertex& vertex : primitive.vertices) EXPECT_EQ(vertex.part, 0);
  }
}

TEST_F(ForeignMeshTest, PrimitivesOfOneMaterialAreJoined) {
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

TEST_F(ForeignMeshTest, ScaleYawAndUpAxisPlaceIt) {
  const File file = write_obj_plant(folder_);
  MeshImport import;
  import.scale = 0.01;
  expect_box(load(file, import), {-0.004f, 0, 0}, {0.004f, 0, 0.016f});
  import = {};
  import.yaw_deg = 90;  // x to y, the front from -y to +x
  const Asset turned = load(file, import);
  expect_box(turned, {0, -0.4f, 0}, {0, 0.4f, 1.6f});
  EXPECT_LT((primitives(turned)[0].vertices[0].normal - Vector3f(1, 0, 0)).norm(), 1e-6f);
  import = {};
  import.up_axis = UpAxis::kY;  // the file's z then comes out of it to the viewer, at -y
  expect_box(load(file, import), {-0.4f, -1.6f, 0}, {0.4f, 0, 0});
  import.up_axis = UpAxis::kX;  // the file's x is up, its z points to the viewer, as in COLLADA
  expect_box(load(file, import), {0, -1.6f, -0.4f}, {0, 0, 0.4f});
}

TEST_F(ForeignMeshTest, AGivenUpAxisReplacesThatOfTheFormatAndOfTheFile) {
  MeshImport import;
  import.up_axis = UpAxis::kZ;
  // The glTF's own coordinates are (x, z, -y): height is its y, which is away from the viewer now.
  for (const File& file : {write_gltf_plant(folder_), write_glb_plant(folder_)}) {
    expect_box(load(file, import), {-0.4f, 0, 0}, {0.4f, 1.6f, 0});
  }
  const File dae = write_dae_plant(folder_);
  expect_box(load(dae, import), {-0.4f, 0, 0}, {0.4f, 0, 1.6f});  // as it says itself
  for (const auto& [axis, name] : {std::pair(UpAxis::kY, "Y_UP"), std::pair(UpAxis::kX, "X_UP")}) {
    std::string text = read_file(dae);
    text.replace(text.find("Z_UP"), 4, name);
    const File says = folder_.write("says.dae", text);
    // The same whether the file says so or the import.
    import.up_axis = axis;
    const Eigen::AlignedBox3f box = load(dae, import).model.bounds;
    expect_box(load(says), box.min(), box.max());
    import.up_axis = UpAxis::kZ;
    expect_box(load(says, import), {-0.4f, 0, 0}, {0.4f, 0, 1.6f});
  }
}

TEST_F(ForeignMeshTest, ScaledTooFarIsAnError) {
  MeshImport import;
  import.scale = 1e6;
  EXPECT_THAT(error_of([&] { load(write_obj_plant(folder_), import); }),
              AllOf(HasSubstr("plant.obj"), HasSubstr("scaled by 1000000")));
}

TEST_F(ForeignMeshTest, WholeFilesGiveNoWarning) {
  for (const File& file : named_plants()) EXPECT_EQ(warning_of(file), "") << file;
}

TEST_F(ForeignMeshTest, NormalsThatAreComputedAreWarnedOf) {
  EXPECT_THAT(warning_of(write_stl_plant(folder_)), HasSubstr("normals are computed smooth"));
  EXPECT_THAT(warning_of(folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n")),
              HasSubstr("normals are computed from the triangles"));
  std::string text = read_file(write_gltf_plant(folder_));
  for (const char* normal : {",\"NORMAL\":1", ",\"NORMAL\":3"}) {
    text.erase(text.find(normal), std::string(normal).size());
  }
  EXPECT_THAT(warning_of(folder_.write("bare.gltf", text)),
              HasSubstr("normals are computed from the triangles"));
}

TEST_F(ForeignMeshTest, AWarningIsGivenOnceAFile) {
  const test::Warnings warnings;
  const File file = write_stl_plant(folder_);
  for (int i = 0; i < 2; ++i) load(file);
  EXPECT_EQ(warnings.all.size(), 1u);
}

/// An .obj of one textured triangle.
std::string textured_obj() {
  return "mtllib skin.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 -1 0\n"
         "usemtl Skin\nf 1/1/1 2/2/1 3/3/1\n";
}

TEST_F(ForeignMeshTest, ImagesAreUsedFromTheMeshsFolderWhateverTheirPath) {
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

/// As Blender writes it: the image by way of a surface and a sampler.
std::string textured_dae(std::string text) {
  const std::string effects = "<library_effects>", technique = "<technique sid=\"common\">";
  const std::string colour = "<color>0.4 0.3 0.2 1</color>";
  text.replace(text.find(colour), colour.size(),
               R"(<texture texture="skin-sampler" texcoord="UVMap"/>)");
  text.insert(text.find(technique), R"(<newparam sid="skin-surface"><surface type="2D">
<init_from>skin</init_from></surface></newparam><newparam sid="skin-sampler"><sampler2D>
<source>skin-surface</source></sampler2D></newparam>)");
  text.insert(text.find(effects), R"(<library_images><image id="skin" name="skin">
<init_from>skin.png</init_from></image></library_images>)");
  return text;
}

TEST_F(ForeignMeshTest, ADaeHasItsImageOrAWarning) {
  const File file = folder_.write("skin.dae", textured_dae(read_file(write_dae_plant(folder_))));
  EXPECT_THAT(warning_of(file), AllOf(HasSubstr("material 'Bark'"), HasSubstr("skin.png"),
                                      HasSubstr("no such file")));
  cv::imwrite((folder_ / "skin.png").string(), cv::Mat(2, 2, CV_8UC3, cv::Scalar(10, 20, 200)));
  EXPECT_EQ(warning_of(file), "");
  const Asset asset = load(file);
  ASSERT_EQ(asset.textures.size(), 1u);
  EXPECT_EQ(material(asset, primitives(asset)[0]).texture, 0);
  EXPECT_EQ(material(asset, primitives(asset)[0]).colour, Vector3f(1, 1, 1));
}

TEST_F(ForeignMeshTest, AnImageThatIsMissingOrUnsupportedLeavesTheColour) {
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

TEST_F(ForeignMeshTest, AMissingMaterialLibraryIsWarnedOf) {
  EXPECT_THAT(warning_of(folder_.write("skin.obj", textured_obj())),
              HasSubstr("material library skin.mtl: no such file"));
}

TEST_F(ForeignMeshTest, LooksThatAreNotDrawnAreWarnedOf) {
  folder_.write("skin.mtl", "newmtl Skin\nKd 1 1 1\nd 0.5\nmap_d mask.png\nmap_Bump bump.png\n");
  EXPECT_THAT(warning_of(folder_.write("skin.obj", textured_obj())),
              AllOf(HasSubstr("material 'Skin' is drawn opaque"), HasSubstr("image of opacity"),
                    HasSubstr("image of bumps")));
}

TEST_F(ForeignMeshTest, LinesAreLeftOutAndWarnedOf) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 0 1\nvn 0 -1 0\nf 1//1 2//1 3//1\n";
  const File file = folder_.write("wire.obj", triangle + "o wire\nl 1 2\nl 2 3\n");
  EXPECT_THAT(warning_of(file), HasSubstr("lines and points are left out"));
  EXPECT_EQ(triangle_count(load(file).model.levels[0]), 1);
}

TEST_F(ForeignMeshTest, VertexColoursOfAnObjAreUsed) {
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

TEST_F(ForeignMeshTest, VertexColoursOfAGltfAreLinear) {
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

TEST_F(ForeignMeshTest, WhatAGltfHasBesidesIsWarnedOf) {
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

TEST_F(ForeignMeshTest, AGltfWithoutItsImageIsDrawnInItsColour) {
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

TEST_F(ForeignMeshTest, ExtensionsOfLooksAreLeftOutAndThoseOfGeometryAreErrors) {
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

TEST_F(ForeignMeshTest, PrimitivesThatAreNoTrianglesAreLeftOut) {
  std::string text = read_file(write_gltf_plant(folder_));
  const std::string last = R"("indices":4,"material":1)";
  text.replace(text.find(last), last.size(), last + ",\"mode\":1");
  const File file = folder_.write("lines.gltf", text);
  EXPECT_THAT(warning_of(file), HasSubstr("lines and points are left out"));
  expect_box(load(file), {-0.05f, 0, 0}, {0.05f, 0, 1});
}

// A grid of n x n places as an .stl has six corners for each of its cells; each place is shared by
// up to six of them. Even flat ground has one normal a place.
TEST_F(ForeignMeshTest, AnStlHasOneVertexAPlace) {
  constexpr int kSide = 40;
  std::string bytes(80, ' ');
  const std::uint32_t count = 2 * (kSide - 1) * (kSide - 1);
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  const auto place = [](int x, int y) {
    return Vector3f(static_cast<float>(x), static_cast<float>(y),
                    0.1f * static_cast<float>(x * y % 3));
  };
  for (int x = 0; x + 1 < kSide; ++x) {
    for (int y = 0; y + 1 < kSide; ++y) {
      const Vector3f a = place(x, y), b = place(x + 1, y), c = place(x + 1, y + 1),
                     d = place(x, y + 1);
      for (const auto& triangle : {std::array{a, b, c}, std::array{a, c, d}}) {
        const Vector3f normal =
            (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
        bytes.append(reinterpret_cast<const char*>(normal.data()), 12);
        for (const Vector3f& v : triangle) {
          bytes.append(reinterpret_cast<const char*>(v.data()), 12);
        }
        bytes.append(2, '\0');
      }
    }
  }
  const Asset asset = load(folder_.write("grid.stl", bytes));
  EXPECT_EQ(vertices(asset), static_cast<std::size_t>(kSide * kSide));
  EXPECT_EQ(triangle_count(asset.model.levels[0]), static_cast<int>(count));
}

}  // namespace
}  // namespace vinebench::sim

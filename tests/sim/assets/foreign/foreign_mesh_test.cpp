// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/foreign/foreign_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <set>

#include "core/files/files.h"
#include "tests/support/foreign_mesh_case.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;
using test::error_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using File = std::filesystem::path;

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

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "sim/assets/asset_file.h"
#include "tests/support/broken_files.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using test::small_plant;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

/// A .gltf of one triangle, any part of which can be replaced.
struct Gltf {
  std::string asset = R"({"version":"2.0"})";
  std::string nodes = R"([{"mesh":0}])";
  std::string scenes = R"([{"nodes":[0]}])";
  std::string primitive = R"({"attributes":{"POSITION":0}})";
  std::string accessor = R"("count":3,"type":"VEC3","componentType":5126,"bufferView":0)";
  std::string view = R"("buffer":0,"byteLength":36)";
  std::string buffer = R"("byteLength":36,"uri":"data:application/octet-stream;base64,)"
                       R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA")";
  std::string more = "";
  std::string text() const {
    return R"({"asset":)" + asset + R"(,"scene":0,"scenes":)" + scenes + R"(,"nodes":)" + nodes +
           R"(,"meshes":[{"primitives":[)" + primitive + R"(]}],"accessors":[{)" + accessor +
           R"(}],"bufferViews":[{)" + view + R"(}],"buffers":[{)" + buffer + "}]" + more + "}";
  }
};

class BrokenGltfTest : public test::BrokenFiles {
 protected:
  /// The message when one part of the file is replaced.
  std::string with(std::string Gltf::*part, const std::string& text) const {
    Gltf gltf;
    gltf.*part = text;
    return problem("broken.gltf", gltf.text());
  }
  /// The message for these materials of the triangle.
  std::string with_material(const std::string& more) const {
    Gltf gltf;
    gltf.primitive = R"({"attributes":{"POSITION":0},"material":0})";
    gltf.more = more;
    return message("broken.gltf", gltf.text());
  }
  std::string with_image(const std::string& image) const {
    return with_material(
        R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
        R"("textures":[{"source":0}],"images":[)" +
        image + "]");
  }
};

TEST_F(BrokenGltfTest, TheTriangleItselfIsWhole) {
  EXPECT_EQ(message("whole.gltf", Gltf{}.text()), "");
}

TEST_F(BrokenGltfTest, OtherVersions) {
  EXPECT_THAT(with(&Gltf::asset, R"({"version":"1.0"})"), HasSubstr("found version '1.0'"));
  EXPECT_THAT(with(&Gltf::asset, "[]"), HasSubstr("expected glTF 2.0"));
  std::string glb = to_glb(small_plant());
  glb[4] = 1;
  EXPECT_THAT(problem("old.glb", glb), HasSubstr("found version 1"));
}

TEST_F(BrokenGltfTest, Cycles) {
  EXPECT_THAT(with(&Gltf::nodes, R"([{"mesh":0,"children":[0]}])"), HasSubstr("64 deep"));
  EXPECT_THAT(with(&Gltf::nodes, R"([{"children":[1,1]},{"mesh":0,"children":[0,0]}])"),
              HasSubstr("64 deep"));
  Gltf gltf;
  gltf.scenes = "[]";
  gltf.nodes = R"([{"children":[1]},{"mesh":0,"children":[0]}])";
  problem("no_root.gltf", gltf.text());
}

TEST_F(BrokenGltfTest, FewNodesThatUnfoldToMany) {
  std::string nodes = "[";
  for (int i = 1; i <= 40; ++i) nodes += fmt::format(R"({{"children":[{},{}]}},)", i, i);
  EXPECT_THAT(with(&Gltf::nodes, nodes + R"({"mesh":0}])"), HasSubstr("more than 100000 nodes"));
}

/// A mesh of a megabyte with 99 999 instances.
TEST_F(BrokenGltfTest, OneMeshShownTooOften) {
  Gltf gltf;
  folder_.write("big.bin", std::string(1 << 20, '\0'));
  gltf.buffer = R"("byteLength":1048576,"uri":"big.bin")";
  gltf.view = R"("buffer":0,"byteLength":1048576)";
  gltf.accessor = R"("count":87381,"type":"VEC3","componentType":5126,"bufferView":0)";
  std::string nodes = R"([{"children":[1)";
  for (int i = 0; i < 2000; ++i) nodes += ",1";
  gltf.nodes = nodes + R"(]},{"mesh":0}])";
  EXPECT_THAT(problem("often.gltf", gltf.text()), HasSubstr("more than 512 MiB"));
}

TEST_F(BrokenGltfTest, DeepNesting) {
  std::string chain = "[";
  for (int i = 1; i < 200; ++i) chain += fmt::format(R"({{"children":[{}]}},)", i);
  EXPECT_THAT(with(&Gltf::nodes, chain + R"({"mesh":0}])"), HasSubstr("64 deep"));
  const std::string open(500'000, '['), close(500'000, ']');
  EXPECT_THAT(with(&Gltf::more, R"(,"extras":)" + open + close), HasSubstr("nested more than 200"));
  EXPECT_THAT(with(&Gltf::more, R"(,"extras":)" + open), HasSubstr("nested more than 200"));
  EXPECT_EQ(with_material(R"(,"materials":[{"name":"\"[[[[{{{{\\"}])"), "");
}

TEST_F(BrokenGltfTest, MissingBuffers) {
  const auto buffer = [&](const std::string& text) { return with(&Gltf::buffer, text); };
  EXPECT_THAT(buffer(R"("byteLength":36)"), HasSubstr("uri"));
  EXPECT_THAT(buffer(R"("byteLength":36,"uri":"gone.bin")"), HasSubstr("gone.bin"));
  folder_.write("empty.bin", "");
  EXPECT_THAT(buffer(R"("byteLength":36,"uri":"empty.bin")"), HasSubstr("empty.bin"));
  folder_.write("short.bin", "0123");
  EXPECT_THAT(buffer(R"("byteLength":36,"uri":"short.bin")"), HasSubstr("short.bin"));
  std::filesystem::create_directory(folder_ / "folder.bin");
  EXPECT_THAT(buffer(R"("byteLength":36,"uri":"folder.bin")"),
              AllOf(HasSubstr("folder.bin"), HasSubstr("is a folder")));
  EXPECT_THAT(buffer(R"("byteLength":36,"uri":"/dev/zero")"), HasSubstr("/dev/zero"));
  EXPECT_THAT(buffer(R"("byteLength":36,"uri":"data:application/octet-stream;base64,AA")"),
              HasSubstr("expected glTF 2.0"));
  EXPECT_THAT(buffer(R"("byteLength":99999999999,"uri":"short.bin")"), HasSubstr("short.bin"));
}

TEST_F(BrokenGltfTest, ViewsAndAccessorsOutOfRange) {
  const auto view = [&](const std::string& text) { return with(&Gltf::view, text); };
  EXPECT_THAT(view(R"("buffer":1,"byteLength":36)"), HasSubstr("names buffer 1 of 1"));
  EXPECT_THAT(view(R"("buffer":-1,"byteLength":36)"), HasSubstr("names buffer -1 of 1"));
  EXPECT_THAT(view(R"("buffer":0,"byteLength":37)"), HasSubstr("of a buffer of 36"));
  EXPECT_THAT(view(R"("buffer":0,"byteLength":36,"byteOffset":4)"), HasSubstr("buffer of 36"));
  EXPECT_THAT(view(R"("buffer":0,"byteLength":36,"byteOffset":18446744073709551600)"),
              HasSubstr("buffer view 0"));
  EXPECT_THAT(view(R"("buffer":0,"byteLength":36,"byteStride":4)"), HasSubstr("does not fit"));
  const auto accessor = [&](const std::string& count, const std::string& rest) {
    return with(&Gltf::accessor, R"("type":"VEC3","count":)" + count + "," + rest);
  };
  const std::string real = R"("componentType":5126)";
  EXPECT_THAT(accessor("3", real), HasSubstr("accessor 0 names no buffer view"));
  EXPECT_THAT(accessor("3", real + R"(,"bufferView":9)"), HasSubstr("names buffer view 9 of 1"));
  for (const char* count : {"4", "4000000000", "1537228672809129302", "18446744073709551615"}) {
    EXPECT_THAT(accessor(count, real + R"(,"bufferView":0)"), HasSubstr("does not fit"));
  }
  EXPECT_THAT(accessor("0", real + R"(,"bufferView":0)"), HasSubstr("no triangles"));
  EXPECT_THAT(accessor("-3", real + R"(,"bufferView":0)"), HasSubstr("expected glTF 2.0"));
  EXPECT_THAT(accessor("3", real + R"(,"bufferView":0,"byteOffset":99)"), HasSubstr("not fit"));
}

TEST_F(BrokenGltfTest, UnsupportedNumbers) {
  const auto kind = [&](const char* type) {
    return with(&Gltf::accessor,
                fmt::format(R"("type":"VEC3","count":3,"bufferView":0,"componentType":{})", type));
  };
  EXPECT_THAT(kind("5125"), HasSubstr("component type 5125, expected real numbers"));
  EXPECT_THAT(kind("5124"), HasSubstr("component type 5124, expected real numbers"));
  EXPECT_THAT(kind("5127"), HasSubstr("component type"));
  EXPECT_THAT(kind("7"), HasSubstr("componentType"));
  EXPECT_THAT(with(&Gltf::primitive, R"({"attributes":{"POSITION":0},"indices":0})"),
              HasSubstr("unexpected type"));
  Gltf gltf;
  gltf.primitive = R"({"attributes":{"POSITION":0},"indices":1})";
  gltf.accessor += R"(},{"count":9,"type":"SCALAR","componentType":5126,"bufferView":0)";
  EXPECT_THAT(problem("indices.gltf", gltf.text()), HasSubstr("expected whole numbers"));
}

TEST_F(BrokenGltfTest, SparseAccessors) {
  const std::string dense = Gltf{}.accessor;
  EXPECT_THAT(
      with(&Gltf::accessor,
           dense + R"(,"sparse":{"count":1,"indices":{"bufferView":0,"componentType":5123},)"
                   R"("values":{"bufferView":0}})"),
      HasSubstr("is sparse, expected a dense one"));
  EXPECT_THAT(with(&Gltf::accessor, dense + R"(,"sparse":{"count":1})"), HasSubstr("indices"));
}

TEST_F(BrokenGltfTest, PrimitivesThatNameWhatIsNotThere) {
  const auto primitive = [&](const std::string& text) { return with(&Gltf::primitive, text); };
  EXPECT_THAT(primitive(R"({"attributes":{}})"), HasSubstr("no positions"));
  EXPECT_THAT(primitive(R"({"attributes":{"POSITION":5}})"), HasSubstr("names accessor 5 of 1"));
  EXPECT_THAT(primitive(R"({"attributes":{"POSITION":0},"indices":3})"), HasSubstr("accessor"));
  EXPECT_THAT(primitive(R"({"attributes":{"POSITION":0,"NORMAL":3}})"), HasSubstr("accessor 3"));
  EXPECT_THAT(primitive(""), HasSubstr("no triangles"));
  EXPECT_THAT(with(&Gltf::scenes, R"([{"nodes":[4]}])"), HasSubstr("names node 4 of 1"));
  EXPECT_THAT(with(&Gltf::nodes, R"([{"mesh":0,"children":[-7]}])"), HasSubstr("names node -7"));
}

TEST_F(BrokenGltfTest, NodesThatFlattenOrThrowFar) {
  const auto nodes = [&](const std::string& text) { return with(&Gltf::nodes, text); };
  EXPECT_THAT(nodes(R"([{"mesh":0,"scale":[1,0,1]}])"), HasSubstr("flattens"));
  EXPECT_THAT(nodes(R"([{"mesh":0,"scale":[1e30,1e30,1e30]}])"),
              AnyOf(HasSubstr("finite"), HasSubstr("m from the origin")));
  EXPECT_THAT(nodes(R"([{"mesh":0,"translation":[1e300,0,0]}])"), HasSubstr("finite"));
  EXPECT_THAT(nodes(R"([{"mesh":0,"matrix":[1,0]}])"), HasSubstr("matrix of 2 numbers"));
  EXPECT_THAT(nodes(R"([{"mesh":0,"translation":[1e7,0,0]}])"), HasSubstr("m from the origin"));
}

TEST_F(BrokenGltfTest, MaterialsOutOfRange) {
  const auto material = [&](const std::string& text) {
    return with_material(R"(,"materials":[{)" + text + "}]");
  };
  EXPECT_EQ(material(""), "");
  EXPECT_THAT(material(R"("extras":{"label":99})"), HasSubstr("label: expected a number from 0"));
  EXPECT_THAT(material(R"("extras":{"label":1e300})"), HasSubstr("label"));
  EXPECT_THAT(material(R"("extras":{"label":"leaves"})"),
              HasSubstr("label: expected a label's name, such as \"leaf\", found \"leaves\""));
  EXPECT_THAT(material(R"("extras":{"translucency":-1})"), HasSubstr("translucency"));
  const std::string colour = R"("pbrMetallicRoughness":{"baseColorFactor":[)";
  EXPECT_THAT(material(colour + "1e30,1,1,1]}"), HasSubstr("expected a colour"));
  EXPECT_THAT(material(colour + "-1,1,1,1]}"), HasSubstr("expected a colour"));
  EXPECT_THAT(material(colour + "NaN,1,1,1]}"), HasSubstr("expected glTF 2.0"));
  EXPECT_THAT(material(colour + "1,1]}"), HasSubstr("must be 4, but got 2"));
  EXPECT_THAT(material(R"("pbrMetallicRoughness":{"baseColorTexture":{"index":4}})"),
              HasSubstr("names texture 4 of 0"));
  const std::string missing = R"(,"materials":[{}],"textures":[{"source":3}])";
  EXPECT_THAT(with_material(missing), HasSubstr("names image 3 of 0"));
}

TEST_F(BrokenGltfTest, LevelsOutOfRange) {
  const auto level = [&](const std::string& until, const std::string& ids) {
    return message("level.gltf", [&] {
      Gltf gltf;
      gltf.nodes = R"([{"mesh":0,"extras":{"until":)" + until +
                   R"(},"extensions":{"MSFT_lod":{"ids":)" + ids + R"(}}},{"mesh":0}])";
      return gltf.text();
    }());
  };
  EXPECT_EQ(level("[2,100]", "[1]"), "");
  EXPECT_THAT(level("[2,100]", "[7]"), HasSubstr("MSFT_lod: expected a number from 0 to 1"));
  EXPECT_THAT(level("[2,100]", "[\"a\"]"), HasSubstr("MSFT_lod"));
  EXPECT_THAT(level("[-2,100]", "[1]"), HasSubstr("until"));
  EXPECT_THAT(level("[2,1e99]", "[1]"), HasSubstr("until"));
}

TEST_F(BrokenGltfTest, Images) {
  EXPECT_THAT(with_image(R"({"uri":"gone.png"})"), HasSubstr("gone.png"));
  std::filesystem::create_directory(folder_ / "folder.png");
  EXPECT_THAT(with_image(R"({"uri":"folder.png"})"), HasSubstr("folder.png"));
  EXPECT_THAT(with_image(R"({"bufferView":0})"), HasSubstr("expected an image"));
  EXPECT_THAT(with_image(R"({"bufferView":77})"), HasSubstr("77"));
  EXPECT_THAT(with_image(R"({"bufferView":-2})"), HasSubstr("-2"));
  EXPECT_THAT(with_image(R"({"uri":"data:image/png;base64,"})"), testing::Ne(""));
  EXPECT_THAT(with_image("{}"), testing::Ne(""));
  const auto image = [&](const char* name, const std::string& bytes) {
    folder_.write(name, bytes);
    return with_image(fmt::format(R"({{"uri":"{}"}})", name));
  };
  std::vector<unsigned char> encoded;
  const cv::Mat skin(40, 30, CV_8UC3, cv::Scalar(10, 200, 20));
  for (const char* kind : {".png", ".jpg", ".tif"}) {
    cv::imencode(kind, skin, encoded);
    const std::string bytes(encoded.begin(), encoded.end());
    EXPECT_EQ(image("skin", bytes), "") << kind;
    EXPECT_THAT(image("skin", bytes.substr(0, 20)), HasSubstr("expected an image")) << kind;
  }
  EXPECT_THAT(image("text.png", "no image"), HasSubstr("found something else"));
}

/// A PNG whose header asks for 16 gigapixels.
TEST_F(BrokenGltfTest, ImagesOfAbsurdSize) {
  std::vector<unsigned char> encoded;
  cv::imencode(".png", cv::Mat(2, 2, CV_8UC3, cv::Scalar(1, 2, 3)), encoded);
  const auto with_size = [&](unsigned columns, unsigned rows) {
    std::string bytes(encoded.begin(), encoded.end());
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[16 + i] = static_cast<char>(columns >> (24 - 8 * i));
      bytes[20 + i] = static_cast<char>(rows >> (24 - 8 * i));
    }
    folder_.write("skin.png", bytes);
    return with_image(R"({"uri":"skin.png"})");
  };
  EXPECT_THAT(with_size(131072, 131072), HasSubstr("found 131072 x 131072"));
  EXPECT_THAT(with_size(16384, 16384), HasSubstr("16777216 in all"));
  EXPECT_THAT(with_size(20000, 1), HasSubstr("1 to 16384 pixels a side"));
  EXPECT_THAT(with_size(0, 7), HasSubstr("found 0 x 7"));
}

TEST_F(BrokenGltfTest, NamesThatAreNoUtf8) {
  const std::string name = "vigne\xe9\xff";
  EXPECT_EQ(message(name + ".glb", to_glb(small_plant())), "");
  EXPECT_THAT(problem(name + ".gltf", "{"), HasSubstr(name));
  Asset plant = small_plant();
  plant.model.name = name;
  EXPECT_THAT(error_of([&] { to_glb(plant); }), HasSubstr("cannot be written"));
  EXPECT_THAT(with_material(R"(,"materials":[{"name":")" + name + "\"}]"), HasSubstr("UTF-8"));
}

}  // namespace
}  // namespace vinebench::sim

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/util/random.h"
#include "sim/assets/asset_file.h"
#include "tests/support/broken_files.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using test::small_plant;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

class BrokenAssetsTest : public test::BrokenFiles {};

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

std::uint32_t word(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

/// The .gltf of a .glb: its JSON with an embedded buffer.
std::string as_gltf(const std::string& glb) {
  const std::size_t size = word(glb, 12);
  std::string json = glb.substr(20, size);
  const std::size_t buffer = json.find("\"byteLength\"", json.find("\"buffers\""));
  json.insert(buffer, "\"uri\":\"data:application/octet-stream;base64," +
                          base64(std::string_view(glb).substr(28 + size)) + "\",");
  return json;
}

TEST_F(BrokenAssetsTest, ThePlantItselfIsWhole) {
  const std::string glb = to_glb(small_plant());
  EXPECT_EQ(message("plant.glb", glb), "");
  EXPECT_EQ(message("plant.gltf", as_gltf(glb)), "");
}

TEST_F(BrokenAssetsTest, CutShort) {
  const std::string glb = to_glb(small_plant()), gltf = as_gltf(glb);
  for (std::size_t i = 0; i < 16; ++i) {
    problem("short.glb", glb.substr(0, i * glb.size() / 16));
    problem("short.gltf", gltf.substr(0, i * gltf.size() / 16));
  }
  EXPECT_THAT(problem("short.glb", glb.substr(0, glb.size() - 1)), HasSubstr("is it truncated?"));
}

/// The chunk of the buffer claims up to 8 bytes more than the file has.
TEST_F(BrokenAssetsTest, AChunkThatEndsBehindTheFile) {
  std::string glb = to_glb(small_plant());
  const std::size_t at = 20 + word(glb, 12);
  const std::uint32_t more = word(glb, at) + 8;
  std::memcpy(glb.data() + at, &more, 4);
  EXPECT_THAT(problem("long.glb", glb), HasSubstr("does not fit into the file"));
}

/// Three bytes of 600 files are replaced, most often in the JSON, where errors are most likely.
TEST_F(BrokenAssetsTest, BytesThatChanged) {
  const std::string glb = to_glb(small_plant()), gltf = as_gltf(glb);
  RandomSequence random(RandomStream(7, "broken assets"));
  int errors = 0;
  for (int i = 0; i < 600; ++i) {
    std::string bytes = i % 2 == 0 ? glb : gltf;
    const auto json = static_cast<int>(word(glb, 12));
    for (int k = 0; k < 3; ++k) {
      const int range = i % 3 == 0 ? static_cast<int>(bytes.size()) : json;
      const int digit = random.below(2);
      bytes[static_cast<std::size_t>(random.below(range))] =
          static_cast<char>(digit ? '0' + random.below(10) : random.below(256));
    }
    const std::string error = message(i % 2 == 0 ? "flip.glb" : "flip.gltf", bytes);
    errors += error.empty() ? 0 : 1;
  }
  EXPECT_GT(errors, 200);
  EXPECT_LT(errors, 600);  // changed names and colours are valid
}

TEST_F(BrokenAssetsTest, NumbersThatAreNone) {
  const auto broken = [&](auto change) {
    Asset plant = small_plant();
    change(plant, plant.model.levels[0].primitives[1].vertices[2]);
    return problem("nan.glb", to_glb(plant));
  };
  EXPECT_THAT(broken([](Asset&, Vertex& v) { v.position.y() = kNotANumber; }),
              HasSubstr("vertex 2 is not a finite number"));
  EXPECT_THAT(broken([](Asset&, Vertex& v) { v.normal.x() = kNotANumber; }), HasSubstr("vertex 2"));
  EXPECT_THAT(broken([](Asset&, Vertex& v) { v.uv.x() = INFINITY; }), HasSubstr("vertex 2"));
  EXPECT_THAT(broken([](Asset&, Vertex& v) { v.occlusion = kNotANumber; }), HasSubstr("vertex 2"));
  EXPECT_THAT(broken([](Asset&, Vertex& v) { v.position.z() = 1e20f; }),
              HasSubstr("vertex 2 lies more than"));
}

TEST_F(BrokenAssetsTest, TrianglesWithoutAreaAreHarmless) {
  Asset plant = small_plant();
  for (Vertex& v : plant.model.levels[0].primitives[0].vertices) v.position.setZero();
  EXPECT_EQ(message("flat.glb", to_glb(plant)), "");
  EXPECT_EQ(message("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\nf 1 2 4\n"),
            "");
}

TEST_F(BrokenAssetsTest, MeshesWithoutTriangles) {
  Asset plant = small_plant();
  plant.model.levels[1].primitives.clear();
  EXPECT_THAT(problem("none.glb", to_glb(plant)), HasSubstr("no triangles"));
  problem("none.obj", "# nothing\n");
  problem("points.obj", "v 0 0 0\nv 1 0 0\np 1 2\n");
}

TEST_F(BrokenAssetsTest, WhatIsNoFile) {
  for (const std::string kind : {"glb", "gltf", "obj", "stl", "dae"}) {
    EXPECT_THAT(problem("empty." + kind, ""), HasSubstr("empty"));
    const auto folder = folder_ / ("folder." + kind);
    std::filesystem::create_directory(folder);
    EXPECT_THAT(error_of([&] { load_asset(folder); }),
                AllOf(HasSubstr(folder.string()), HasSubstr("is a folder")));
    const auto gone = folder_ / ("gone." + kind);
    EXPECT_THAT(error_of([&] { load_asset(gone); }),
                AllOf(HasSubstr(gone.string()), HasSubstr("No such file")));
    const auto pipe = folder_ / ("pipe." + kind);
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(error_of([&] { load_asset(pipe); }), HasSubstr("a pipe or a device"));
    const auto huge = folder_.write("huge." + kind, "x");
    std::filesystem::resize_file(huge, (std::uintmax_t{1} << 30) + 1);  // sparse file
    EXPECT_THAT(error_of([&] { load_asset(huge); }), HasSubstr("at most 1 GiB"));
  }
}

TEST_F(BrokenAssetsTest, AFileThatMayNotBeRead) {
  if (geteuid() == 0) GTEST_SKIP() << "the superuser may read all";
  const auto file = folder_.write("secret.glb", to_glb(small_plant()));
  std::filesystem::permissions(file, std::filesystem::perms::none);
  EXPECT_THAT(error_of([&] { load_asset(file); }), HasSubstr("Permission denied"));
}

/// A document of one triangle with that node in its scene and these further nodes.
std::string dae(const std::string& node, const std::string& count = "9") {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<!-- a comment with <tags> --><asset><unit name="m" meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" count=")" +
         count + R"(">0 0 0 1 0 0 0 0 2</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s">)" +
         node + R"(</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

const std::string kLeafNode = R"(<node id="n"><instance_geometry url="#g"/></node>)";

TEST_F(BrokenAssetsTest, ColladaThatContainsItself) {
  EXPECT_EQ(message("whole.dae", dae(kLeafNode)), "");
  EXPECT_THAT(problem("self.dae", dae(R"(<node id="n"><instance_geometry url="#g"/>)"
                                      R"(<instance_node url="#n"/></node>)")),
              HasSubstr("in themselves"));
  EXPECT_THAT(
      problem("pair.dae", dae(R"(<node id="a"><instance_node url='#b'/></node>)"
                              R"(<node id="b"><node id="c"><instance_node url="#a"/></node>)"
                              R"(<instance_geometry url="#g"/></node>)")),
      HasSubstr("in themselves"));
  std::string nodes = kLeafNode;
  for (int i = 0; i < 40; ++i) {
    const std::string next = i == 0 ? "n" : fmt::format("n{}", i - 1);
    nodes +=
        fmt::format(R"(<node id="n{}"><instance_node url="#{}"/><instance_node url="#{}"/></node>)",
                    i, next, next);
  }
  EXPECT_THAT(problem("many.dae", dae(nodes)), HasSubstr("more than 100000 nodes"));
}

TEST_F(BrokenAssetsTest, ColladaThatIsDeepOrLong) {
  const auto nested = [](int deep, const std::string& open, const std::string& close) {
    std::string text;
    for (int i = 0; i < deep; ++i) text += open;
    text += kLeafNode;
    for (int i = 0; i < deep; ++i) text += close;
    return dae(text);
  };
  EXPECT_EQ(message("nested.dae", nested(20, "<node>", "</node>")), "");
  EXPECT_THAT(problem("deep.dae", nested(100'000, "<node>", "</node>")), HasSubstr("more than"));
  EXPECT_THAT(problem("deep.dae", nested(100'000, "<extra>", "</extra>")), HasSubstr("more than"));
  EXPECT_THAT(problem("long.dae", dae(kLeafNode, "4000000000")),
              HasSubstr("a list of 4000000000 items"));
  problem("text.dae", dae("<node><instance_geometry url=\"#gone\"/></node>"));
}

/// Broken bytes for assimp's readers.
TEST_F(BrokenAssetsTest, OtherFormatsThatChanged) {
  std::string stl(84, ' ');
  stl[80] = 4;
  stl[81] = stl[82] = stl[83] = 0;
  for (int i = 0; i < 200; ++i) stl += static_cast<char>(i % 50 == 15 ? 63 : i % 7);
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 0 0 2\nvt 0 0\nvt 1 0\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/1\n";
  RandomSequence random(RandomStream(8, "broken assets"));
  for (const auto& [name, whole] : {std::pair<std::string, std::string>{"a.obj", obj},
                                    {"a.stl", stl},
                                    {"a.dae", dae(kLeafNode)}}) {
    for (int i = 0; i < 150; ++i) {
      std::string bytes = whole.substr(0, i % 5 == 0 ? whole.size() * i / 150 : whole.size());
      for (int k = 0; k < 3 && !bytes.empty(); ++k) {
        bytes[static_cast<std::size_t>(random.below(static_cast<int>(bytes.size())))] =
            static_cast<char>(random.below(2) ? '0' + random.below(10) : random.below(256));
      }
      message(name, bytes);
    }
  }
}

TEST_F(BrokenAssetsTest, ObjThatNamesWhatIsNotThere) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 0 2\n";
  for (const char* face : {"f 1 2 9", "f 1 2 99999999999999999999", "f 0 1 2", "f -9 -8 -7"}) {
    message("far.obj", corners + face + "\n");  // assimp drops some of them
  }
  EXPECT_THAT(problem("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 0 2\nf 1 2 3\n"), HasSubstr("finite"));
  EXPECT_THAT(problem("far.obj", "v 1e30 0 0\nv 1 0 0\nv 0 0 2\nf 1 2 3\n"),
              AnyOf(HasSubstr("origin"), HasSubstr("finite")));
}

}  // namespace
}  // namespace vinebench::sim

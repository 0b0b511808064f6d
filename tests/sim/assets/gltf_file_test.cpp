// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/gltf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kEmpty = R"({"asset":{"version":"2.0"}})";

/// A .glb whose JSON chunk is that text.
std::string glb(std::string json, std::uint32_t version = 2) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto number = [](std::size_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &bits, 4);
    return bytes;
  };
  return "glTF" + number(version) + number(20 + json.size()) + number(json.size()) + "JSON" + json;
}

class GltfFileTest : public testing::Test {
 protected:
  tinygltf::Model parsed(const std::string& name, const std::string& content) const {
    return parse_gltf(content, folder_ / name);
  }
  /// The message for a file of that content, which must name it.
  std::string problem(const std::string& name, const std::string& content) const {
    const std::string error = error_of([&] { parsed(name, content); });
    EXPECT_THAT(error, HasSubstr((folder_ / name).string()));
    return error;
  }
  test::TestFolder folder_;
};

TEST_F(GltfFileTest, TheFirstBytesTellTextFromBinary) {
  EXPECT_EQ(parsed("named_so.glb", kEmpty).asset.version, "2.0");
  EXPECT_EQ(parsed("named_so.gltf", glb(kEmpty)).asset.version, "2.0");
}

TEST_F(GltfFileTest, BuffersAreReadFromBesideTheFile) {
  folder_.write("points.bin", "abcdef");
  const tinygltf::Model model =
      parsed("a.gltf", R"({"asset":{"version":"2.0"},"buffers":[)"
                       R"({"byteLength":6,"uri":"points.bin"},)"
                       R"({"byteLength":3,"uri":"data:application/octet-stream;base64,eHl6"}]})");
  ASSERT_EQ(model.buffers.size(), 2u);
  const auto text = [&](std::size_t i) {
    return std::string(model.buffers[i].data.begin(), model.buffers[i].data.end());
  };
  EXPECT_EQ(text(0), "abcdef");
  EXPECT_EQ(text(1), "xyz");
}

TEST_F(GltfFileTest, ImagesStayTheBytesOfTheirFiles) {
  folder_.write("skin.png", "not decoded here");
  const tinygltf::Model model =
      parsed("a.gltf", R"({"asset":{"version":"2.0"},"images":[{"uri":"skin.png"}]})");
  const std::vector<unsigned char>& bytes = model.images.at(0).image;
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), "not decoded here");
}

TEST_F(GltfFileTest, OtherVersionsAndExtensionsAreRefused) {
  EXPECT_THAT(problem("a.gltf", R"({"asset":{"version":"1.0"}})"),
              HasSubstr("found version '1.0'"));
  EXPECT_THAT(problem("a.glb", glb(kEmpty, 1)), HasSubstr("found version 1"));
  EXPECT_THAT(problem("b.gltf", R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_draco"],)"
                                R"("extensionsRequired":["KHR_draco"]})"),
              HasSubstr("needs the glTF extension KHR_draco"));
}

TEST_F(GltfFileTest, LengthsOfAGlbMustFit) {
  const std::string whole = glb(kEmpty);
  EXPECT_THAT(problem("a.glb", whole.substr(0, 19)), HasSubstr("found only 19 bytes"));
  EXPECT_THAT(problem("a.glb", whole.substr(0, whole.size() - 1)), HasSubstr("is it truncated?"));
  std::string longer = whole;
  longer[12] = static_cast<char>(longer[12] + 4);  // the chunk's length
  EXPECT_THAT(problem("a.glb", longer), HasSubstr("the chunk at byte 12 does not fit"));
}

TEST_F(GltfFileTest, DeepJsonIsRefusedBeforeItIsParsed) {
  const auto nested = [](std::size_t depth) {
    return R"({"asset":{"version":"2.0"},"extras":)" + std::string(depth, '[') +
           std::string(depth, ']') + "}";
  };
  EXPECT_EQ(parsed("a.gltf", nested(199)).asset.version, "2.0");  // 200 with the outer braces
  EXPECT_THAT(problem("a.gltf", nested(200)), HasSubstr("nested more than 200 deep"));
  EXPECT_THAT(problem("a.glb", glb(nested(200))), HasSubstr("nested more than 200 deep"));
  // Brackets of a text do not count, nor does a quote that is escaped end it.
  const std::string text(300, '[');
  EXPECT_EQ(
      parsed("b.gltf", R"({"asset":{"version":"2.0"},"extras":"\")" + text + "\"}").asset.version,
      "2.0");
}

TEST_F(GltfFileTest, MessagesAreOneShortLine) {
  const std::string error = problem("a.gltf", "{\"asset\":\n\"" + std::string(5000, 'x'));
  EXPECT_THAT(error, AllOf(HasSubstr("expected glTF 2.0"), Not(HasSubstr("\n"))));
  EXPECT_LT(error.size(), 600u);
  EXPECT_THAT(problem("b.gltf", R"({"asset":{"version":"2.0"},"buffers":[)"
                                R"({"byteLength":6,"uri":"gone.bin"}]})"),
              HasSubstr("gone.bin"));
}

}  // namespace
}  // namespace vinebench::sim

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/occluders/occluder_lists.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/yaml.h"
#include "core/config/yaml_writer.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;
using testing::Not;

struct File {
  std::vector<Occluder> occluders;
  template <class Archive>
  void serialize(Archive& archive) {
    serialize_occluders(archive, occluders, true);
  }
};

class OccluderListsTest : public testing::Test {
 protected:
  File read(const std::string& text) const {
    return YamlDocument::load(folder_.write("world.yaml", text)).read<File>();
  }
  test::TestFolder folder_;
};

TEST_F(OccluderListsTest, OlderKeysGiveTheSameOccluders) {
  const File old = read(
      "boxes: [{name: b, size: [1, 2, 3], position: [4, 5], yaw_deg: 6}]\n"
      "obstacles: [{kind: crate, position: [7, 8]}, {height: 1.6}]\n");
  ASSERT_EQ(old.occluders.size(), 3u);
  EXPECT_EQ(class_of(old.occluders[0]), OccluderClass::kCarton);
  EXPECT_EQ(size_of(old.occluders[0]), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(class_of(old.occluders[1]), OccluderClass::kCrate);
  EXPECT_EQ(size_of(old.occluders[1]), Eigen::Vector3d(0.6, 0.4, 0.3));
  EXPECT_EQ(class_of(old.occluders[2]), OccluderClass::kPerson);
  EXPECT_NEAR(size_of(old.occluders[2]).z(), 1.6, 1e-12);
}

TEST_F(OccluderListsTest, AFileIsWrittenInTheFormThatItWasReadIn) {
  const std::string text = format_yaml(read("boxes: [{}]\nobstacles: [{height: 1.6}]\n"));
  EXPECT_THAT(text, HasSubstr("boxes:\n  -\n    name: \"carton\"\n    size: [0.6, 0.4, 0.4]\n"));
  EXPECT_THAT(text, HasSubstr("obstacles:\n  -\n    kind: person\n"));
  EXPECT_THAT(text, Not(HasSubstr("occluders")));  // as before there was such a list
  EXPECT_EQ(format_yaml(read(text)), text);
}

TEST_F(OccluderListsTest, OnlyAMeshIsImportedAndIsScaledToItsSize) {
  folder_.write("a.obj", "v 0 0 0\n");
  const std::string mesh = "occluders: [{shape: mesh, mesh: a.obj, size: [1, 1, 1], mesh_import: ";
  const File file = read(mesh + "{up_axis: y, labels: {a: crate}}}]\n");
  EXPECT_EQ(file.occluders.at(0).mesh_import->up_axis, UpAxis::kY);
  EXPECT_THAT(format_yaml(file), HasSubstr("labels:\n        \"a\": crate\n"));
  EXPECT_THAT(test::error_of([&] { read(mesh + "{scale: 2}}]\n"); }),
              HasSubstr("occluders.0.mesh_import: expected no `scale`"));
  EXPECT_THAT(test::error_of([&] { read("occluders: [{mesh_import: {}}]\n"); }),
              HasSubstr("expected only where the shape is mesh"));
}

TEST_F(OccluderListsTest, AnyShapeMayBeOfAnyClass) {
  const File file = read(
      "occluders:\n"
      "  - {shape: sheet, position: [1, 2], lift: 0.3}\n"
      "  - {shape: cylinder, class: leaf, name: vine shoot}\n");
  ASSERT_EQ(file.occluders.size(), 2u);
  EXPECT_EQ(class_of(file.occluders[0]), OccluderClass::kTarpaulin);
  EXPECT_EQ(name_of(file.occluders[0]), "tarpaulin");
  EXPECT_EQ(class_of(file.occluders[1]), OccluderClass::kLeaf);
  EXPECT_EQ(name_of(file.occluders[1]), "vine shoot");
  EXPECT_EQ(read(format_yaml(file)).occluders.size(), 2u);
}

TEST_F(OccluderListsTest, APathIsReadAndWrittenAndAbsentWhereThereIsNone) {
  const File file = read(
      "occluders:\n"
      "  - shape: person\n"
      "    path: {waypoints: [{position: [1, 2]}, {position: [3, 2], wait: 1}], loop: true}\n");
  ASSERT_TRUE(file.occluders.at(0).path);
  EXPECT_EQ(file.occluders[0].path->waypoints.at(1).wait, 1);
  EXPECT_TRUE(file.occluders[0].path->loop);
  EXPECT_EQ(format_yaml(read(format_yaml(file))), format_yaml(file));
  EXPECT_THAT(format_yaml(read("occluders: [{shape: person}]\n")), Not(HasSubstr("path")));
}

TEST_F(OccluderListsTest, ErrorsNameTheKey) {
  const auto error = [&](const std::string& entry) {
    return test::error_of([&] { read("occluders: [" + entry + "]\n"); });
  };
  EXPECT_THAT(error("{class: bear}"), HasSubstr("occluders.0.class"));
  EXPECT_THAT(error("{shape: mesh}"), HasSubstr("occluders.0.mesh"));
  EXPECT_THAT(error("{shape: person, size: [1, 1, 1]}"), HasSubstr("occluders.0.size"));
  EXPECT_THAT(error("{kind: person}"), HasSubstr("occluders.0.kind"));
}

TEST(AppendOccludersTest, KeepsTheOrderOfTheLists) {
  std::vector<Occluder> world(3);
  world[0].list = Occluder::List::kBoxes;
  world[1].list = Occluder::List::kObstacles;
  std::vector<Occluder> scenario(2);
  scenario[0].name = "added box";
  scenario[0].list = Occluder::List::kBoxes;
  scenario[1].name = "added";
  append_occluders(world, scenario);
  EXPECT_EQ(world[1].name, "added box");
  EXPECT_EQ(world[4].name, "added");
}

}  // namespace
}  // namespace vinebench::sim

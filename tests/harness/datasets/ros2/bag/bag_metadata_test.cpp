// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/bag_metadata.h"

#include <gmock/gmock.h>
#include <yaml-cpp/yaml.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(BagMetadataTest, SaysWhatIsInTheFile) {
  const McapChannel topic{
      "/tf_static", "tf2_msgs/msg/TFMessage", "", {{kQualityKey, quality_of_service(true)}}, 1};
  const McapStatistics statistics{270, 1'000'000'000, 1'400'000'000, 7, 1};
  const YAML::Node bag = YAML::Load(
      format_bag_metadata("run.mcap", {topic}, statistics))["rosbag2_bagfile_information"];
  EXPECT_EQ(bag["storage_identifier"].Scalar(), "mcap");
  EXPECT_EQ(bag["duration"]["nanoseconds"].as<int>(), 400'000'000);
  EXPECT_EQ(bag["starting_time"]["nanoseconds_since_epoch"].as<int>(), 1'000'000'000);
  EXPECT_EQ(bag["message_count"].as<int>(), 270);
  EXPECT_EQ(bag["relative_file_paths"][0].Scalar(), "run.mcap");
  const YAML::Node listed = bag["topics_with_message_count"][0];
  EXPECT_EQ(listed["topic_metadata"]["name"].Scalar(), "/tf_static");
  EXPECT_EQ(listed["message_count"].as<int>(), 1);
  // YAML in YAML: durability 1 is "transient local", for those who subscribe later.
  const YAML::Node quality =
      YAML::Load(listed["topic_metadata"]["offered_qos_profiles"].Scalar())[0];
  EXPECT_EQ(quality["durability"].as<int>(), 1);
  EXPECT_EQ(YAML::Load(quality_of_service(false))[0]["durability"].as<int>(), 2);
}

class BagFilesTest : public testing::Test {
 protected:
  void list(const std::string& more) const {
    folder_.write("metadata.yaml", "rosbag2_bagfile_information:\n  version: 5\n" + more);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const fs::path& file : bag_files(folder_.path())) names.push_back(file.filename());
    return names;
  }
  std::string problem() const {
    return error_of([&] { bag_files(folder_.path()); });
  }
  test::TestFolder folder_;
};

TEST_F(BagFilesTest, AreThoseOfTheList) {
  for (const char* name : {"b.mcap", "a.mcap", "c.db3"}) folder_.write(name, "");
  EXPECT_THAT(names(), ElementsAre("a.mcap", "b.mcap", "c.db3"));
  list("  relative_file_paths: [b.mcap, run/a.mcap]\n");  // early versions name the folder
  EXPECT_THAT(names(), ElementsAre("b.mcap", "a.mcap"));
  EXPECT_TRUE(is_bag(folder_.path()));
  EXPECT_TRUE(is_bag(folder_ / "a.mcap"));
  EXPECT_FALSE(is_bag(folder_ / "metadata.yaml"));
}

TEST_F(BagFilesTest, BagsThatCannotBeReadAreErrors) {
  EXPECT_FALSE(is_bag(folder_.path()));
  EXPECT_THAT(problem(), HasSubstr("expected .mcap, .db3 or .bag files, found none"));
  folder_.write("a.db3", "");
  list("  compression_mode: FILE\n");
  EXPECT_THAT(problem(), HasSubstr("metadata.yaml: expected a bag that is not compressed"));
  list("  relative_file_paths: [../a.db3]\n");
  EXPECT_THAT(problem(), HasSubstr("expected names of files in the folder, found '../a.db3'"));
  list("  relative_file_paths: [/etc/a.db3]\n");
  EXPECT_THAT(problem(), HasSubstr("found '/etc/a.db3'"));
  folder_.write("metadata.yaml", "[1, 2]\n");
  EXPECT_THAT(problem(), HasSubstr("metadata.yaml: expected a map"));
  folder_.write("metadata.yaml", "a: b\n");
  EXPECT_THAT(problem(), HasSubstr("expected a map rosbag2_bagfile_information"));
}

}  // namespace
}  // namespace vinebench::harness

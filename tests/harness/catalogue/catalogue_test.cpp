// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/catalogue/catalogue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CatalogueTest : public ::testing::Test {
 protected:
  void write(const fs::path& file, const std::string& text) {
    fs::create_directories((folder_.path() / file).parent_path());
    folder_.write(file.string(), text);
  }
  Catalogue catalogue() const {
    return Catalogue({folder_.path() / "own", folder_.path() / "all"});
  }
  std::string message_of(DataKind kind, const std::string& text) const {
    return test::error_of([&] { catalogue().find(kind, text); });
  }

  test::TestFolder folder_;
};

std::vector<std::string> names_of(const std::vector<DataEntry>& entries) {
  std::vector<std::string> names;
  for (const DataEntry& entry : entries) names.push_back(entry.name);
  return names;
}

TEST_F(CatalogueTest, ListsEachKindFromItsFolder) {
  write("all/scenarios/row.yaml", "");
  write("all/scenarios/short/row-short.yaml", "");
  write("all/scenarios/randomisation/weather.yaml", "");
  write("all/scenarios/aisle.yaml", "");
  write("all/scenarios/notes.txt", "");
  write("all/worlds/hill.yaml", "");
  write("all/models/tracked/rover.yaml", "");
  write("all/models/tracked/rig.yaml", "");
  const Catalogue all = catalogue();
  EXPECT_THAT(names_of(all.list(DataKind::kScenario)), ElementsAre("aisle", "row", "row-short"));
  EXPECT_THAT(names_of(all.list(DataKind::kRandomisation)), ElementsAre("weather"));
  EXPECT_THAT(names_of(all.list(DataKind::kWorld)), ElementsAre("hill"));
  EXPECT_THAT(names_of(all.list(DataKind::kRover)), ElementsAre("tracked"));
  EXPECT_THAT(names_of(all.list(DataKind::kRig)), ElementsAre("tracked"));
}

TEST_F(CatalogueTest, AnEarlierFolderHidesALaterOne) {
  write("own/scenarios/row.yaml", "description: own\n");
  write("all/scenarios/row.yaml", "description: of all\n");
  const std::vector<DataEntry> entries = catalogue().list(DataKind::kScenario);
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries.front().description, "own");
}

TEST_F(CatalogueTest, FindsAFileThenAPathInADataFolderThenAName) {
  write("here.yaml", "");
  write("all/scenarios/short/row.yaml", "");
  const fs::path here = folder_.path() / "here.yaml";
  EXPECT_EQ(catalogue().find(DataKind::kScenario, here.string()), here);
  const fs::path row = fs::canonical(folder_.path() / "all/scenarios/short/row.yaml");
  EXPECT_EQ(catalogue().find(DataKind::kScenario, "scenarios/short/row.yaml"), row);
  EXPECT_EQ(catalogue().find(DataKind::kScenario, "row"), row);
}

TEST_F(CatalogueTest, AMissingNameIsToldTheNearest) {
  write("all/scenarios/occluded-camera.yaml", "");
  write("all/worlds/hill.yaml", "");
  EXPECT_EQ(message_of(DataKind::kScenario, "ocluded-camera"),
            "ocluded-camera: neither a file nor the name of a scenario; did you mean "
            "'occluded-camera'?");
  EXPECT_THAT(message_of(DataKind::kScenario, "scenarios/occluded-camara.yaml"),
              HasSubstr("did you mean 'occluded-camera'?"));
  EXPECT_EQ(message_of(DataKind::kWorld, "seaside"),
            "seaside: neither a file nor the name of a world");
}

TEST_F(CatalogueTest, AFolderIsNoFile) {
  write("all/scenarios/row.yaml", "");
  EXPECT_THAT(message_of(DataKind::kScenario, "scenarios"), HasSubstr("neither a file"));
}

TEST_F(CatalogueTest, TheDescriptionIsTheKeyElseTheCommentsFirstSentence) {
  write("key.yaml", "# A comment.\nname: a\ndescription: 'Rows, and a box'\n");
  write("comment.yaml",
        "# SPDX-License-Identifier: Apache-2.0\n\n# Ten rows,\n# all alike. More.\n\n# x\n");
  write("colon.yaml", "# A small rig: two cameras\nname: a\n");
  write("neither.yaml", "name: a\n");
  EXPECT_EQ(describe_file(folder_.path() / "key.yaml"), "Rows, and a box");
  EXPECT_EQ(describe_file(folder_.path() / "comment.yaml"), "Ten rows, all alike");
  EXPECT_EQ(describe_file(folder_.path() / "colon.yaml"), "A small rig");
  EXPECT_EQ(describe_file(folder_.path() / "neither.yaml"), "");
}

TEST_F(CatalogueTest, DataIsFoundBesideAnInstalledAndAnUninstalledProgram) {
  write("prefix/share/vinebench/worlds/hill.yaml", "");
  write("prefix/bin/vinebench", "");
  write("tree/worlds/dale.yaml", "");
  write("build/vinebench", "");
  write("build/data_folder.txt", (folder_.path() / "tree").string() + "\n");
  const Catalogue installed(data_folders(folder_.path() / "prefix/bin/vinebench"));
  EXPECT_EQ(installed.find(DataKind::kWorld, "hill").filename(), "hill.yaml");
  const Catalogue built(data_folders(folder_.path() / "build/vinebench"));
  EXPECT_EQ(built.find(DataKind::kWorld, "dale").filename(), "dale.yaml");
  EXPECT_EQ(data_folders(folder_.path() / "build/vinebench").front(), ".");
  EXPECT_THAT(
      program_data_folders(folder_.path() / "build/vinebench"),
      testing::ElementsAre(folder_.path() / "build/../share/vinebench", folder_.path() / "tree"));
}

}  // namespace
}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/measure_realism.h"

#include <gmock/gmock.h>

#include "harness/datasets/files/image_file.h"
#include "tests/support/court_scenario.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

using MeasureRealismTest = test::CourtScenario;

TEST_F(MeasureRealismTest, ComparesAScenarioWithPhotographs) {
  const Catalogue catalogue({fs::path(VINEBENCH_SOURCE_DIR)});
  RealismRequest asked;
  asked.photographs = (folder_ / "photographs").string();
  fs::create_directories(folder_ / "photographs/anna");
  for (const char* name : {"photographs/one.png", "photographs/anna/two.png"}) {
    write_image(folder_ / name, cv::Mat(480, 752, CV_8UC3, cv::Scalar(90, 120, 60)));
  }
  asked.ours = {file_.string()};
  asked.images = 3;
  asked.width = 376;
  asked.out = folder_ / "out";
  asked.save = folder_ / "numbers.json";
  asked.machine = machine();
  EXPECT_THAT(measure_realism(asked, catalogue), testing::HasSubstr("court against photographs"));
  EXPECT_TRUE(fs::exists(asked.out / "realism.html"));
  EXPECT_TRUE(fs::exists(asked.out / "court/1-002.png"));

  const PictureSet kept = read_picture_set(asked.save);
  ASSERT_EQ(kept.pictures.size(), 2u);
  EXPECT_EQ(kept.pictures[0].group, "anna");
  asked.photographs = asked.save.string();
  asked.ours = {asked.save.string()};
  // Plain pictures have no descriptors and no fine power: 28 of 31.
  EXPECT_THAT(measure_realism(asked, catalogue), testing::HasSubstr("28 of 28 medians inside"));
}

TEST_F(MeasureRealismTest, RefusesWhatIsNoPicture) {
  const Catalogue catalogue({fs::path(VINEBENCH_SOURCE_DIR)});
  RealismRequest asked;
  asked.out = folder_ / "out";
  asked.photographs = "no-such-folder";
  EXPECT_THAT(test::error_of([&] { measure_realism(asked, catalogue); }),
              testing::HasSubstr("no-such-folder: expected a folder of photographs"));
  fs::create_directories(folder_ / "empty");
  asked.photographs = (folder_ / "empty").string();
  EXPECT_THAT(test::error_of([&] { measure_realism(asked, catalogue); }),
              testing::HasSubstr("expected pictures (.jpg, .png), found none"));
  folder_.write("empty/broken.png", "no picture");
  EXPECT_THAT(test::error_of([&] { measure_realism(asked, catalogue); }),
              testing::HasSubstr("broken.png"));
  asked.photographs = folder_.write("numbers.json", "{\"pictures\": 3}").string();
  EXPECT_THAT(test::error_of([&] { measure_realism(asked, catalogue); }),
              testing::HasSubstr("expected the numbers of pictures"));
}

}  // namespace
}  // namespace vinebench::harness

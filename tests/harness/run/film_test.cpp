// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/film.h"

#include <gtest/gtest.h>

#include "harness/datasets/files/json_file.h"
#include "tests/support/fakes.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

TEST(FilmTest, KeepsPicturesAndWhatWasSeenInThem) {
  const test::TestFolder run;
  test::FakeSource source(1, 3);
  test::FakeSlam slam([](Estimate& estimate) {
    TagSighting tag;
    tag.camera = 2;
    tag.id = 7;
    tag.corners.fill({3.5, 2.5});
    estimate.tags = {tag};
  });
  Film film(run.path(), source.rig(), source.size(), [] {
    return std::vector<SupportingFeature>{{1, {0, 5}}};
  });
  run_lockstep(source, slam, {&film});
  for (const char* name : {"film/000000.jpg", "film/000001.jpg", "film/000002.jpg"}) {
    EXPECT_TRUE(std::filesystem::exists(run / name)) << name;
  }
  const auto index = read_json(run / "film/film.json");
  ASSERT_EQ(index["pictures"].size(), 3u);
  const auto& picture = index["pictures"][2];
  EXPECT_EQ(picture["frame"], 2);
  // Images of 8 x 6 px are made 240 px high, 40 times: pixel 0 is at 0.5 * 40 - 0.5, 5 at 219.5.
  EXPECT_EQ(picture["features"], (nlohmann::ordered_json::parse("[[],[19.5,219.5],[]]")));
  EXPECT_EQ(picture["tags"][0]["id"], 7);
  EXPECT_EQ(picture["tags"][0]["corners"][0], 159.5);  // 4 * 40 - 0.5
}

TEST(FilmTest, LongRunsKeepEveryNthFrame) {
  const test::TestFolder run;
  test::FakeSource source(1, 3);
  test::FakeSlam slam;
  Film film(run.path(), source.rig(), 2 * Film::kMostPictures);  // every second
  run_lockstep(source, slam, {&film});
  const auto index = read_json(run / "film/film.json");
  ASSERT_EQ(index["pictures"].size(), 2u);
  EXPECT_EQ(index["pictures"][1]["frame"], 2);
  EXPECT_FALSE(std::filesystem::exists(run / "film/000001.jpg"));
}

}  // namespace
}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/film_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/page_runs.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

TEST(FilmPicturesTest, AllOfTheFilmWhereTheyFit) {
  const test::TestFolder run;
  test::write_fake_run(run.path(), true);
  const auto film = film_pictures(run.path(), 100'000'000);
  ASSERT_TRUE(film);
  EXPECT_EQ(film->pictures.size(), 201u);
  EXPECT_EQ(film->index["pictures"].size(), 201u);
  EXPECT_EQ(film->pictures[0].get<std::string>().substr(0, 4), "/9j/");  // JPEG: ff d8 ff
}

TEST(FilmPicturesTest, FewerWhereTheyDoNot) {
  const test::TestFolder run;
  test::write_fake_run(run.path(), true);
  const auto all = film_pictures(run.path(), 100'000'000);
  const std::size_t half = all->bytes / 2;
  const auto some = film_pictures(run.path(), half);
  ASSERT_TRUE(some);
  EXPECT_LE(some->bytes, half);
  // 201 pictures of about one size: every second one is 101, just too many; every third 67.
  EXPECT_EQ(some->pictures.size(), 67u);
  EXPECT_EQ(some->index["pictures"][1]["frame"], 3);
  EXPECT_FALSE(film_pictures(run.path(), 100));
}

TEST(FilmPicturesTest, WithoutAFilmTheImagesOfTheFrames) {
  const test::TestFolder run;
  test::write_fake_run(run.path());
  const auto film = film_pictures(run.path(), 100'000'000);
  ASSERT_TRUE(film);
  EXPECT_EQ(film->pictures.size(), 12u);
  EXPECT_EQ(film->index["cells"][2]["camera"], "side");
  EXPECT_EQ(film->index["pictures"][11]["frame"], 200);
}

TEST(FilmPicturesTest, NoneWhereThereAreNone) {
  const test::TestFolder run;
  EXPECT_FALSE(film_pictures(run.path(), 1'000'000));
}

TEST(FilmPicturesTest, DamagedFilesAreNamed) {
  const test::TestFolder run;
  std::filesystem::create_directories(run / "film");
  for (const char* index :
       {"{", "[]", "{\"pictures\": [{}]}", "{\"pictures\": [{\"frame\": 3}]}"}) {
    run.write("film/film.json", index);
    EXPECT_THAT(test::error_of([&] { film_pictures(run.path(), 1'000'000); }),
                testing::HasSubstr((run / "film").string()))
        << index;
  }
}

}  // namespace
}  // namespace vinebench::harness

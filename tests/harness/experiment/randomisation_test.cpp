// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/randomisation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;

constexpr int kSeeds = 2000;

class RandomisationTest : public testing::Test {
 protected:
  std::vector<Override> draw(const std::string& text, std::int64_t seed) const {
    return draw_overrides(folder_.write("draws.yaml", text), seed);
  }
  /// The first key's values over many seeds.
  std::vector<double> values(const std::string& text) const {
    std::vector<double> values;
    const auto file = folder_.write("draws.yaml", text);
    for (int seed = 0; seed < kSeeds; ++seed) {
      values.push_back(std::stod(draw_overrides(file, seed).at(0).second));
    }
    return values;
  }
  static double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }

  test::TestFolder folder_;
};

TEST_F(RandomisationTest, ADrawIsAFunctionOfSeedAndKeyAlone) {
  const std::string sun = "  - {key: world.sun.elevation_deg, uniform: [15, 70]}\n";
  const std::string sky = "  - {key: world.sky.overcast, uniform: [0, 1]}\n";
  EXPECT_EQ(draw("draws:\n" + sun + sky, 5), draw("draws:\n" + sun + sky, 5));
  EXPECT_EQ(draw("draws:\n" + sun, 5).at(0), draw("draws:\n" + sky + sun, 5).at(1));
  EXPECT_NE(draw("draws:\n" + sun, 5), draw("draws:\n" + sun, 6));
}

TEST_F(RandomisationTest, DistributionsAreWhatTheySay) {
  // Standard error of a mean of 2000 draws: the deviation / 45; bounds are four of them.
  const auto uniform = values("draws: [{key: a, uniform: [2, 4]}]");
  EXPECT_NEAR(mean(uniform), 3, 4 * 2 / std::sqrt(12.0) / std::sqrt(kSeeds));
  EXPECT_GE(*std::ranges::min_element(uniform), 2);
  EXPECT_LT(*std::ranges::max_element(uniform), 4);
  const auto normal = values("draws: [{key: a, normal: [1, 0.2], min: 0.5, max: 1.5}]");
  EXPECT_NEAR(mean(normal), 1, 4 * 0.2 / std::sqrt(kSeeds));
  EXPECT_GE(*std::ranges::min_element(normal), 0.5);
  EXPECT_LE(*std::ranges::max_element(normal), 1.5);
  // The logarithm is uniform: its mean is that of log 1 and log 100, in decades 1 +- 0.58 / 45.
  auto logs = values("draws: [{key: a, log_uniform: [1, 100]}]");
  for (double& value : logs) value = std::log10(value);
  EXPECT_NEAR(mean(logs), 1, 4 * 0.58 / std::sqrt(kSeeds));
  std::map<double, int> counts;
  for (const double value : values("draws: [{key: a, integer: [3, 5]}]")) ++counts[value];
  EXPECT_EQ(counts.size(), 3u);
  EXPECT_NEAR(counts.at(5), kSeeds / 3.0, 4 * std::sqrt(kSeeds * 2 / 9.0));
  counts.clear();
  for (const double value : values("draws: [{key: a, choice: [75, 89], weights: [1, 3]}]")) {
    ++counts[value];
  }
  EXPECT_NEAR(counts.at(89), kSeeds * 0.75, 4 * std::sqrt(kSeeds * 0.75 * 0.25));
}

// What is left draws from the same span: its least and most are drawn by the seeds themselves.
TEST_F(RandomisationTest, IsNarrowedToWhatSeedsDraw) {
  const auto file = folder_.write("draws.yaml", R"(draws:
  - {key: a, uniform: [0, 100]}
  - {key: b, integer: [0, 1000]}
  - {key: c, choice: [x, y, z], weights: [1, 0, 1]}
  - {key: d, normal: [10, 3], min: 0, max: 20}
)");
  const std::vector<std::int64_t> seeds{3, 4, 5, 6};
  const auto narrow = folder_.write("narrow.yaml", narrowed_randomisation(file, seeds));
  double least = 100;
  double most = 0;
  double sum = 0;
  for (const std::int64_t seed : seeds) {
    const auto drawn = draw_overrides(file, seed);
    least = std::min(least, std::stod(drawn[0].second));
    most = std::max(most, std::stod(drawn[0].second));
    sum += std::stod(drawn[3].second);
  }
  double normals = 0;
  for (int seed = 100; seed < 100 + kSeeds; ++seed) {
    const auto drawn = draw_overrides(narrow, seed);
    ASSERT_EQ(drawn.size(), 4u);
    EXPECT_GE(std::stod(drawn[0].second), least * (1 - 1e-5));
    EXPECT_LE(std::stod(drawn[0].second), most * (1 + 1e-5));
    EXPECT_NE(drawn[2].second, "y");
    normals += std::stod(drawn[3].second) / kSeeds;
  }
  EXPECT_NEAR(normals, sum / 4, 4 * 3 / std::sqrt(kSeeds));  // a deviation of 3 at most
}

TEST_F(RandomisationTest, FaultsNameFileLineAndKey) {
  const auto error = [&](const std::string& text) {
    return error_of([&] { draw("draws:\n" + text, 1); });
  };
  EXPECT_THAT(error("  - {key: a}"), HasSubstr("draws.yaml:2: draws.0.key: expected exactly one"));
  EXPECT_THAT(error("  - {key: a, uniform: [4, 2]}"), HasSubstr("draws.0.uniform"));
  EXPECT_THAT(error("  - {key: a, uniform: [1, 2], max: 3}"),
              HasSubstr("min and max require normal"));
  EXPECT_THAT(error("  - {key: a, choice: [1, 2], weights: [1]}"),
              HasSubstr("one for each choice"));
  EXPECT_THAT(error("  - {key: a, integer: [1, 2]}\n  - {key: a, integer: [1, 2]}"),
              HasSubstr("duplicate key"));
  EXPECT_THAT(error("  - {kee: a, integer: [1, 2]}"), HasSubstr("kee: unknown key"));
  EXPECT_THAT(error_of([&] { draw_overrides(folder_ / "none.yaml", 1); }), HasSubstr("none.yaml"));
}

// A file's path is relative to the randomisation that names it, wherever the program is run.
TEST_F(RandomisationTest, FilesLieBesideTheRandomisation) {
  folder_.write("red.yaml", "name: red");
  folder_.write("white.yaml", "name: white");
  std::map<std::string, int> counts;
  for (int seed = 0; seed < 200; ++seed) {
    ++counts[draw("draws: [{key: a, file: [red.yaml, white.yaml], weights: [3, 1]}]", seed)
                 .at(0)
                 .second];
  }
  ASSERT_EQ(counts.size(), 2u);
  const std::filesystem::path folder = std::filesystem::absolute(folder_.path());
  // 150 of 200, with a deviation of sqrt(200 * 0.75 * 0.25) = 6.1; four of them.
  EXPECT_NEAR(counts[(folder / "red.yaml").string()], 150, 25);
  EXPECT_EQ(counts.count((folder / "white.yaml").string()), 1u);
  EXPECT_THAT(narrowed_randomisation(folder_ / "draws.yaml", {1, 2, 3}), HasSubstr("file: ["));
  EXPECT_THAT(error_of([&] { draw("draws: [{key: a, file: [pink.yaml]}]", 1); }),
              HasSubstr("draws.0.file.0: expected a file"));
}

}  // namespace
}  // namespace vinebench::harness

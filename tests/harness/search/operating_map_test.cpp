// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/operating_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/fake_search.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

class OperatingMapTest : public testing::Test {
 protected:
  // Fails in the corner where both are severe: the sum of severities beyond 1; the second seed a
  // little later.
  test::FakeSearch fake_{[](const ScenarioConfig& scenario, std::int64_t seed) {
    const double sum = (test::speed_of(scenario) - 0.5) / 0.8 + (50 - test::sun_of(scenario)) / 46;
    return sum > (seed == 1 ? 1.1 : 1.3) ? 0.1 : 0.01;
  }};
};

// Of five by five, sums of quarters: 1.25 and more fail with the first seed, 1.5 and more with the
// second.
TEST_F(OperatingMapTest, AsksMoreSeedsWhereTheVerdictChanges) {
  SearchRuns runs = fake_.runs();
  const OperatingMap map = map_envelope(runs, 0, 1, 5, {1, 2}, test::tell_nobody);
  EXPECT_EQ(map.at(0, 0).runs, 1);
  EXPECT_EQ(map.at(0, 0).passed, 1);
  EXPECT_EQ(map.at(4, 4).runs, 1);
  EXPECT_EQ(map.at(4, 4).passed, 0);
  EXPECT_EQ(map.at(2, 3).runs, 2);  // 1.25
  EXPECT_EQ(map.at(2, 3).passed, 1);
  EXPECT_EQ(map.at(2, 2).runs, 2);  // 1, beside it
  EXPECT_EQ(map.at(2, 2).passed, 2);
}

TEST_F(OperatingMapTest, APictureAndATable) {
  SearchRuns runs = fake_.runs();
  const OperatingMap map = map_envelope(runs, 0, 1, 3, {1, 2}, test::tell_nobody);
  const std::string svg = map_svg(map, fake_.problem.space, "drive <1>");
  EXPECT_THAT(svg, HasSubstr("drive &lt;1&gt;"));
  EXPECT_THAT(svg, HasSubstr(">0/2<"));
  EXPECT_THAT(svg, HasSubstr(">as it is<"));
  const std::string csv = map_csv(map, fake_.problem.space);
  // Clopper and Pearson: of one run that passes the rate is 0.025 to 1.
  EXPECT_THAT(csv, HasSubstr("as it is,as it is,0.0000,0.0000,1,1,0.025,1.000"));
  EXPECT_THAT(csv, HasSubstr("1.3,4,1.0000,1.0000,2,0,0.000,0.842"));
}

TEST_F(OperatingMapTest, NeedsTwoDifficulties) {
  SearchRuns runs = fake_.runs();
  EXPECT_THAT(test::error_of([&] { map_envelope(runs, 1, 1, 3, {1}, test::tell_nobody); }),
              HasSubstr("two difficulties"));
}

TEST_F(OperatingMapTest, ItsFirstRunsAreTheLattice) {
  EXPECT_EQ(lattice_queries(fake_.problem, 0, 1, 4, 1).size(), 16u);
}

}  // namespace
}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/collada_check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string problem(const std::string& scene) {
  const std::string text = "<?xml version=\"1.0\"?><COLLADA>" + scene + "</COLLADA>";
  return test::error_of([&] { check_collada(text, "plant.dae"); });
}

TEST(ColladaCheckTest, NodesMayInstanceOthers) {
  EXPECT_EQ(problem(R"(<node id="a"/><node id="b"><instance_node url="#a"/></node>)"), "");
}

TEST(ColladaCheckTest, ANodeThatContainsItselfIsAnError) {
  const std::string self = problem(R"(<node id="a"><instance_node url="#a"/></node>)");
  EXPECT_THAT(self, AllOf(HasSubstr("plant.dae"), HasSubstr("in themselves")));
  EXPECT_THAT(problem(R"(<node id="a"><instance_node url='#b'/></node>)"
                      R"(<node id="b"><node id="c"><instance_node url="#a"/></node></node>)"),
              HasSubstr("in themselves"));
}

// Each of 20 nodes instances the one before twice: 2^20 of the first.
TEST(ColladaCheckTest, AFewNodesMustNotUnfoldToAMillion) {
  std::string nodes = R"(<node id="n0"/>)";
  for (int i = 1; i <= 20; ++i) {
    nodes += fmt::format(
        R"(<node id="n{0}"><instance_node url="#n{1}"/><instance_node url="#n{1}"/></node>)", i,
        i - 1);
  }
  EXPECT_THAT(problem(nodes), HasSubstr("more than 100000 nodes"));
}

TEST(ColladaCheckTest, DeepNestingIsAnError) {
  std::string open, close;
  for (int i = 0; i < 10'000; ++i) {
    open += "<extra>";
    close += "</extra>";
  }
  EXPECT_THAT(problem(open + close), HasSubstr("more than"));
}

TEST(ColladaCheckTest, AListMustFitIntoTheText) {
  EXPECT_EQ(problem(R"(<float_array count="3">0 0 0</float_array>)"), "");
  EXPECT_THAT(problem(R"(<float_array count="4000000000">0 0 0</float_array>)"),
              HasSubstr("a list of 4000000000 items"));
}

}  // namespace
}  // namespace vinebench::sim

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

/// A source of six numbers, read by an accessor with these attributes and two numbers an item.
std::string source(const std::string& accessor, const std::string& list = R"(id="a" count="6")") {
  return "<source id=\"s\"><float_array " + list + ">0 0 0 0 0 0</float_array><accessor " +
         accessor + R"(><param name="S"/><param name="T"/></accessor></source>)";
}

TEST(ColladaCheckTest, IndicesAreWholeNumbers) {
  for (const char* list : {"<p>0 -1\t+2\r\n3 </p>", "<p/>", "<p></p>", "<vcount> 3 3 </vcount>"}) {
    EXPECT_EQ(problem(list), "") << list;
  }
  for (const char* name : {"p", "h", "v", "vcount"}) {
    for (const char* text :
         {"0 x 2", ".5", "1e5", "&lt;", "0 \xff", "<!-- --> x", "<![CDATA[x]]>"}) {
      EXPECT_THAT(problem(fmt::format("<{0}>{1}</{0}>", name, text)),
                  HasSubstr(fmt::format("plant.dae: <{}>: expected whole numbers, found", name)))
          << text;
    }
  }
}

TEST(ColladaCheckTest, AnAccessorMayNotReadBeyondItsList) {
  EXPECT_EQ(problem(source(R"(source="#a" count="3" stride="2")")), "");
  EXPECT_EQ(problem(source(R"(source="#a" count="0" stride="9")")), "");
  // The last of two items begins at 1 + 3 and has two numbers: 6 in all.
  EXPECT_EQ(problem(source(R"(source="#a" count="2" stride="3" offset="1")")), "");
  EXPECT_THAT(problem(source(R"(source="#a" count="2" stride="3" offset="2")")),
              HasSubstr("an accessor of 7 numbers in the list 'a' of 6"));
  EXPECT_THAT(problem(source(R"(source="#a" count="4" stride="2")")),
              HasSubstr("an accessor of 8"));
  EXPECT_THAT(problem(source(R"(source="#a" count="1")", R"(id="a")")), HasSubstr("'a' of 0"));
  EXPECT_EQ(problem(source(R"(source="#b" count="9")")), "");  // an int_array, which assimp ignores
}

TEST(ColladaCheckTest, AttributesAreReadAsAssimpReadsThem) {
  EXPECT_THAT(problem(source(R"(name=">" source="#a" count="4" stride="2")")),
              HasSubstr("an accessor of 8"));
  EXPECT_THAT(problem(source(R"(name=" count='1'" source="#a" count="4" stride="2")")),
              HasSubstr("an accessor of 8"));
  EXPECT_THAT(problem(source(R"(source="#&#97;" count="9")")), HasSubstr("no '&'"));
  EXPECT_THAT(problem(source(R"(source="#a" count="9")", R"(id="&#97;" count="6")")),
              HasSubstr("no '&'"));
  for (const char* count : {"+4", "-1", "0x40", " 4", "4a"}) {
    EXPECT_THAT(problem(source(fmt::format(R"(source="#a" count="{}")", count))),
                HasSubstr("expected a whole number"));
  }
}

// Of a name assimp would read the numbers that it does not have.
TEST(ColladaCheckTest, PositionsAreNumbers) {
  const std::string names =
      R"(<source id="s"><Name_array id="a" count="2">x y</Name_array></source>)";
  EXPECT_EQ(problem(names + R"(<input semantic="JOINT" source="#s"/>)"), "");
  EXPECT_THAT(problem(names + R"(<input semantic="POSITION" source="#s"/>)"),
              HasSubstr("'s': expected numbers, found names"));
}

}  // namespace
}  // namespace vinebench::sim

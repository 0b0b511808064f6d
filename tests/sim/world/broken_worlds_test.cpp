// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/validate.h"
#include "core/config/yaml.h"
#include "sim/config_files.h"
#include "sim/plants/cultivar.h"
#include "sim/world/terrain.h"
#include "sim/world/world.h"
#include "sim/world/world_layout.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class BrokenWorldsTest : public testing::Test {
 protected:
  /// The message for a world of that text; it must name the file and be a single line.
  std::string problem(const std::string& text) const {
    const auto file = folder_.write("world.yaml", text);
    const std::string error = error_of([&] { load_world(file); });
    EXPECT_THAT(error, HasSubstr(file.string())) << text;
    EXPECT_THAT(error, Not(HasSubstr("\n"))) << text;
    return error;
  }

  /// The message for a world of two rows with that override from the command line.
  std::string problem_of_set(const std::string& key, const std::string& value) const {
    const auto file = folder_.write("world.yaml", "block: {rows: 2, length: 10}\n");
    const std::string error = error_of([&] { load_world(file, {{key, value}}); });
    EXPECT_THAT(error, HasSubstr("--set " + key)) << value;
    return error;
  }

  test::TestFolder folder_;
};

TEST_F(BrokenWorldsTest, NoRows) {
  EXPECT_THAT(problem("name: bare\n"), HasSubstr("rows: expected at least one row"));
  EXPECT_THAT(problem("rows: []\n"), HasSubstr("rows: expected at least one row"));
  EXPECT_THAT(problem("block: {rows: 0}\n"),
              HasSubstr("world.yaml:1: block.rows: expected a whole number of at least 1"));
  EXPECT_THAT(problem("block: {rows: -3}\n"), HasSubstr("found '-3'"));
  EXPECT_THAT(problem("block: {rows: 2.5}\n"), HasSubstr("expected a whole number"));
  EXPECT_THAT(problem("block: {rows: 4294967298}\n"), HasSubstr("block.rows"));
}

TEST_F(BrokenWorldsTest, RowsWithoutLength) {
  EXPECT_THAT(problem("rows:\n  - {start: [1, 2], end: [1, 2]}\n"),
              HasSubstr("world.yaml:2: rows.0.end: expected a row of at least 0.1 m"));
  EXPECT_THAT(problem("block: {length: 0}\n"), HasSubstr("block.length: expected a number of"));
}

TEST_F(BrokenWorldsTest, EmptyOrOtherFiles) {
  EXPECT_THAT(problem(""), HasSubstr("expected a map of keys, found nothing"));
  EXPECT_THAT(problem("- 1\n- 2\n"), HasSubstr("expected a map of keys, found a list of 2"));
  EXPECT_THAT(problem("rows: [\n"), HasSubstr("is not valid YAML"));
  EXPECT_THAT(problem(std::string(5000, '[')), HasSubstr("is not valid YAML"));
  EXPECT_THAT(problem("a: &x {b: *y}\n"), HasSubstr("is not valid YAML"));
  EXPECT_THAT(problem("a: &x [*x]\nblock: {rows: 1}\n"),
              HasSubstr("alias inside of what it names"));
  problem(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
  problem(std::string(64, '\0'));
  const std::string folder = (folder_ / "").string();
  EXPECT_THAT(error_of([&] { YamlDocument::load(folder); }),
              AllOf(HasSubstr(folder), HasSubstr("is a folder, not a file")));
}

TEST_F(BrokenWorldsTest, NumbersThatAreNone) {
  for (const char* number : {".nan", ".NaN", "nan", ".inf", "-.inf", "inf", "1e999", "-1e999", "0x",
                             "1.0.0", "~", "[]", "{}", "'2'", "2 m"}) {
    const std::string block = fmt::format("block: {{rows: 2, spacing: {}}}\n", number);
    EXPECT_THAT(problem(block), HasSubstr("world.yaml:1: block.spacing: expected a number"));
    EXPECT_THAT(problem_of_set("block.spacing", number), HasSubstr("block.spacing"));
    EXPECT_THAT(problem_of_set("sun.azimuth_deg", number), HasSubstr("sun.azimuth_deg"));
  }
  for (const char* number : {".nan", "1e999", "1e3", "99999999999", "-99999999999"}) {
    EXPECT_THAT(problem_of_set("block.rows", number), HasSubstr("expected a whole number"));
    EXPECT_THAT(problem_of_set("vines.bbch", number), HasSubstr("expected a whole number"));
  }
  EXPECT_THAT(problem_of_set("block.origin", "[0, .nan]"), HasSubstr("block.origin.1: expected"));
  EXPECT_THAT(problem_of_set("trellis.wires", "[0.6, .nan]"), HasSubstr("trellis.wires.1"));
}

TEST_F(BrokenWorldsTest, AnInfiniteNumberInCodeIsAnErrorToo) {
  Occluder obstacle;
  obstacle.shape = Occluder::Shape::kPerson;
  obstacle.height = std::numeric_limits<double>::infinity();
  EXPECT_THAT(error_of([&] { validate(obstacle); }), HasSubstr("height: expected a number"));
  obstacle.height = std::nan("");
  EXPECT_THAT(error_of([&] { validate(obstacle); }), HasSubstr("found nan"));
}

/// Each is an error that names the excessive quantity, before memory is allocated.
TEST_F(BrokenWorldsTest, EnormousOnes) {
  EXPECT_THAT(problem("block: {rows: 500, length: 2000}\n"),
              AllOf(HasSubstr("1000000 m of rows"), HasSubstr("expected at most 20000 m")));
  EXPECT_THAT(problem("block: {rows: 50, length: 200}\nvines: {spacing: 0.2}\n"),
              AllOf(HasSubstr("about 50000 places for vines"), HasSubstr("at most 20000")));
  // Two rows a kilometre apart and 500 m long.
  EXPECT_THAT(
      problem("rows: [{start: [0, 0], end: [500, 0]}, {start: [0, 1000], end: [500, 1000]}]"),
      AllOf(HasSubstr("m^2 of ground"), HasSubstr("expected at most 200000")));
  // 20 rows of 200 m, 9 m apart, with 6 m round them: 212 m by 190 m of cells of 0.1 m, more than
  // 4 million.
  EXPECT_THAT(problem("block: {rows: 20, length: 200, spacing: 9}\nterrain: {amplitude: 0.1}\n"),
              AllOf(HasSubstr("million cells of 0.1 m"), HasSubstr("make terrain.cell larger")));
  EXPECT_THAT(problem("block: {rows: 2}\ntrellis: {wires: [" +
                      [] {
                        std::string wires = "0.5";
                        for (int i = 0; i < 20; ++i) wires += ", 0.5";
                        return wires;
                      }() +
                      "]}\n"),
              HasSubstr("trellis.wires: expected at most 20"));
}

TEST_F(BrokenWorldsTest, TheLargestThatIsAllowedIsLaidOut) {
  const auto file = folder_.write("world.yaml", "block: {rows: 66, length: 300, spacing: 2}\n");
  const WorldConfig world = load_world(file);
  EXPECT_EQ(lay_out(world).vine_feet().size(), 66u * 300u);
  EXPECT_LE(lay_out(world).terrain.nodes(), WorldConfig::kMostCells);
}

TEST_F(BrokenWorldsTest, FilesThatAreNamedButMissingOrFolders) {
  EXPECT_THAT(problem("block: {rows: 1}\nvines: {cultivar: gone.yaml}\n"),
              AllOf(HasSubstr("world.yaml:2: vines.cultivar"), HasSubstr("gone.yaml")));
  EXPECT_THAT(problem("block: {rows: 1}\nvines: {meshes: [.]}\n"),
              AllOf(HasSubstr("vines.meshes.0"), HasSubstr("expected a file")));
}

TEST_F(BrokenWorldsTest, DaysThatAreNone) {
  const std::string sun = "block: {rows: 1}\nsun: {at: ";
  EXPECT_THAT(problem(sun + "{date: 2026-02-30}}\n"),
              HasSubstr("sun.at.date: expected YYYY-MM-DD"));
  EXPECT_THAT(problem(sun + "{time: \"25:00\"}}\n"), HasSubstr("sun.at.time: expected HH:MM"));
  EXPECT_THAT(problem(sun + "{latitude_deg: .nan}}\n"), HasSubstr("sun.at.latitude_deg"));
}

TEST_F(BrokenWorldsTest, BrokenCultivars) {
  const auto error = [&](const std::string& text) {
    const auto file = folder_.write("grape.yaml", text);
    const std::string message = error_of([&] { load_cultivar(file); });
    EXPECT_THAT(message, HasSubstr(file.string())) << text;
    return message;
  };
  EXPECT_THAT(error(""), HasSubstr("expected a map"));
  EXPECT_THAT(error("leaf: {area: .nan}\n"), HasSubstr("grape.yaml:1: leaf.area: expected"));
  EXPECT_THAT(error("leaf: {area: -1}\n"), HasSubstr("leaf.area"));
  EXPECT_THAT(error("leaf: 3\n"), HasSubstr("leaf: expected a map of keys, found '3'"));
  EXPECT_THAT(error("leaf: {dark: [0.1, 0.2]}\n"), HasSubstr("leaf.dark: expected a list of 3"));
  EXPECT_THAT(error("leaves: {}\n"), HasSubstr("leaves: unknown key"));
  EXPECT_THAT(error("bunch: {length: 0.05, width: 0.06}\n"), HasSubstr("longer than wide"));
  EXPECT_THAT(error("berry: {diameter: 0.034}\n"), HasSubstr("two or more side by side"));
  EXPECT_THAT(error("name: [a\n"), HasSubstr("is not valid YAML"));
}

}  // namespace
}  // namespace vinebench::sim

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/mjcf_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/special_files.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

class MjcfCheckTest : public testing::Test {
 protected:
  std::string problem(const std::string& text) const {
    const auto model = folder_.write("rover.xml", text);
    return error_of([&] { check_mjcf_files(model); });
  }
  test::TestFolder folder_;
};

TEST_F(MjcfCheckTest, RegularAndMissingFilesPass) {
  folder_.write("part.xml", "<mujocoinclude><include file='rover.xml'/></mujocoinclude>");
  EXPECT_EQ(problem("<mujoco><include file = \"part.xml\"/><mesh file='gone.stl'/>"
                    "<mesh file=\"\"/><mesh file=></mujoco>"),
            "");
}

TEST_F(MjcfCheckTest, PipesAndDevicesAreNamed) {
  std::filesystem::create_directory(folder_ / "meshes");
  test::make_pipe(folder_, "meshes/wheel.stl");
  test::link_to_device(folder_, "zero.xml");
  EXPECT_THAT(problem("<mujoco><compiler meshdir='meshes'/><mesh file='wheel.stl'/></mujoco>"),
              AllOf(HasSubstr("meshes/wheel.stl"), HasSubstr("a pipe or a device")));
  EXPECT_THAT(problem("<mujoco><include file='zero.xml'/></mujoco>"), HasSubstr("zero.xml"));
  folder_.write("part.xml", "<mujocoinclude><include file='zero.xml'/></mujocoinclude>");
  EXPECT_THAT(problem("<mujoco><include file='part.xml'/></mujoco>"), HasSubstr("zero.xml"));
  const auto pipe = test::make_pipe(folder_, "pipe.xml");
  EXPECT_THAT(error_of([&] { check_mjcf_files(pipe); }), HasSubstr("pipe.xml"));
}

}  // namespace
}  // namespace vinebench::sim

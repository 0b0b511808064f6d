// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/obj_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

std::string obj_problem(std::string_view text) {
  return error_of([&] { check_obj(text, "a.obj"); });
}

std::string mtl_problem(std::string_view text) {
  return error_of([&] { check_mtl(text, "a.mtl"); });
}

TEST(ObjCheckTest, WholeFilesPass) {
  EXPECT_EQ(obj_problem("# rows\nmtllib a.mtl\nv 0 0 0\nf 1 1 1\n"), "");
  EXPECT_EQ(obj_problem(""), "");
  EXPECT_EQ(mtl_problem("\n# a comment\r\n \tnewmtl bark\nKd 1 1 1\nmap_Kd bark.png\n"), "");
  EXPECT_EQ(mtl_problem("\xef\xbb\xbf# caf\xc3\xa9\nnewmtl a\n").find("UTF-16"), std::string::npos);
}

TEST(ObjCheckTest, WideCharactersAndBytesAreNoText) {
  const std::string wide("\xff\xfev\0 \0", 6);
  EXPECT_THAT(obj_problem(wide), AllOf(HasSubstr("a.obj"), HasSubstr("UTF-8")));
  EXPECT_THAT(mtl_problem("\xfe\xff"), AllOf(HasSubstr("a.mtl"), HasSubstr("UTF-8")));
  EXPECT_THAT(mtl_problem(std::string("newmtl a\n\0", 10)), HasSubstr("UTF-8"));
}

TEST(ObjCheckTest, APropertyNeedsAMaterial) {
  for (const char* property : {"map_Kd", "map_d", "map_Bump", "bump", "refl", "disp", "norm"}) {
    EXPECT_THAT(mtl_problem(std::string("# first\n  ") + property + " skin.png\nnewmtl a\n"),
                AllOf(HasSubstr("a.mtl:2: expected 'newmtl'"), HasSubstr(property)));
  }
  // To assimp a form feed ends a line, also that of a comment.
  EXPECT_THAT(mtl_problem("# first\fmap_Kd skin.png\nnewmtl a\n"), HasSubstr("newmtl"));
  EXPECT_THAT(mtl_problem("newmtls a\n"), HasSubstr("newmtl"));
}

TEST(ObjCheckTest, AMaterialLibraryIsNoUrl) {
  for (const char* name : {"mesh.mtl://", "://", "http://host/mesh.mtl"}) {
    EXPECT_THAT(obj_problem(std::string("o leaf\nmtllib ") + name),
                HasSubstr("a.obj:2: mtllib: expected a file beside the mesh, found a URL"));
  }
  EXPECT_EQ(obj_problem("mtllib folder/mesh.mtl"), "");
}

// Faces of five corners each, of which two million fit.
TEST(ObjCheckTest, CornersAreCounted) {
  std::string text;
  for (int i = 0; i < 2'000'000; ++i) text += "f 1 1 1 1 1\n";
  EXPECT_EQ(obj_problem(text), "");
  text += "f 1 1 1\n";
  EXPECT_THAT(obj_problem(text), HasSubstr("found 0 and 10000003"));
}

}  // namespace
}  // namespace vinebench::sim

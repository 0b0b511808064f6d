// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/mesh_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ColladaUpAxisTest, IsTheOneStatedElseY) {
  EXPECT_EQ(collada_up_axis("<asset><up_axis>Z_UP</up_axis></asset>"), UpAxis::kZ);
  EXPECT_EQ(collada_up_axis("<up_axis>\n X_UP </up_axis>"), UpAxis::kX);
  EXPECT_EQ(collada_up_axis("<up_axis>Y_UP</up_axis>"), UpAxis::kY);
  for (const char* text : {"", "<asset/>", "<up_axis>", "<up_axis> "}) {
    EXPECT_EQ(collada_up_axis(text), UpAxis::kY) << text;
  }
}

TEST(MaterialLibrariesTest, ThoseThatTheFolderLacksAreMissing) {
  const test::TestFolder folder;
  folder.write("a b.mtl", "newmtl x\n");
  const std::string text = "# mtllib comment.mtl\nmtllib a b.mtl\r\nmtllib  gone.mtl \nv 0 0 0\n";
  EXPECT_THAT(missing_material_libraries(text, folder.path()), ElementsAre("gone.mtl"));
  EXPECT_THAT(missing_material_libraries("mtllib last.mtl", folder.path()),
              ElementsAre("last.mtl"));
  for (const char* none : {"", "mtllib", "mtllib \n", "mtllibrary\n"}) {
    EXPECT_THAT(missing_material_libraries(none, folder.path()), IsEmpty()) << none;
  }
}

}  // namespace
}  // namespace vinebench::sim

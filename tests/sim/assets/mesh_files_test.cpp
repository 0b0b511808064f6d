// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/mesh_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <assimp/IOStream.hpp>

#include "core/util/error.h"
#include "tests/support/special_files.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using testing::HasSubstr;

class MeshFilesTest : public testing::Test {
 protected:
  /// The content of a file as assimp would read it; "none" if it cannot be opened.
  std::string text_of(const std::string& name) {
    Assimp::IOStream* stream = files_.Open(name.c_str(), "rb");
    if (stream == nullptr) return "none";
    std::string text(stream->FileSize(), ' ');
    EXPECT_EQ(stream->Read(text.data(), 1, text.size()), text.size());
    files_.Close(stream);
    return text;
  }
  std::string problem(const std::string& name) {
    return error_of([&] { text_of(name); });
  }

  test::TestFolder folder_;
  const std::string content_ = "v 0 0 0\n";
  MeshFiles files_{"vine.obj", content_};
};

TEST_F(MeshFilesTest, TheMeshIsWhatWasReadBefore) {
  EXPECT_TRUE(files_.Exists("vine.obj"));
  EXPECT_EQ(text_of("vine.obj"), content_);
  EXPECT_EQ(text_of("vine.obj"), content_);
}

TEST_F(MeshFilesTest, LibrariesAreReadAndChecked) {
  const auto library = folder_.write("vine.mtl", "newmtl a\n");
  EXPECT_TRUE(files_.Exists(library.c_str()));
  EXPECT_EQ(text_of(library), "newmtl a\n");
  EXPECT_EQ(text_of(folder_ / "none.mtl"), "none");
  EXPECT_EQ(text_of(folder_.path()), "none");
  EXPECT_THAT(problem(folder_.write("bad.mtl", "map_Kd a.png\n")), HasSubstr("bad.mtl:1"));
  EXPECT_THAT(problem(test::make_pipe(folder_, "pipe.mtl")), HasSubstr("a pipe or a device"));
  EXPECT_THAT(problem(test::link_to_device(folder_, "zero.mtl")), HasSubstr("a pipe or a device"));
  EXPECT_THAT(problem(test::make_loop(folder_, "loop.mtl")), HasSubstr("symbolic links"));
}

}  // namespace
}  // namespace vinebench::sim

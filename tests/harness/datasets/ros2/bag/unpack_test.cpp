// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/unpack.h"

#include <gmock/gmock.h>

#include "harness/datasets/ros2/mcap/zstd.h"
#include "tests/support/compressed.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;

struct Packed {
  const char* compression;
  std::string data;
};

class UnpackTest : public testing::Test {
 protected:
  // Longer than a block of LZ4's smallest frames (64 KiB).
  std::string data_ = std::string(70'000, 'x') + "end";
  std::vector<Packed> packed_{{"", data_},
                              {"none", data_},
                              {"zstd", zstd_compress(data_)},
                              {"lz4", test::lz4_frame(data_)},
                              {"bz2", test::bz2_stream(data_)}};
};

TEST_F(UnpackTest, EachCompressionIsUndone) {
  for (const auto& [compression, data] : packed_) {
    EXPECT_EQ(unpack(compression, data, data_.size()), data_) << compression;
  }
  EXPECT_EQ(unpack("lz4", test::lz4_frame("a") + test::lz4_frame("b"), 2), "ab");
}

TEST_F(UnpackTest, AnotherSizeIsAnError) {
  for (const auto& [compression, data] : packed_) {
    for (const std::size_t size : {data_.size() - 1, data_.size() + 1}) {
      EXPECT_NE(error_of([&] { unpack(compression, data, size); }), "") << compression;
    }
  }
}

TEST_F(UnpackTest, DamagedDataAreAnError) {
  for (const auto& [compression, data] : packed_) {
    if (data == data_) continue;
    EXPECT_THAT(
        error_of([&] { unpack(compression, data.substr(0, data.size() / 2), data_.size()); }),
        testing::Not(testing::IsEmpty()))
        << compression;
    EXPECT_THAT(error_of([&] { unpack(compression, "no such data", 12); }), HasSubstr(compression));
  }
  EXPECT_THAT(error_of([&] { unpack("xz", data_, data_.size()); }),
              HasSubstr("expected no compression, zstd, lz4 or bz2, found 'xz'"));
}

}  // namespace
}  // namespace vinebench::harness

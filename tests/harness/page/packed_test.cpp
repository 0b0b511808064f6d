// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/packed.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <algorithm>

namespace vinebench::harness {
namespace {

std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    count += 6;
    if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
  }
  return bytes;
}

TEST(PackedTest, IsGzipOfTheText) {
  const nlohmann::ordered_json value{{"numbers", std::vector<int>(1000, 7)}};
  const std::string text = packed(value), bytes = from_base64(text);
  ASSERT_EQ(bytes.substr(0, 2), "\x1f\x8b");  // RFC 1952
  std::string plain(10'000, '\0');
  std::size_t size = 0;
  libdeflate_decompressor* decompressor = libdeflate_alloc_decompressor();
  ASSERT_EQ(libdeflate_gzip_decompress(decompressor, bytes.data(), bytes.size(), plain.data(),
                                       plain.size(), &size),
            LIBDEFLATE_SUCCESS);
  libdeflate_free_decompressor(decompressor);
  EXPECT_EQ(nlohmann::ordered_json::parse(plain.substr(0, size)), value);
  EXPECT_LT(text.size(), 200u);  // a thousand equal numbers
}

TEST(PackedTest, ScriptTextEndsNoElement) {
  const nlohmann::ordered_json value{{"name", "</script><!-- <b>"}};
  const std::string text = script_text(value);
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::ordered_json::parse(text), value);
}

}  // namespace
}  // namespace vinebench::harness

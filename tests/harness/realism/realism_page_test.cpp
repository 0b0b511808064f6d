// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/realism_page.h"

#include <gmock/gmock.h>

#include "tests/support/eleven_pictures.h"

namespace vinebench::harness {
namespace {

using test::eleven;

TEST(RealismPageTest, HasWhatTheJsonHas) {
  const PictureSet real = eleven("real <1>", 1);
  const Realism found = compare_pictures(real, eleven("ours", 2));
  EXPECT_EQ(to_json(found)["inside"], 0);  // 12 is above 10
  const std::string page = realism_page(real, {{found, eleven("ours", 2)}});
  EXPECT_THAT(page, testing::HasSubstr("ours against real &lt;1&gt;"));
  EXPECT_THAT(page, testing::HasSubstr("0 of 1 medians inside"));
  EXPECT_THAT(page, testing::HasSubstr("<tr class=\"outside\"><td>corners</td><td>2.000</td>"));
}

}  // namespace
}  // namespace vinebench::harness

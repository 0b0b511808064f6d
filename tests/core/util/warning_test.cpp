// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/warning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/warnings.h"

namespace vinebench {
namespace {

using testing::ElementsAre;

TEST(WarningTest, EachTextIsGivenOnceToEachSink) {
  warn("heard by nobody");
  for (int sink = 0; sink < 2; ++sink) {
    const test::Warnings warnings;
    warn("a.obj: no normals");
    warn("b.obj: no normals");
    warn("a.obj: no normals");
    EXPECT_THAT(warnings.all, ElementsAre("a.obj: no normals", "b.obj: no normals"));
  }
}

TEST(WarningTest, TheSinkBeforeComesBack) {
  const test::Warnings outer;
  {
    const test::Warnings inner;
    warn("inner");
    EXPECT_THAT(inner.all, ElementsAre("inner"));
  }
  warn("outer");
  EXPECT_THAT(outer.all, ElementsAre("outer"));
}

}  // namespace
}  // namespace vinebench

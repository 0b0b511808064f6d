// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/runtime/background.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <stdexcept>

namespace vinebench::slam {
namespace {

int niceness() {
  return getpriority(PRIO_PROCESS, 0);  // of the calling thread, on Linux
}

TEST(BackgroundTest, WorkComesAfterWhoeverBeganIt) {
  const int mine = niceness();
  Background<int> work;
  EXPECT_FALSE(work.busy());
  work.start([] { return niceness(); });
  EXPECT_TRUE(work.busy());
  EXPECT_EQ(work.take(), std::min(mine + 10, 19));  // 19 is the nicest there is
  EXPECT_EQ(niceness(), mine);
  EXPECT_FALSE(work.busy());
}

TEST(BackgroundTest, WhatTheWorkThrewIsThrownWhereItIsTaken) {
  Background<int> work;
  work.start([]() -> int { throw std::runtime_error("no room"); });
  EXPECT_THROW(work.take(), std::runtime_error);
  EXPECT_FALSE(work.busy());
}

}  // namespace
}  // namespace vinebench::slam

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "tests/support/gl_fixture.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

TEST(GlContextEglTest, WithoutItABuildSaysSo) {
  if (has_egl()) GTEST_SKIP() << "this build has it";
  EXPECT_THAT(test::error_of([] { make_egl_context(); }),
              testing::HasSubstr("this build has no EGL"));
}

TEST(GlContextEglTest, IsAContextOfItsOwnForAnyThread) {
  if (!has_egl()) GTEST_SKIP() << "this build has no EGL";
  const std::unique_ptr<GlContext> context = make_egl_context();
  test::expect_working_context(*context);
  std::thread([&] { test::expect_working_context(*context); }).join();
  test::expect_all_functions(*context);
  test::expect_core_profile(GlBackend::kEgl);
}

TEST(GlContextEglTest, TwoKeepTheirOwnObjects) {
  if (!has_egl()) GTEST_SKIP() << "this build has no EGL";
  test::expect_own_objects(*make_egl_context(), *make_egl_context());
}

}  // namespace
}  // namespace vinebench::sim

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "tests/support/gl_fixture.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

TEST(GlContextOsmesaTest, WithoutItABuildSaysSo) {
  if (has_osmesa()) GTEST_SKIP() << "this build has it";
  EXPECT_THAT(test::error_of([] { make_osmesa_context(); }),
              testing::HasSubstr("this build has no OSMesa"));
}

TEST(GlContextOsmesaTest, IsAContextOfItsOwnForAnyThread) {
  if (!has_osmesa()) GTEST_SKIP() << "this build has no OSMesa";
  const std::unique_ptr<GlContext> context = make_osmesa_context();
  test::expect_working_context(*context);
  std::thread([&] { test::expect_working_context(*context); }).join();
  test::expect_all_functions(*context);
  test::expect_core_profile(GlBackend::kOsmesa);
}

TEST(GlContextOsmesaTest, TwoKeepTheirOwnObjects) {
  if (!has_osmesa()) GTEST_SKIP() << "this build has no OSMesa";
  test::expect_own_objects(*make_osmesa_context(), *make_osmesa_context());
}

}  // namespace
}  // namespace vinebench::sim

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
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

class WorkingOsmesaTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_osmesa()) GTEST_SKIP() << "this build has no OSMesa";
    context_ = make_osmesa_context();
  }
  std::unique_ptr<GlContext> context_;
};

TEST_F(WorkingOsmesaTest, DrawsFromThreadToThread) {
  test::expect_working_context(*context_);
  std::thread([&] { test::expect_working_context(*context_); }).join();
}

TEST_F(WorkingOsmesaTest, TwoKeepTheirOwnState) {
  const std::unique_ptr<GlContext> other = make_osmesa_context();
  GLuint first = 0, second = 0;
  {
    const CurrentContext current(*context_);
    current.gl().GenBuffers(1, &first);
  }
  {
    const CurrentContext current(*other);
    current.gl().GenBuffers(1, &second);
  }
  // Names are given from one on in each: they would differ if the contexts shared them.
  EXPECT_EQ(first, second);
}

TEST_F(WorkingOsmesaTest, HasEveryFunctionInUse) {
  const CurrentContext current(*context_);
  EXPECT_NE(context_->function("glDrawElementsInstancedBaseVertexBaseInstance"), nullptr);
  EXPECT_NO_THROW(context_->functions());
}

TEST_F(WorkingOsmesaTest, SaysItsVersion) {
  const std::string version = gl_version(GlBackend::kOsmesa);
  EXPECT_GE(std::stod(version), 4.2) << version;
  EXPECT_THAT(version, testing::HasSubstr("Core"));
}

}  // namespace
}  // namespace vinebench::sim

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/outcome.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <new>
#include <stdexcept>

#include "core/util/error.h"

namespace vinebench::tools {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::vector<std::string> kArguments{"replay", "data/row"};

/// The message on standard error of a command that throws this.
template <class Exception>
std::string message_of(const Exception& exception, int expected_code) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(outcome_of(kArguments, [&]() -> int { throw exception; }), expected_code);
  return testing::internal::GetCapturedStderr();
}

TEST(OutcomeTest, TheCommandsCodeIsTheProgramsCode) {
  EXPECT_EQ(outcome_of(kArguments, [] { return 0; }), 0);
  EXPECT_EQ(outcome_of(kArguments, [] { return 130; }), 130);
}

TEST(OutcomeTest, BadInputIsOneMessage) {
  EXPECT_EQ(message_of(Error("a.yaml:3: seed"), 2), "vinebench: a.yaml:3: seed\n");
}

TEST(OutcomeTest, AFailingEnvironmentNamesWhatWasWorkedOn) {
  EXPECT_EQ(message_of(std::bad_alloc(), 2), "vinebench: replay data/row: not enough memory\n");
  const auto code = std::make_error_code(std::errc::too_many_symbolic_link_levels);
  EXPECT_THAT(message_of(std::filesystem::filesystem_error("status", "loop", code), 2),
              AllOf(HasSubstr("replay data/row: loop: "), HasSubstr("symbolic links")));
}

TEST(OutcomeTest, ABugIsAnInternalError) {
  EXPECT_EQ(message_of(std::logic_error("at"), 3), "vinebench: internal error: at\n");
}

}  // namespace
}  // namespace vinebench::tools

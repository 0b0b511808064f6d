// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/library_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <new>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <system_error>

#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

template <class Exception>
std::string message_of(const Exception& exception) {
  return test::error_of([&] { with_errors_of("maps/a", [&] { throw exception; }); });
}

TEST(LibraryErrorsTest, ResultsPass) {
  EXPECT_EQ(with_errors_of("maps/a", [] { return 7; }), 7);
}

TEST(LibraryErrorsTest, OfMemory) {
  const std::string expected = "maps/a: not enough memory";
  EXPECT_EQ(message_of(std::bad_alloc()), expected);
  EXPECT_EQ(message_of(std::length_error("vector::reserve")), expected);
  EXPECT_EQ(message_of(cv::Exception(cv::Error::StsNoMem, "64 GB", "alloc", "a.cpp", 1)), expected);
}

TEST(LibraryErrorsTest, OfFilesAndOthersWithTheirReason) {
  const auto loop = std::make_error_code(std::errc::too_many_symbolic_link_levels);
  EXPECT_THAT(message_of(std::filesystem::filesystem_error("status", "b/loop", loop)),
              AllOf(StartsWith("maps/a: b/loop: "), HasSubstr("symbolic links")));
  EXPECT_THAT(message_of(std::system_error(EAGAIN, std::generic_category(), "no thread")),
              StartsWith("maps/a: no thread"));
  EXPECT_THAT(message_of(cv::Exception(cv::Error::StsBadArg, "a size", "resize", "a.cpp", 1)),
              AllOf(StartsWith("maps/a: "), HasSubstr("a size"), HasSubstr("resize")));
  EXPECT_THAT(message_of(YAML::BadSubscript(YAML::Mark(), "key")), StartsWith("maps/a: "));
}

TEST(LibraryErrorsTest, AnErrorIsUnchangedAndABugStaysABug) {
  EXPECT_EQ(message_of(Error("b.yaml:3: seed")), "b.yaml:3: seed");
  EXPECT_THROW(with_errors_of("maps/a", [] { throw std::out_of_range("at"); }), std::out_of_range);
}

}  // namespace
}  // namespace vinebench

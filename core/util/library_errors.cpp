// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/library_errors.h"

#include <yaml-cpp/exceptions.h>

#include <filesystem>
#include <new>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <system_error>

#include "core/util/error.h"

namespace vinebench {
namespace {

constexpr const char* kNoMemory = "not enough memory";

std::string reason_of(const cv::Exception& error) {
  if (error.code == cv::Error::StsNoMem) return kNoMemory;
  return fmt::format("OpenCV: {} ({})", error.err, error.func);
}

}  // namespace

void rethrow_as_error(const std::string& where) {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    fail("{}: {}", where, kNoMemory);
  } catch (const std::length_error&) {  // of a container that would exceed the address space
    fail("{}: {}", where, kNoMemory);
  } catch (const std::filesystem::filesystem_error& error) {
    fail("{}: {}: {}", where, error.path1().string(), error.code().message());
  } catch (const std::system_error& error) {  // such as no more threads
    fail("{}: {}", where, error.what());
  } catch (const cv::Exception& error) {
    fail("{}: {}", where, reason_of(error));
  } catch (const YAML::Exception& error) {
    fail("{}: {}", where, error.what());
  }
}

}  // namespace vinebench

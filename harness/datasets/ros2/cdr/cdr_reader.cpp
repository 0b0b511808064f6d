// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/cdr/cdr_reader.h"

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kEncapsulation = 4;  // bytes: two of the kind, two of options

}  // namespace

CdrReader::CdrReader(const EncodedMessage& message)
    : message_(message.bytes), coding_(message.coding) {
  if (coding_ == MessageCoding::kRos1) return;
  const std::string_view kind = take(kEncapsulation);
  if (kind[0] != 0 || kind[1] < 0 || kind[1] > 1) {
    fail("byte 0: expected plain CDR (encapsulation 0 or 1), found {}",
         256 * static_cast<unsigned char>(kind[0]) + static_cast<unsigned char>(kind[1]));
  }
  swapped_ = kind[1] == 0;
}

std::string_view CdrReader::take(std::size_t size) {
  if (size > message_.size() - at_) {
    fail("byte {}: expected {} more bytes, found {}", at_, size, message_.size() - at_);
  }
  at_ += size;
  return message_.substr(at_ - size, size);
}

std::string_view CdrReader::take_aligned(std::size_t size) {
  if (coding_ == MessageCoding::kCdr) take((size - (at_ - kEncapsulation) % size) % size);
  return take(size);
}

std::uint32_t CdrReader::get_length(std::size_t bytes_each) {
  const auto length = get<std::uint32_t>();
  if (length > (message_.size() - at_) / bytes_each) {
    fail("byte {}: expected {} elements, found {} bytes", at_, length, message_.size() - at_);
  }
  return length;
}

std::string CdrReader::get_text() {
  std::string text(take(get_length(1)));
  if (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

std::string_view CdrReader::get_bytes() {
  return take(get_length(1));
}

std::vector<double> CdrReader::get_numbers() {
  std::vector<double> numbers(get_length(sizeof(double)));
  for (double& number : numbers) number = get<double>();
  return numbers;
}

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/geometry/pose.h"
#include "core/util/error.h"

namespace vinebench::slam {

// Two archives with one face: `archive(a, b, c)` writes values, or reads them in the same order.
// A struct takes part by a function `fields(archive, value)` in this namespace that names its
// fields. Numbers are little endian whatever the machine; `int` takes four bytes.

namespace archive_detail {

template <class T>
concept Number = std::is_arithmetic_v<T>;

template <std::size_t kBytes>
using Bits = std::conditional_t<
    kBytes == 8, std::uint64_t,
    std::conditional_t<kBytes == 4, std::uint32_t,
                       std::conditional_t<kBytes == 2, std::uint16_t, std::uint8_t>>>;

}  // namespace archive_detail

/// Appends to a string.
class BinaryWriter {
 public:
  /// Of a format of that version.
  explicit BinaryWriter(std::uint32_t version = 0) : version_(version) {}
  std::uint32_t version() const { return version_; }

  template <class... T>
  void operator()(const T&... values) {
    (write(values), ...);
  }
  std::string take() { return std::move(bytes_); }
  const std::string& bytes() const { return bytes_; }

 private:
  template <archive_detail::Number T>
  void write(const T& value) {
    auto bits = std::bit_cast<archive_detail::Bits<sizeof(T)>>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_ += static_cast<char>(static_cast<std::uint64_t>(bits) >> (8 * i) & 0xffU);
    }
  }
  void write(const std::string& text) {
    write(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
  }
  template <class T>
  void write(const std::vector<T>& items) {
    write(static_cast<std::uint32_t>(items.size()));
    for (const T& item : items) write(item);
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& items) {
    for (const T& item : items) write(item);
  }
  template <class T>
  void write(const std::optional<T>& value) {
    write(value.has_value());
    if (value) write(*value);
  }
  template <class S, int R>
  void write(const Eigen::Matrix<S, R, 1>& vector) {
    for (int i = 0; i < R; ++i) write(vector[i]);
  }
  void write(const Pose& pose) {
    write(Eigen::Vector4d(pose.rotation.coeffs()));
    write(pose.translation);
  }
  template <class T>
  requires std::is_class_v<T>
  void write(const T& value) {
    fields(*this, const_cast<T&>(value));  // one list of fields serves both directions
  }

  std::uint32_t version_;
  std::string bytes_;
};

/// Reads from bytes that may be anything: never past their end, and never more memory than a small
/// multiple of them.
class BinaryReader {
 public:
  /// `where` names the bytes in messages; they are of a format of that version.
  BinaryReader(std::string_view bytes, std::string where, std::uint32_t version = 0)
      : bytes_(bytes), where_(std::move(where)), version_(version) {}
  std::uint32_t version() const { return version_; }

  template <class... T>
  void operator()(T&... values) {
    (read(values), ...);
  }
  bool at_end() const { return bytes_.empty(); }
  /// Throws Error unless `ok`.
  void expect(bool ok, const char* what) const {
    if (!ok) fail("{}: damaged: {}", where_, what);
  }

 private:
  std::string_view take(std::size_t count) {
    expect(count <= bytes_.size(), "it ends too early");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  template <archive_detail::Number T>
  void read(T& value) {
    std::uint64_t bits = 0;
    const std::string_view taken = take(sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(taken[i])) << (8 * i);
    }
    if constexpr (std::is_same_v<T, bool>) {
      expect(bits <= 1, "a flag is neither 0 nor 1");
      value = bits == 1;
    } else {
      value = std::bit_cast<T>(static_cast<archive_detail::Bits<sizeof(T)>>(bits));
    }
  }
  /// Every item takes a byte at least.
  std::size_t read_count() {
    std::uint32_t count = 0;
    read(count);
    expect(count <= bytes_.size(), "a list is longer than the file");
    return count;
  }
  void read(std::string& text) { text = take(read_count()); }
  template <class T>
  void read(std::vector<T>& items) {
    const std::size_t count = read_count();
    items.clear();
    for (std::size_t i = 0; i < count; ++i) read(items.emplace_back());
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& items) {
    for (T& item : items) read(item);
  }
  template <class T>
  void read(std::optional<T>& value) {
    bool has_value = false;
    read(has_value);
    value.reset();
    if (has_value) read(value.emplace());
  }
  template <class S, int R>
  void read(Eigen::Matrix<S, R, 1>& vector) {
    for (int i = 0; i < R; ++i) read(vector[i]);
  }
  void read(Pose& pose) {
    Eigen::Vector4d q;
    read(q);
    read(pose.translation);
    expect(std::abs(q.norm() - 1) < 1e-6 && pose.translation.allFinite(), "a pose is none");
    pose.rotation.coeffs() = q;
  }
  template <class T>
  requires std::is_class_v<T>
  void read(T& value) { fields(*this, value); }

  std::string_view bytes_;
  std::string where_;
  std::uint32_t version_;
};

}  // namespace vinebench::slam

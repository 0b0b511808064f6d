// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sim/assets/gltf.h"

namespace vinebench::sim {

/// The bytes of a buffer view. Throws Error that names `file` if they are outside their buffer.
std::string_view gltf_view(const tinygltf::Model& model, int view, const std::string& file);

/// Numbers of a glTF file, with bounds checked at construction.
class GltfNumbers {
 public:
  /// `type` is one of TINYGLTF_TYPE_*. Throws Error that names `file`.
  GltfNumbers(const tinygltf::Model& model, int accessor, int type, const std::string& file);

  std::size_t size() const { return count_; }
  /// Throw Error unless `whole`, or `real`, can read these numbers.
  void expect_whole(const std::string& file) const;
  void expect_real(const std::string& file) const;
  /// Integers of a normalised accessor are scaled to [0, 1] or [-1, 1].
  float real(std::size_t element, int component) const;
  std::uint32_t whole(std::size_t element) const;

 private:
  const char* at(std::size_t element, int component) const;

  int index_ = 0;
  std::string_view bytes_;
  std::size_t count_ = 0;
  std::size_t stride_ = 0;
  int component_ = 0;
  std::size_t component_size_ = 0;
  bool normalised_ = false;
};

}  // namespace vinebench::sim

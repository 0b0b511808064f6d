// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/gltf_accessor.h"

#include <algorithm>
#include <cstring>

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

template <class T>
T load(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

}  // namespace

std::string_view gltf_view(const tinygltf::Model& model, int index, const std::string& file) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.bufferViews.size()) {
    fail("{}: names buffer view {} of {}", file, index, model.bufferViews.size());
  }
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(index)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) {
    fail("{}: names buffer {} of {}", file, view.buffer, model.buffers.size());
  }
  const std::vector<unsigned char>& buffer =
      model.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
    fail("{}: buffer view {} ends at byte {} of a buffer of {}", file, index,
         view.byteOffset + view.byteLength, buffer.size());
  }
  return {reinterpret_cast<const char*>(buffer.data()) + view.byteOffset, view.byteLength};
}

GltfNumbers::GltfNumbers(const tinygltf::Model& model, int index, int type, const std::string& file)
    : index_(index) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) {
    fail("{}: names accessor {} of {}", file, index, model.accessors.size());
  }
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  if (accessor.type != type) fail("{}: accessor {} has an unexpected type", file, index);
  if (accessor.sparse.isSparse)
    fail("{}: accessor {} is sparse, expected a dense one", file, index);
  if (accessor.bufferView < 0) fail("{}: accessor {} names no buffer view", file, index);
  count_ = accessor.count;
  component_ = accessor.componentType;
  normalised_ = accessor.normalized;
  const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_));
  if (size <= 0) fail("{}: accessor {} has no known component type", file, index);
  component_size_ = static_cast<std::size_t>(size);
  const std::size_t element =
      component_size_ *
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
  const std::string_view view = gltf_view(model, accessor.bufferView, file);
  const std::size_t own =
      model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
  stride_ = own == 0 ? element : own;
  const std::size_t room = view.size() - std::min(view.size(), accessor.byteOffset);
  if (stride_ < element || count_ > room / element ||
      (count_ > 0 && (count_ - 1) > (room - element) / stride_)) {
    fail("{}: accessor {} of {} elements does not fit into its buffer view", file, index, count_);
  }
  bytes_ = view.substr(std::min(view.size(), accessor.byteOffset));
}

const char* GltfNumbers::at(std::size_t element, int component) const {
  return bytes_.data() + element * stride_ + static_cast<std::size_t>(component) * component_size_;
}

void GltfNumbers::expect_whole(const std::string& file) const {
  if (component_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
      component_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
      component_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    return;
  }
  fail("{}: accessor {} has component type {}, expected whole numbers (5121, 5123, 5125)", file,
       index_, component_);
}

void GltfNumbers::expect_real(const std::string& file) const {
  if (component_ != TINYGLTF_COMPONENT_TYPE_INT &&
      component_ != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    return;
  }
  fail("{}: accessor {} has component type {}, expected real numbers (5126) or small whole ones",
       file, index_, component_);
}

float GltfNumbers::real(std::size_t element, int component) const {
  const char* from = at(element, component);
  const auto scaled = [&](auto value, float largest) {
    return normalised_ ? std::max(-1.0f, static_cast<float>(value) / largest)
                       : static_cast<float>(value);
  };
  switch (component_) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return load<float>(from);
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return static_cast<float>(load<double>(from));
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return scaled(load<std::int8_t>(from), 127);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return scaled(load<std::uint8_t>(from), 255);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return scaled(load<std::int16_t>(from), 32767);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return scaled(load<std::uint16_t>(from), 65535);
    default:
      return 0;  // rejected by expect_real()
  }
}

std::uint32_t GltfNumbers::whole(std::size_t element) const {
  const char* from = at(element, 0);
  switch (component_size_) {
    case 1:
      return load<std::uint8_t>(from);
    case 2:
      return load<std::uint16_t>(from);
    default:
      return load<std::uint32_t>(from);
  }
}

}  // namespace vinebench::sim

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/mesh_files.h"

#include <assimp/MemoryIOWrapper.h>

#include <filesystem>
#include <system_error>

#include "core/files/files.h"
#include "sim/assets/obj_check.h"

namespace vinebench::sim {
namespace {

Assimp::IOStream* stream_of(const std::string& text) {
  return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(text.data()),
                                    text.size());
}

}  // namespace

bool MeshFiles::Exists(const char* name) const {
  std::error_code ignored;
  return name == name_ || std::filesystem::exists(name, ignored);
}

Assimp::IOStream* MeshFiles::Open(const char* name, const char*) {
  if (name == name_) return stream_of(content_);
  std::error_code ignored;
  if (!std::filesystem::exists(std::filesystem::symlink_status(name, ignored))) return nullptr;
  if (std::filesystem::is_directory(name, ignored)) return nullptr;  // an empty name
  libraries_.push_back(read_file(name, FileKind::kTable));
  check_mtl(libraries_.back(), name);
  return stream_of(libraries_.back());
}

void MeshFiles::Close(Assimp::IOStream* stream) {
  delete stream;
}

}  // namespace vinebench::sim

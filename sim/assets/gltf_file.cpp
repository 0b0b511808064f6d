// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/gltf_file.h"

#include <algorithm>
#include <cstring>

#include "core/files/json_depth.h"
#include "core/util/error.h"
#include "sim/assets/asset_file.h"

namespace vinebench::sim {
namespace {

/// Keeps an image file's bytes undecoded; those inside a buffer are read later.
bool keep_bytes(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

bool file_exists(const std::string& name, void*) {
  std::error_code ignored;
  return std::filesystem::exists(name, ignored);
}

std::string as_it_is(const std::string& name, void*) {
  return name;
}

bool read_whole(std::vector<unsigned char>* out, std::string* problem, const std::string& name,
                void*) {
  try {
    const std::string bytes = read_mesh_file(name);
    out->assign(bytes.begin(), bytes.end());
    return true;
  } catch (const Error& error) {
    *problem = error.what();
    return false;
  }
}

bool write_nothing(std::string* problem, const std::string&, const std::vector<unsigned char>&,
                   void*) {
  *problem = "is read alone";
  return false;
}

[[maybe_unused]] bool size_of(std::size_t* size, std::string* problem, const std::string& name,
                              void*) {
  std::error_code error;
  *size = std::filesystem::file_size(name, error);
  if (error) *problem = error.message();
  return !error;
}

/// Newer versions of tinygltf ask for the size too, and refuse callbacks of which one is missing.
template <class Callbacks>
Callbacks file_callbacks() {
  Callbacks callbacks{};
  callbacks.FileExists = file_exists;
  callbacks.ExpandFilePath = as_it_is;
  callbacks.ReadWholeFile = read_whole;
  callbacks.WriteWholeFile = write_nothing;
  if constexpr (requires { callbacks.GetFileSizeInBytes; }) callbacks.GetFileSizeInBytes = size_of;
  return callbacks;
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof(number));
  return number;
}

/// The JSON text of a .glb, after checking its stated lengths: tinygltf reads a few bytes past the
/// end of a truncated second chunk.
std::string_view glb_json(std::string_view bytes, const std::string& file) {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  if (bytes.size() < kHeader + kChunkHeader) {
    fail("{}: expected a .glb of glTF 2.0, found only {} bytes", file, bytes.size());
  }
  if (number_at(bytes, 4) != 2) {
    fail("{}: expected glTF 2.0, found version {}", file, number_at(bytes, 4));
  }
  const std::size_t size = number_at(bytes, 8);
  if (size > bytes.size()) {
    fail("{}: expected {} bytes by its header, found {}: is it truncated?", file, size,
         bytes.size());
  }
  bytes = bytes.substr(0, std::max(size, kHeader + kChunkHeader));
  for (std::size_t at = kHeader; at < bytes.size();) {
    const std::size_t room = bytes.size() - at;
    if (room < kChunkHeader || number_at(bytes, at) > room - kChunkHeader) {
      fail("{}: the chunk at byte {} does not fit into the file", file, at);
    }
    at += kChunkHeader + number_at(bytes, at);
  }
  return bytes.substr(kHeader + kChunkHeader, number_at(bytes, kHeader));
}

bool load(const std::string& bytes, const std::filesystem::path& file, tinygltf::Model& model,
          std::string& problem) {
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(keep_bytes, nullptr);
  reader.SetFsCallbacks(file_callbacks<tinygltf::FsCallbacks>());
  const std::string folder = file.parent_path().string();
  const auto size = static_cast<unsigned int>(bytes.size());
  std::string warning;
  try {
    if (!bytes.starts_with("glTF")) {
      return reader.LoadASCIIFromString(&model, &problem, &warning, bytes.data(), size, folder);
    }
    return reader.LoadBinaryFromMemory(&model, &problem, &warning,
                                       reinterpret_cast<const unsigned char*>(bytes.data()), size,
                                       folder);
  } catch (const std::exception& exception) {
    problem += exception.what();
    return false;
  }
}

/// A single, shortened line: a parser may quote the whole string that it fails on.
std::string brief(std::string text) {
  constexpr std::size_t kHead = 160, kTail = 80;
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  if (text.size() <= kHead + kTail) return text;
  return text.substr(0, kHead) + " ... " + text.substr(text.size() - kTail);
}

/// Extensions of how a surface looks, whose images are left out where they cannot be read, and
/// small integers in place of floats, which are read anyway.
bool can_be_left_out(const std::string& extension) {
  return extension.starts_with("KHR_materials_") || extension.starts_with("KHR_texture_") ||
         extension == "EXT_texture_webp" || extension == "KHR_lights_punctual" ||
         extension == "KHR_mesh_quantization";
}

}  // namespace

tinygltf::Model parse_gltf(const std::string& bytes, const std::filesystem::path& file) {
  check_json_depth(bytes.starts_with("glTF") ? glb_json(bytes, file.string()) : bytes,
                   file.string());
  tinygltf::Model model;
  std::string problem;
  const bool whole = load(bytes, file, model, problem);
  // tinygltf also continues after unreadable parts.
  if (!whole || !problem.empty()) fail("{}: expected glTF 2.0: {}", file.string(), brief(problem));
  if (!model.asset.version.starts_with("2.")) {
    fail("{}: expected glTF 2.0, found version '{}'", file.string(), model.asset.version);
  }
  for (const std::string& extension : model.extensionsRequired) {
    if (can_be_left_out(extension)) continue;
    fail("{}: needs the glTF extension {}, which is not supported", file.string(), extension);
  }
  return model;
}

}  // namespace vinebench::sim

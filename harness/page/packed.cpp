// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/packed.h"

#include <libdeflate.h>

#include <memory>
#include <new>

#include "core/util/base64.h"
#include "harness/datasets/files/json_file.h"

namespace vinebench::harness {

std::string packed(const nlohmann::ordered_json& value) {
  constexpr int kLevel = 6;
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  const std::string text = json_text(value);
  std::string bytes(libdeflate_gzip_compress_bound(compressor.get(), text.size()), '\0');
  bytes.resize(libdeflate_gzip_compress(compressor.get(), text.data(), text.size(), bytes.data(),
                                        bytes.size()));
  return base64(bytes);
}

std::string script_text(const nlohmann::ordered_json& value) {
  std::string text;
  // "</script" and "<!--" would end or change the element; in JSON, '<' stands in strings alone.
  for (const char c : json_text(value))
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

}  // namespace vinebench::harness

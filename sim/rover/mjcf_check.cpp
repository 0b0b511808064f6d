// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/mjcf_check.h"

#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "core/files/files.h"

namespace vinebench::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostModels = 100;  // that include each other

/// The values of an attribute, wherever it stands in the text.
std::vector<std::string> values_of(const std::string& text, const std::string& attribute) {
  std::vector<std::string> values;
  for (std::size_t at = text.find(attribute); at != text.npos; at = text.find(attribute, at + 1)) {
    const std::size_t equals = text.find_first_not_of(" \t\r\n", at + attribute.size());
    if (equals == text.npos || text[equals] != '=') continue;
    const std::size_t quote = text.find_first_not_of(" \t\r\n", equals + 1);
    if (quote == text.npos || (text[quote] != '"' && text[quote] != '\'')) continue;
    values.push_back(text.substr(quote + 1, text.find(text[quote], quote + 1) - quote - 1));
  }
  return values;
}

class MjcfCheck {
 public:
  void check(const fs::path& model) {
    if (!seen_.insert(model.lexically_normal()).second || seen_.size() > kMostModels) return;
    const std::string text = read_file(model, FileKind::kMesh);
    std::vector<fs::path> folders{model.parent_path()};
    for (const char* key : {"meshdir", "texturedir", "assetdir"}) {
      for (const std::string& folder : values_of(text, key)) {
        folders.push_back(model.parent_path() / folder);
      }
    }
    for (const std::string& name : values_of(text, "file")) {
      for (const fs::path& folder : folders) check_named(folder / name);
    }
  }

 private:
  void check_named(const fs::path& file) {
    std::error_code ignored;
    const fs::file_status status = fs::symlink_status(file, ignored);
    if (!fs::exists(status) || fs::is_directory(file, ignored)) return;
    check_input_file(file, FileKind::kMesh);
    if (file.extension() == ".xml") check(file);
  }

  std::set<fs::path> seen_;
};

}  // namespace

void check_mjcf_files(const fs::path& mjcf) {
  MjcfCheck().check(mjcf);
}

}  // namespace vinebench::sim

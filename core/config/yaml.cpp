// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/config/yaml.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "core/config/second_document.h"
#include "core/files/files.h"
#include "core/util/error.h"
#include "core/util/suggestion.h"

namespace vinebench {
namespace {

/// The value found, shortened for a message.
std::string describe(const YAML::Node& node) {
  if (node.IsNull()) return "nothing";
  if (node.IsSequence()) return fmt::format("a list of {}", node.size());
  if (node.IsMap()) return "a map";
  std::string text = node.Scalar();
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return "'" + text + "'";
}

/// Files that one after the other name the next as their base.
constexpr std::size_t kMostBases = 8;

/// Maps and lists in each other; no file of ours has more than a dozen.
constexpr std::size_t kMostLevels = 64;

/// Parts of one document, an alias counted as what it stands for.
constexpr int kMostParts = 1'000'000;

/// Rejects trees that are no trees: an alias may stand inside of what it names, and some lines of
/// aliases to aliases stand for more parts than fit into memory.
class TreeCheck {
 public:
  explicit TreeCheck(std::string source) : source_(std::move(source)) {}

  void check(const YAML::Node& node) {
    if (++parts_ > kMostParts) {
      fail("{}: expected at most {} parts, aliases counted as what they stand for", place(node),
           kMostParts);
    }
    if (!node.IsMap() && !node.IsSequence()) return;
    for (const YAML::Node& outer : path_) {
      if (outer.is(node)) fail("{}: an alias inside of what it names", place(node));
    }
    if (path_.size() == kMostLevels) {
      fail("{}: expected at most {} levels of maps and lists", place(node), kMostLevels);
    }
    path_.push_back(node);
    for (const auto& item : node) check(node.IsMap() ? item.second : item);
    path_.pop_back();
  }

 private:
  std::string place(const YAML::Node& node) const {
    return fmt::format("{}:{}", source_, node.Mark().line + 1);
  }

  std::string source_;
  std::vector<YAML::Node> path_;  ///< from the root to the node under check
  int parts_ = 0;
};

std::vector<std::string> split(const std::string& key) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', begin)) {
    parts.push_back(key.substr(begin, dot - begin));
    begin = dot + 1;
  }
  parts.push_back(key.substr(begin));
  return parts;
}

/// Sets one dotted key of a tree; recursive because a YAML::Node that is assigned to changes what
/// it refers to instead of where the variable points.
void assign(YAML::Node node, const std::vector<std::string>& parts, std::size_t at,
            const YAML::Node& value, const std::string& key) {
  const std::string& part = parts[at];
  const bool last = at + 1 == parts.size();
  if (node.IsSequence()) {
    const bool number = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
    if (!number || part.size() > 6 || std::stoul(part) >= node.size()) {
      fail("--set {}: '{}' is not an index into a list of {}", key, part, node.size());
    }
    const std::size_t index = std::stoul(part);
    if (last) {
      node[index] = value;
    } else {
      assign(node[index], parts, at + 1, value, key);
    }
    return;
  }
  if (node.IsDefined() && !node.IsMap() && !node.IsNull()) {
    fail("--set {}: unknown key, the value before '{}' has no keys", key, part);
  }
  if (last) {
    node[part] = value;
  } else {
    if (!node[part].IsDefined()) node[part] = YAML::Node(YAML::NodeType::Map);
    assign(node[part], parts, at + 1, value, key);
  }
}

}  // namespace

YAML::Node load_yaml_tree(const std::filesystem::path& file) {
  const std::string text = read_file(file, FileKind::kYaml);
  try {
    YAML::Node tree = YAML::Load(text);
    TreeCheck(file.string()).check(tree);
    if (const auto mark = second_document(text)) {
      fail("{}:{}: a second YAML document; expected one", file.string(), mark->line + 1);
    }
    return tree;
  } catch (const YAML::Exception& error) {
    fail("{}:{}: is not valid YAML: {}", file.string(), error.mark.line + 1, error.msg);
  } catch (const std::bad_alloc&) {
    fail("{}: not enough memory for its tree", file.string());
  }
}

YamlDocument YamlDocument::load(const std::filesystem::path& file) {
  YamlDocument document;
  document.root_ = load_yaml_tree(file);
  document.files_[""] = file;
  if (!document.root_.IsMap()) {
    fail("{}:1: expected a map of keys, found {}", file.string(), describe(document.root_));
  }
  return document;
}

void YamlDocument::inherit(const std::string& key, const std::vector<std::string>& parts,
                           const std::vector<std::string>& own_keys,
                           std::vector<std::filesystem::path> derived) {
  const YAML::Node named = std::as_const(root_)[key];
  if (!named.IsDefined()) return;
  const std::filesystem::path own = file_of("");
  const std::string place = place_of(key, named);
  if (!named.IsScalar()) fail("{}: {}: expected a file, found {}", place, key, describe(named));
  const std::filesystem::path file = own.parent_path() / named.Scalar();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    fail("{}: {}: expected a file, found none at '{}'", place, key, file.string());
  }
  derived.push_back(own);
  const bool circle = std::ranges::any_of(derived, [&](const std::filesystem::path& other) {
    return std::filesystem::equivalent(file, other, ignored);
  });
  if (circle) fail("{}: {}: '{}' is derived from this file", place, key, file.string());
  if (derived.size() > kMostBases) {
    fail("{}: {}: expected at most {} files in a row", place, key, kMostBases);
  }
  YamlDocument base = load(file);
  base.inherit(key, parts, own_keys, derived);
  for (const std::string& own_key : own_keys) base.root_.remove(own_key);
  for (const std::string& part : parts) base.include(part);
  root_.remove(key);
  base.overlay(base.root_, root_, "", own);
  *this = std::move(base);
}

/// Merges the items of `source`, which come from `file`, into `target`.
void YamlDocument::overlay(YAML::Node target, const YAML::Node& source, const std::string& prefix,
                           const std::filesystem::path& file) {
  // Aliases of both files together can make a tree that ends nowhere.
  if (std::ranges::count(prefix, '.') >= static_cast<std::ptrdiff_t>(kMostLevels)) {
    fail("{}:{}: expected at most {} levels of maps and lists", file.string(),
         source.Mark().line + 1, kMostLevels);
  }
  std::set<std::string> present;
  for (const auto& item : std::as_const(target)) present.insert(item.first.as<std::string>(""));
  for (const auto& item : source) {
    const auto key = item.first.as<std::string>("");
    const std::string dotted = prefix.empty() ? key : prefix + "." + key;
    if (!present.contains(key)) {
      target.force_insert(item.first, item.second);
    } else if (item.second.IsMap() && target[key].IsMap()) {
      overlay(target[key], item.second, dotted, file);
      continue;
    } else {
      target[key] = item.second;
    }
    std::erase_if(files_, [&](const auto& of) { return of.first.starts_with(dotted + "."); });
    files_[dotted] = file;
  }
}

void YamlDocument::include(const std::string& key) {
  const YAML::Node node = std::as_const(root_)[key];
  if (!node.IsDefined() || !node.IsScalar()) return;
  const std::filesystem::path file = file_of(key).parent_path() / node.Scalar();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    fail("{}: {}: expected a file, found none at '{}'", place_of(key, node), key, file.string());
  }
  root_[key] = load_yaml_tree(file);
  files_[key] = file;
}

void YamlDocument::set(const std::string& key, const std::string& value) {
  YAML::Node parsed;
  try {
    parsed = YAML::Load(value);
    TreeCheck("--set " + key).check(parsed);
  } catch (const YAML::Exception& error) {
    fail("--set {}: '{}' is not valid YAML: {}", key, value, error.msg);
  }
  if (root_.IsNull()) root_ = YAML::Node(YAML::NodeType::Map);  // a document without a file
  assign(root_, split(key), 0, parsed, key);
  overrides_[key] = value;
}

std::filesystem::path YamlDocument::file_of(const std::string& key) const {
  for (std::string prefix = key;;) {
    if (const auto found = files_.find(prefix); found != files_.end()) return found->second;
    if (prefix.empty()) return "(defaults)";  // a document without a file
    const std::size_t dot = prefix.rfind('.');
    prefix = dot == std::string::npos ? "" : prefix.substr(0, dot);
  }
}

std::string YamlDocument::place_of(const std::string& key, const YAML::Node& node) const {
  for (const auto& [overridden, value] : overrides_) {
    const bool below = key == overridden || key.starts_with(overridden + ".");
    if (below || (!node.IsNull() && overridden.starts_with(key + ".") && node.Mark().is_null())) {
      return fmt::format("--set {}={}", overridden, value);
    }
  }
  const int line = node.IsDefined() && !node.Mark().is_null() ? node.Mark().line + 1 : 1;
  return fmt::format("{}:{}", file_of(key).string(), line);
}

void YamlReader::violation(const std::string& key, const YAML::Node& node,
                           const std::string& text) {
  violations_.push_back(fmt::format("{}: {}: {}, found {}", document_.place_of(key, node), key,
                                    text, describe(node)));
}

YAML::Node YamlReader::find(const std::string& key) const {
  return node_.IsMap() ? node_[key] : YAML::Node(YAML::NodeType::Undefined);
}

void YamlReader::require(bool ok, const std::string& key, const std::string& expectation) {
  if (ok) return;
  YAML::Node node = node_;
  if (const YAML::Node child = find(split(key).front()); child.IsDefined()) node.reset(child);
  violations_.push_back(
      fmt::format("{}: {}: {}", document_.place_of(full(key), node), full(key), expectation));
}

void YamlReader::finish() {
  if (!node_.IsMap()) return;
  std::set<std::string> seen;
  for (const auto& item : node_) {
    const std::string key = item.first.IsScalar() ? item.first.Scalar() : "?";
    const YAML::Node& place = item.first;
    if (!known_.contains(key)) {
      std::string expected;
      for (const std::string& k : known_) expected += (expected.empty() ? "" : ", ") + k;
      expected += did_you_mean(key, {known_.begin(), known_.end()});
      violations_.push_back(fmt::format("{}: {}: unknown key, expected one of: {}",
                                        document_.place_of(full(key), place), full(key), expected));
    } else if (!seen.insert(key).second) {
      violations_.push_back(
          fmt::format("{}: {}: duplicate key", document_.place_of(full(key), place), full(key)));
    }
  }
}

bool YamlReader::expect_sequence(const YAML::Node& node, const std::string& key, std::size_t size) {
  if (node.IsSequence() && node.size() == size) return true;
  violation(key, node,
            node.IsSequence() || size > 0 ? fmt::format("expected a list of {}", size)
                                          : "expected a list");
  return false;
}

bool YamlReader::expect_map(const YAML::Node& node, const std::string& key) {
  if (node.IsNull()) return false;
  bool named = node.IsMap();
  for (const auto& item : node) named = named && item.first.IsScalar();
  if (!named) violation(key, node, "expected a map of names");
  return named;
}

void YamlReader::read(const YAML::Node& node, const std::string& key, bool& value, const Range&) {
  if (!node.IsScalar() || !YAML::convert<bool>::decode(node, value)) {
    violation(key, node, "expected true or false");
  }
}

void YamlReader::read(const YAML::Node& node, const std::string& key, double& value,
                      const Range& range) {
  double read = 0;
  if (!node.IsScalar() || node.Tag() == "!" || !YAML::convert<double>::decode(node, read) ||
      !std::isfinite(read) || !range.contains(read)) {
    violation(key, node, "expected " + range.text());
    return;
  }
  value = read;
}

void YamlReader::read(const YAML::Node& node, const std::string& key, std::string& value,
                      const Range&) {
  if (!node.IsScalar()) {
    violation(key, node, "expected text");
    return;
  }
  value = node.Scalar();
}

void YamlReader::read(const YAML::Node& node, const std::string& key, std::filesystem::path& value,
                      const Range& range) {
  std::string text;
  read(node, key, text, range);
  if (text.empty()) return;
  const bool overridden = std::ranges::any_of(document_.overrides_, [&](const auto& item) {
    return key == item.first || key.starts_with(item.first + ".");
  });
  value = overridden ? std::filesystem::path(text) : document_.file_of(key).parent_path() / text;
  value = std::filesystem::absolute(value).lexically_normal();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(value, ignored)) {
    violations_.push_back(fmt::format("{}: {}: expected a file, found none at '{}'",
                                      document_.place_of(key, node), key, value.string()));
  }
}

void YamlReader::read_integer(const YAML::Node& node, const std::string& key, std::int64_t& value,
                              const Range& range) {
  std::int64_t read = 0;
  if (!node.IsScalar() || node.Tag() == "!" || !YAML::convert<std::int64_t>::decode(node, read) ||
      !range.contains(static_cast<double>(read))) {
    violation(key, node,
              "expected a whole number" +
                  (range.text() == "a finite number" ? std::string() : range.text().substr(8)));
    return;
  }
  value = read;
}

void YamlReader::read_name(const YAML::Node& node, const std::string& key,
                           const std::vector<std::string>& names, int& value) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (node.IsScalar() && node.Scalar() == names[i]) {
      value = static_cast<int>(i);
      return;
    }
    list += (i ? ", " : "") + names[i];
  }
  violation(key, node, "expected one of: " + list);
  if (node.IsScalar()) violations_.back() += did_you_mean(node.Scalar(), names);
}

}  // namespace vinebench

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/collada_check.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <vector>

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

constexpr std::size_t kDeepestNode = 64;  // nodes in each other
constexpr std::size_t kDeepestElement = 200;
constexpr double kMostNodes = 100'000;

/// The nodes instanced by each node, in the order of the text.
using Graph = std::map<std::string, std::vector<std::string>, std::less<>>;

/// A view of a list of numbers.
struct Accessor {
  std::string array;
  double count = 0;
  double stride = 1;
  double offset = 0;
  double params = 0;  ///< numbers of an item
};

struct Extent {
  double nodes = 1;
  std::size_t depth = 1;
};

class ColladaCheck {
 public:
  ColladaCheck(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  void run() {
    for (std::size_t at = text_.find('<'); at < text_.size(); at = text_.find('<', at)) {
      at = skip_tag(at);
    }
    for (const auto& [name, children] : graph_) unfold(name, 1);
    for (const Accessor& accessor : accessors_) check(accessor);
    for (const std::string& source : inputs_) {
      if (texts_.contains(source)) fail("{}: '{}': expected numbers, found names", file_, source);
    }
  }

 private:
  /// Reads the tag at `at`; returns its end.
  std::size_t skip_tag(std::size_t at) {
    if (text_.substr(at).starts_with("<!--")) return end_of("-->", at);
    if (text_.substr(at).starts_with("<![CDATA[")) return end_of("]]>", at);
    const std::size_t end = end_of_tag(at);
    const std::string_view tag = text_.substr(at, end - at);
    if (tag.starts_with("<?") || tag.starts_with("<!")) return end;
    if (tag.starts_with("</")) {
      if (!open_.empty()) open_.pop_back();
      if (tag.starts_with("</accessor")) in_accessor_ = false;
      return end;
    }
    read(tag);
    if (!tag.ends_with("/>")) {
      open_.push_back(node_);
      check_indices(tag, end);
    }
    if (open_.size() > kDeepestElement) {
      fail("{}: more than {} elements in each other", file_, kDeepestElement);
    }
    return end;
  }

  static std::string_view name_of(std::string_view tag) {
    return tag.substr(1, tag.find_first_of(" \t\r\n/>") - 1);
  }

  /// Assimp waits for ever, and collects zeros, at what is no number in a list of indices.
  void check_indices(std::string_view tag, std::size_t begin) const {
    const std::string_view name = name_of(tag);
    if (name != "p" && name != "h" && name != "v" && name != "vcount") return;
    const std::size_t end = std::min(text_.find('<', begin), text_.size());
    const std::string_view list = text_.substr(begin, end - begin);
    const std::size_t other = list.find_first_not_of("0123456789+- \t\r\n");
    if (other != list.npos || !text_.substr(end).starts_with("</")) {
      fail("{}: <{}>: expected whole numbers, found '{}'", file_, name,
           text_.substr(begin + std::min(other, list.size()), 10));
    }
  }

  void read(std::string_view tag) {
    const std::string_view name = name_of(tag);
    const std::string parent = open_.empty() ? "" : open_.back();
    node_ = parent;
    if (name == "node") {
      node_ = fmt::format("{}#{}", attribute(tag, "id"), unnamed_++);
      ids_.emplace(attribute(tag, "id"), node_);
      graph_[parent].push_back(node_);
      graph_[node_];
    } else if (name == "instance_node") {
      const std::string_view url = attribute(tag, "url");
      graph_[parent].emplace_back(url.substr(std::min<std::size_t>(1, url.size())));
    }
    for (const char* key : {"count", "offset", "set", "stride"}) whole_number(tag, key, 0);
    read_list(name, tag);
  }

  /// Assimp reads lists of numbers through accessors without checking their bounds.
  void read_list(std::string_view name, std::string_view tag) {
    const bool names = name == "Name_array" || name == "IDREF_array";
    if (name == "source") source_ = id_of(tag);
    if (names) texts_.insert(source_);
    if (names || name == "float_array") {
      arrays_[id_of(tag)] = whole_number(tag, "count", 0);
    } else if (name == "accessor") {
      accessors_.push_back({reference(tag, "source"), whole_number(tag, "count", 0),
                            whole_number(tag, "stride", 1), whole_number(tag, "offset", 0)});
      in_accessor_ = !tag.ends_with("/>");
    } else if (name == "param" && in_accessor_) {
      ++accessors_.back().params;
    } else if (name == "input" && needs_numbers(attribute(tag, "semantic"))) {
      inputs_.push_back(reference(tag, "source"));
    }
  }

  static bool needs_numbers(std::string_view semantic) {
    for (const char* kind : {"POSITION", "NORMAL", "TEXCOORD", "COLOR", "TEXTANGENT", "TEXBINORMAL",
                             "TANGENT", "BINORMAL", "VERTEX"}) {
      if (semantic == kind) return true;
    }
    return false;
  }

  void check(const Accessor& accessor) const {
    const auto array = arrays_.find(accessor.array);
    if (array == arrays_.end()) return;  // of a kind that assimp does not read
    const double params = std::max(1.0, accessor.params);
    const double last = accessor.offset + (accessor.count - 1) * accessor.stride + params;
    if (accessor.count > 0 && last > array->second) {
      fail("{}: an accessor of {} numbers in the list '{}' of {}", file_, last, accessor.array,
           array->second);
    }
  }

  /// Digits alone: what other readers make of a sign or a letter differs. Fails for more than the
  /// file has bytes.
  double whole_number(std::string_view tag, std::string_view name, double fallback) const {
    const std::string_view text = attribute(tag, name);
    if (text.empty() || !is_list(tag)) return fallback;
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.find_first_not_of("0123456789") != text.npos || error != std::errc{} ||
        end != text.data() + text.size()) {
      fail("{}: {}: expected a whole number, found '{}'", file_, name, text.substr(0, 40));
    }
    if (number > static_cast<double>(text_.size())) {
      fail("{}: a list of {} items in a file of {} bytes", file_, text, text_.size());
    }
    return number;
  }

  /// Whether assimp reads whole numbers of these elements.
  static bool is_list(std::string_view tag) {
    for (const std::string_view name :
         {"_array", "accessor", "input", "triangles", "polylist", "polygons", "lines", "linestrips",
          "trifans", "tristrips", "vertex_weights"}) {
      if (tag.substr(0, tag.find_first_of(" \t\r\n/>")).ends_with(name)) return true;
    }
    return false;
  }

  /// Assimp would decode a reference to a character.
  std::string id_of(std::string_view tag) const {
    const std::string_view id = attribute(tag, "id");
    if (id.find('&') != id.npos) fail("{}: id '{}': expected no '&'", file_, id.substr(0, 40));
    return std::string(id);
  }

  std::string reference(std::string_view tag, std::string_view name) const {
    const std::string_view url = attribute(tag, name);
    if (url.find('&') != url.npos) fail("{}: '{}': expected no '&'", file_, url.substr(0, 40));
    return std::string(url.substr(std::min<std::size_t>(1, url.size())));
  }

  /// The first attribute of that name, as assimp takes it.
  static std::string_view attribute(std::string_view tag, std::string_view name) {
    constexpr std::string_view kBlanks = " \t\r\n";
    std::size_t at = tag.find_first_of(kBlanks);
    while (at < tag.size()) {
      const std::size_t begin = tag.find_first_not_of(kBlanks, at);
      const std::size_t equals = tag.find('=', std::min(begin, tag.size()));
      if (equals >= tag.size()) break;
      const std::size_t quote = tag.find_first_of("\"'", equals);
      if (quote == tag.npos) break;
      const std::size_t end = std::min(tag.find(tag[quote], quote + 1), tag.size());
      const std::string_view key = tag.substr(begin, equals - begin);
      if (key.substr(0, key.find_first_of(kBlanks)) == name) {
        return tag.substr(quote + 1, end - quote - 1);
      }
      at = end + 1;
    }
    return {};
  }

  /// A node that contains itself exceeds any depth limit.
  Extent unfold(const std::string& name, std::size_t level) {
    if (level > kDeepestNode) {
      fail("{}: nodes lie more than {} deep in each other, or in themselves", file_, kDeepestNode);
    }
    const auto id = ids_.find(name);
    const std::string& node = id == ids_.end() ? name : id->second;
    if (const auto known = extents_.find(node); known != extents_.end()) {
      if (level + known->second.depth <= kDeepestNode) return known->second;
    }
    Extent extent;
    if (const auto found = graph_.find(node); found != graph_.end()) {
      for (const std::string& child : found->second) {
        const Extent of_child = unfold(child, level + 1);
        extent.nodes += of_child.nodes;
        extent.depth = std::max(extent.depth, of_child.depth + 1);
      }
    }
    if (extent.nodes > kMostNodes) fail("{}: more than {} nodes", file_, kMostNodes);
    return extents_[node] = extent;
  }

  /// The end of a tag, whose attributes may have a '>' in their values.
  std::size_t end_of_tag(std::size_t at) const {
    while ((at = text_.find_first_of("\"'>", at)) != text_.npos && text_[at] != '>') {
      at = text_.find(text_[at], at + 1);
      if (at == text_.npos) break;
      ++at;
    }
    return at == text_.npos ? text_.size() : at + 1;
  }

  std::size_t end_of(std::string_view mark, std::size_t at) const {
    const std::size_t found = text_.find(mark, at);
    return found == text_.npos ? text_.size() : found + mark.size();
  }

  std::string_view text_;
  const std::string& file_;
  std::vector<std::string> open_;  ///< the node of each open element
  std::string node_;
  int unnamed_ = 0;
  std::map<std::string, std::string, std::less<>> ids_;
  Graph graph_;
  std::map<std::string, Extent> extents_;
  std::string source_;                    ///< the latest
  std::map<std::string, double> arrays_;  ///< their stated items, by id
  std::vector<Accessor> accessors_;
  bool in_accessor_ = false;         ///< the last of them
  std::set<std::string> texts_;      ///< sources of names
  std::vector<std::string> inputs_;  ///< sources that must be of numbers
};

}  // namespace

void check_collada(std::string_view text, const std::string& file) {
  ColladaCheck(text, file).run();
}

}  // namespace vinebench::sim

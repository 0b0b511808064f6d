// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/collada_check.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <vector>

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

constexpr std::size_t kDeepestNode = 64;  // nodes in each other
constexpr std::size_t kDeepestElement = 200;
constexpr double kMostNodes = 100'000;

/// The nodes instanced by each node, in the order of the text.
using Graph = std::map<std::string, std::vector<std::string>, std::less<>>;

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
  }

 private:
  /// Reads the tag at `at`; returns its end.
  std::size_t skip_tag(std::size_t at) {
    if (text_.substr(at).starts_with("<!--")) return end_of("-->", at);
    if (text_.substr(at).starts_with("<![CDATA[")) return end_of("]]>", at);
    const std::size_t end = end_of(">", at);
    const std::string_view tag = text_.substr(at, end - at);
    if (tag.starts_with("<?") || tag.starts_with("<!")) return end;
    if (tag.starts_with("</")) {
      if (!open_.empty()) open_.pop_back();
      return end;
    }
    read(tag);
    if (!tag.ends_with("/>")) open_.push_back(node_);
    if (open_.size() > kDeepestElement) {
      fail("{}: more than {} elements in each other", file_, kDeepestElement);
    }
    return end;
  }

  void read(std::string_view tag) {
    const std::string_view name = tag.substr(1, tag.find_first_of(" \t\r\n/>") - 1);
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
    const std::string_view count = attribute(tag, "count");
    double stated = 0;
    std::from_chars(count.data(), count.data() + count.size(), stated);
    if (stated > static_cast<double>(text_.size())) {
      fail("{}: a list of {} items in a file of {} bytes", file_, count, text_.size());
    }
  }

  static std::string_view attribute(std::string_view tag, std::string_view name) {
    for (std::size_t at = tag.find(name); at != tag.npos; at = tag.find(name, at + 1)) {
      const std::size_t quote = tag.find_first_not_of(" \t\r\n=", at + name.size());
      const bool whole = std::string_view(" \t\r\n").find(tag[at - 1]) != tag.npos;
      if (!whole || quote == tag.npos || (tag[quote] != '"' && tag[quote] != '\'')) continue;
      return tag.substr(quote + 1, tag.find(tag[quote], quote + 1) - quote - 1);
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
};

}  // namespace

void check_collada(std::string_view text, const std::string& file) {
  ColladaCheck(text, file).run();
}

}  // namespace vinebench::sim

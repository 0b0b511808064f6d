// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/config/second_document.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/parser.h>

#include <sstream>

namespace vinebench {
namespace {

/// Where the content of a document begins, without building it.
class ContentMark : public YAML::EventHandler {
 public:
  const std::optional<YAML::Mark>& mark() const { return mark_; }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { note(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string&) override {
    note(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    note(mark);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    note(mark);
  }
  void OnMapEnd() override {}

 private:
  void note(const YAML::Mark& mark) {
    if (!mark_) mark_ = mark;
  }
  std::optional<YAML::Mark> mark_;
};

}  // namespace

std::optional<YAML::Mark> second_document(const std::string& text) {
  constexpr int kMore = 2;
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  ContentMark first;
  if (!parser.HandleNextDocument(first)) return std::nullopt;
  for (int i = 0; i < kMore; ++i) {
    ContentMark next;
    if (!parser.HandleNextDocument(next)) return std::nullopt;
    if (next.mark()) return next.mark();
  }
  return std::nullopt;
}

}  // namespace vinebench

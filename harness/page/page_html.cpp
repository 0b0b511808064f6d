// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/page_html.h"

#include <fmt/format.h>

#include "core/util/xml_text.h"
#include "harness/page/packed.h"
#include "harness/page/page_parts.h"

namespace vinebench::harness {

std::string page_html(const std::string& title, const nlohmann::ordered_json& report,
                      const std::string& elements) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n{}</style>\n</head>\n"
      "<body>\n<noscript>This page needs JavaScript.</noscript>\n<div id=\"app\"></div>\n"
      "<script type=\"application/json\" id=\"report\">{}</script>\n{}<script>\n{}</script>\n"
      "</body>\n</html>\n",
      xml_escaped(title), page_style(), script_text(report), elements, page_script());
}

}  // namespace vinebench::harness

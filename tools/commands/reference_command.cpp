// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/util/error.h"
#include "harness/datasets/files/json_file.h"
#include "harness/experiment/reference.h"
#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::string file;
  std::string part;
  bool json = false;
};

std::string type_of(const Option& option) {
  if (!option.type.empty()) return option.type;
  const auto is = [&]<class T>(T*) { return std::holds_alternative<T*>(option.target); };
  if (is(static_cast<bool*>(nullptr))) return "";
  if (is(static_cast<double*>(nullptr))) return "NUMBER";
  if (is(static_cast<std::string*>(nullptr)) ||
      is(static_cast<std::vector<std::string>*>(nullptr)) ||
      is(static_cast<std::filesystem::path*>(nullptr))) {
    return "TEXT";
  }
  return "WHOLE NUMBER";
}

Json json_of(const Option& option) {
  Json json{{"name", option.name}, {"help", option.help}, {"type", type_of(option)}};
  if (option.range) json["range"] = option.range->text();
  if (!option.choices.empty()) json["choices"] = option.choices;
  json["required"] = option.required;
  return json;
}

Json json_of(const Command& command) {
  Json json{{"name", command.name}, {"description", command.description}};
  json["options"] = Json::array();
  for (const Option& option : command.options) json["options"].push_back(json_of(option));
  json["commands"] = Json::array();
  for (const Command& part : command.commands) json["commands"].push_back(json_of(part));
  json["footer"] = command.footer;
  return json;
}

Json json_of(const ConfigField& field) {
  return {{"key", field.key},   {"owner", field.owner}, {"own_key", field.own_key},
          {"type", field.type}, {"value", field.value}, {"range", field.range}};
}

/// All that the site's pages are made of, by tools/reference.py.
void print_json(const Command& program) {
  Json json;
  json["files"] = Json::array();
  for (const harness::FileKeys& file : harness::file_keys()) {
    Json keys = Json::array();
    for (const ConfigField& field : file.keys) keys.push_back(json_of(field));
    json["files"].push_back(
        {{"name", file.name}, {"description", file.description}, {"keys", keys}});
  }
  json["program"] = json_of(program);
  fmt::print("{}\n", harness::json_text(json, 1));
}

bool is_part(const std::string& key, const std::string& part) {
  return part.empty() || key == part || key.starts_with(part + ".");
}

/// The keys of a file, or of a part of it, a line each.
int print_keys(const Arguments& arguments) {
  std::vector<ConfigField> keys;
  for (const harness::FileKeys& file : harness::file_keys()) {
    if (file.name == arguments.file) keys = file.keys;
  }
  std::erase_if(keys,
                [&](const ConfigField& field) { return !is_part(field.key, arguments.part); });
  if (keys.empty()) fail("{}: has no key {}", arguments.file, arguments.part);
  std::size_t width = 0;
  for (const ConfigField& field : keys) width = std::max(width, field.key.size());
  for (const ConfigField& field : keys) {
    std::string line = fmt::format("{:<{}}  {}", field.key, width, field.type);
    if (!field.value.empty()) line += fmt::format(", default {}", field.value);
    if (!field.range.empty()) line += fmt::format("; {}", field.range);
    fmt::print("{}\n", line);
  }
  return 0;
}

int reference(const Arguments& arguments, const Surroundings& surroundings) {
  if (!arguments.json) return print_keys(arguments);
  print_json(program(surroundings));
  return 0;
}

}  // namespace

Command reference_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<Arguments>();
  arguments->file = "scenario";
  return {.name = "reference",
          .description = "List the keys that files may have, with types, defaults and ranges",
          .options = {{.name = "FILE",
                       .target = &arguments->file,
                       .help = "Which kind of file (default: scenario)",
                       .choices = {"scenario", "rig", "cultivar", "randomisation"}},
                      {.name = "KEY",
                       .target = &arguments->part,
                       .help = "Only this key and those below it, e.g. world.sun"},
                      {.name = "--json",
                       .target = &arguments->json,
                       .help = "All kinds and all commands, as JSON"}},
          .run = [arguments, surroundings] { return reference(*arguments, surroundings); }};
}

}  // namespace vinebench::tools

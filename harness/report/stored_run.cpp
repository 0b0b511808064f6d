// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/stored_run.h"

#include "core/files/files.h"
#include "core/files/json_depth.h"

namespace vinebench::harness {

std::optional<double> StoredRun::value(const std::string& pointer) const {
  const auto found = values.find(pointer);
  return found == values.end() ? std::nullopt : std::optional(found->second);
}

std::string StoredRun::hash() const {
  const auto found = json.find("hash");
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

NamedValues StoredRun::hash_environment() const {
  NamedValues environment;
  const auto found = json.find("hash_environment");
  if (found == json.end() || !found->is_object()) return environment;
  for (const auto& [name, value] : found->items()) {
    environment.emplace_back(name, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return environment;
}

std::optional<StoredRun> stored_run(Json metrics) {
  StoredRun run;
  try {
    metrics.at("scenario").get_to(run.scenario);
    if (!metrics.at("seed").is_number_integer()) return std::nullopt;
    metrics.at("seed").get_to(run.seed);
    if (metrics.contains("expectations")) run.checks = checks_of(metrics["expectations"]);
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  const Json numbers = metrics.flatten();
  for (const auto& [pointer, value] : numbers.items()) {
    if (value.is_number()) run.values[pointer] = value.get<double>();
  }
  if (!run.checks.empty()) run.values[kPassedKey] = all_hold(run.checks) ? 1 : 0;
  run.json = std::move(metrics);
  return run;
}

std::optional<StoredRun> read_stored_run(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return std::nullopt;
  const std::string text = read_file(file, FileKind::kJson);
  check_json_depth(text, file.string());
  return stored_run(Json::parse(text, nullptr, false));
}

}  // namespace vinebench::harness

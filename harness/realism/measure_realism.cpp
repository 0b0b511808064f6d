// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/measure_realism.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>

#include "core/config/yaml.h"
#include "core/files/files.h"
#include "core/files/output_folder.h"
#include "core/util/error.h"
#include "core/util/percentile.h"
#include "harness/experiment/randomisation.h"
#include "harness/experiment/scenario.h"
#include "sim/config_files.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kFreshDraws = 1000;  // the first one that a search has not tried

void tell(const RealismRequest& request, const std::string& line) {
  if (request.told) request.told(line);
}

/// A folder of pictures, or a file of numbers; none for another text.
std::optional<PictureSet> stored_set(const std::string& text, const RealismRequest& request,
                                     const Catalogue& catalogue, WorkerPool& pool) {
  std::error_code ignored;
  if (fs::is_directory(text, ignored)) {
    tell(request, fmt::format("measuring the pictures in {}", text));
    return measure_folder(text, request.width, pool);
  }
  if (!text.ends_with(".json")) return std::nullopt;
  return read_picture_set(catalogue.find(DataKind::kWorld, text));
}

PictureSet photographs_of(const RealismRequest& request, const Catalogue& catalogue,
                          WorkerPool& pool) {
  std::optional<PictureSet> set = stored_set(request.photographs, request, catalogue, pool);
  if (!set) {
    fail("{}: expected a folder of photographs, or a .json file that `realism --save` wrote",
         request.photographs);
  }
  return *std::move(set);
}

/// The name of a scenario, or a file that has a world.
bool is_scenario(const std::string& text, const Catalogue& catalogue) {
  const auto names = catalogue.list(DataKind::kScenario);
  if (std::ranges::any_of(names, [&](const DataEntry& e) { return e.name == text; })) return true;
  std::error_code ignored;
  if (!fs::is_regular_file(text, ignored)) return false;
  const std::string content = fmt::format("\n{}", read_file(text, FileKind::kYaml));
  return content.find("\nworld:") != std::string::npos ||
         content.find("\nbase:") != std::string::npos;
}

ViewsRequest views_of(const RealismRequest& request, int width) {
  ViewsRequest views;
  views.kind = request.view;
  views.count = request.images;
  views.width = width;
  views.seed = static_cast<std::uint64_t>(request.seed);
  return views;
}

ViewsRequest views_of(const std::string& subject, const RealismRequest& request, int width,
                      const Catalogue& catalogue) {
  ViewsRequest views = views_of(request, width);
  if (is_scenario(subject, catalogue)) {
    const fs::path file = catalogue.find(DataKind::kScenario, subject);
    const ScenarioConfig scenario = load_scenario(file, request.overrides);
    views.simulation = scenario.simulation;
    views.simulation.world.name = scenario.name;
  } else {
    views.simulation.world =
        sim::load_world(catalogue.find(DataKind::kWorld, subject).string(), request.overrides);
  }
  sim::choose_backend(views.simulation.renderer, request.machine.gl_platform);
  return views;
}

PictureSet set_of(const std::string& subject, const RealismRequest& request, int width,
                  const Catalogue& catalogue, WorkerPool& pool) {
  if (auto stored = stored_set(subject, request, catalogue, pool)) return *std::move(stored);
  const ViewsRequest views = views_of(subject, request, width, catalogue);
  tell(request, fmt::format("taking {} pictures of {}", views.count, views.simulation.world.name));
  const fs::path folder = request.out / views.simulation.world.name;
  create_inner_folder(folder);
  return measure_views(views, request.machine.plant_cache, pool, folder);
}

void write_json(const fs::path& file, const nlohmann::ordered_json& json) {
  write_file_atomically(file, json_text(json, 1) + "\n");
}

/// Pictures of draws of a randomisation.
class DrawnViews {
 public:
  DrawnViews(const RealismRequest& request, const Catalogue& catalogue, WorkerPool& pool, int width)
      : request_(request),
        scenario_(catalogue.find(DataKind::kScenario, request.ours.front())),
        pool_(pool),
        width_(width) {}

  PictureSet measure(const fs::path& randomisation, std::int64_t draw) const {
    const ScenarioConfig scenario =
        load_drawn_scenario(scenario_, request_.overrides, randomisation, draw);
    ViewsRequest views = views_of(request_, width_);
    views.simulation = scenario.simulation;
    views.count = request_.fit_images;
    views.seed = static_cast<std::uint64_t>(draw);
    sim::choose_backend(views.simulation.renderer, request_.machine.gl_platform);
    return measure_views(views, request_.machine.plant_cache, pool_);
  }

 private:
  const RealismRequest& request_;
  fs::path scenario_;
  WorkerPool& pool_;
  int width_;
};

}  // namespace

std::string measure_realism(const RealismRequest& request, const Catalogue& catalogue) {
  WorkerPool pool(request.threads);
  const FolderLock lock(request.out);
  const PictureSet real = photographs_of(request, catalogue, pool);
  if (!request.save.empty()) write_json(request.save, to_json(real));
  std::vector<RealismEntry> entries;
  std::string text;
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const std::string& subject : request.ours) {
    PictureSet ours = set_of(subject, request, real.width, catalogue, pool);
    entries.push_back({compare_pictures(real, ours), std::move(ours)});
    text += format_realism(entries.back().realism) + "\n";
    json.push_back(to_json(entries.back().realism));
  }
  write_json(request.out / "realism.json", json);
  write_file_atomically(request.out / "realism.html", realism_page(real, entries));
  return text;
}

std::string fit_realism(const RealismRequest& request, const Catalogue& catalogue) {
  if (request.ours.size() != 1 || !is_scenario(request.ours.front(), catalogue)) {
    fail("--fit: expected one scenario as --ours");
  }
  WorkerPool pool(request.threads);
  const FolderLock lock(request.out);
  const PictureSet real = photographs_of(request, catalogue, pool);
  const DrawnViews views(request, catalogue, pool, real.width);
  const RealismFit fit = search_settings(real, request.draws, [&](std::int64_t draw) {
    tell(request, fmt::format("draw {} of {}", draw, request.draws));
    return views.measure(request.fit, draw);
  });
  const fs::path fitted = request.out / "fitted.yaml";
  write_file_atomically(fitted, narrowed_randomisation(request.fit, fit.nearest));
  const auto median_of = [&](const fs::path& randomisation) {
    std::vector<double> distances;
    for (std::int64_t i = 0; i < std::max(8, request.draws / 4); ++i) {
      distances.push_back(
          distance_of(compare_pictures(real, views.measure(randomisation, kFreshDraws + i))));
    }
    return percentile(distances, 0.5);
  };
  tell(request, "measuring fresh draws");
  return fmt::format(
      "distance of the medians, in halves of the real 10 to 90 % range (median of fresh draws):\n"
      "  {:.3f} with {}\n  {:.3f} with {}\n",
      median_of(request.fit), request.fit.string(), median_of(fitted), fitted.string());
}

}  // namespace vinebench::harness

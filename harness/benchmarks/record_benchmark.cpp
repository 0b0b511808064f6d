// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/record_benchmark.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <system_error>

#include "core/util/error.h"
#include "harness/benchmarks/measurement.h"
#include "harness/datasets/dataset_writer.h"
#include "harness/datasets/formats.h"
#include "harness/run/lockstep.h"
#include "harness/run/prefetch.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kSecondsPerHour = 3600;

/// Every kind of label once, with its images.
const std::vector<std::string> kEveryLabel{"rgb",     "depth", "semantic",  "instances",
                                           "normals", "flow",  "disparity", "coco"};
const std::vector<std::string> kRgbOnly{"rgb"};
const std::vector<std::string> kTraining{"rgb", "depth", "semantic", "instances", "coco"};

/// What is timed.
struct Kind {
  std::string name;
  std::vector<std::string> formats;  ///< empty: nothing is recorded
  std::vector<std::string> cameras;  ///< all where empty
  bool slam = false;                 ///< as `run`, else as `record`
  std::string base;                  ///< the name of the same without recording, measured before
};

struct Measured {
  std::vector<Timing> timings;  ///< one for each round
  double megabytes = 0;
  std::int64_t images = 0;
};

/// Counts the delivered images.
class ImageCount : public Sink {
 public:
  void on_tick(const Sample& sample, const Estimate&) override {
    for (const cv::Mat& image : sample.frame.images) images_ += image.empty() ? 0 : 1;
  }
  std::int64_t images() const { return images_; }

 private:
  std::int64_t images_ = 0;
};

void drive(FrameSource& source, const std::vector<Sink*>& sinks) {
  while (const auto sample = source.next()) {
    for (Sink* sink : sinks) sink->on_tick(*sample, {});
  }
  for (Sink* sink : sinks) sink->on_finish({});
}

/// As run_scenario(), without evaluation.
void drive_and_estimate(const RecordBenchmark& benchmark, FrameSource& source,
                        const std::vector<Sink*>& sinks) {
  WorkerPool estimating(benchmark.threads);
  const auto slam = slam::make_slam(benchmark.scenario.slam, source.rig(),
                                    registered_tags(benchmark.scenario), estimating);
  Prefetch ahead(source);
  run_lockstep(ahead, *slam, sinks);
}

void measure_kind(const RecordBenchmark& benchmark, const Kind& kind, Measured& measured) {
  RecordOptions options;
  options.last = benchmark.frames - 1;
  options.threads = benchmark.threads;
  options.formats.clear();
  if (!kind.formats.empty()) options.formats = parse_formats(kind.formats);
  options.cameras = kind.cameras;
  const sim::SimulationConfig& simulation = benchmark.scenario.simulation;
  WorkerPool pool(benchmark.threads);
  const auto source = sim::make_simulation(
      simulation, static_cast<std::uint64_t>(benchmark.scenario.seed), benchmark.plant_cache, pool,
      plan_of(options, load_rig(simulation.rover.rig)));
  const fs::path folder = benchmark.folder / "recording";
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  ImageCount count;
  std::vector<Sink*> sinks{&count};
  std::optional<DatasetWriter> writer;
  if (!kind.formats.empty()) {
    writer.emplace(folder, notes_of(benchmark.scenario), *source, options, source->size());
    sinks.push_back(&*writer);
  }
  measured.timings.push_back(measure(
      [&] { kind.slam ? drive_and_estimate(benchmark, *source, sinks) : drive(*source, sinks); }));
  measured.images = count.images();
  if (writer) measured.megabytes = static_cast<double>(writer->bytes()) / 1e6;
  fs::remove_all(folder, ignored);
}

/// `base` is the same without recording.
Json row_of(const Measured& measured, const Measured& base) {
  const Timing timing = median(measured.timings);
  const double seconds = timing.wall_ms / 1e3;
  return {{"wall_s", rounded(seconds)},
          {"cpu_s", rounded(timing.cpu_ms / 1e3)},
          {"ratio", rounded(timing.wall_ms / median(base.timings).wall_ms)},
          {"megabytes", rounded(measured.megabytes)},
          {"images_per_hour",
           rounded(static_cast<double>(measured.images) / seconds * kSecondsPerHour)}};
}

std::vector<std::string> pair_cameras(const Rig& rig) {
  std::vector<std::string> names;
  for (const StereoPair& pair : rig.stereo_pairs) {
    for (const int camera : {pair.left, pair.right}) {
      names.push_back(rig.cameras[static_cast<std::size_t>(camera)].name);
    }
  }
  return names;
}

}  // namespace

Json measure_recording(const RecordBenchmark& benchmark) {
  const std::vector<std::string> pairs =
      pair_cameras(load_rig(benchmark.scenario.simulation.rover.rig));
  if (pairs.empty()) fail("bench record: the scenario's rig has no stereo pair");
  const std::string pairs_alone = "pairs";  // a base without a row
  const std::vector<Kind> kinds{{"record", {}, {}, false, "record"},
                                {"record rgb", kRgbOnly, {}, false, "record"},
                                {"record labels", kEveryLabel, {}, false, "record"},
                                {pairs_alone, {}, pairs, false, pairs_alone},
                                {"record training", kTraining, pairs, false, pairs_alone},
                                {"run", {}, {}, true, "run"},
                                {"run rgb", kRgbOnly, {}, true, "run"},
                                {"run labels", kEveryLabel, {}, true, "run"}};
  std::map<std::string, Measured> measured;
  Measured ignored;
  measure_kind(benchmark, kinds.front(), ignored);  // generates the plants and fills caches
  for (int round = 0; round < benchmark.rounds; ++round) {
    for (const Kind& kind : kinds) measure_kind(benchmark, kind, measured[kind.name]);
  }
  Json result{{"scenario", benchmark.scenario.name},
              {"frames", benchmark.frames},
              {"threads", benchmark.threads},
              {"rounds", benchmark.rounds}};
  for (const Kind& kind : kinds) {
    if (kind.name == pairs_alone) continue;
    result["rows"][kind.name] = row_of(measured[kind.name], measured[kind.base]);
  }
  return result;
}

std::string record_table(const Json& result) {
  std::string text =
      fmt::format("{}, {} frames, {} threads, {} {}\n{:<16} {:>8} {:>8} {:>7} {:>9} {:>13}\n",
                  result["scenario"].get<std::string>(), result["frames"].get<std::int64_t>(),
                  result["threads"].get<int>(), result["rounds"].get<int>(),
                  result["rounds"] == 1 ? "round" : "rounds", "", "wall s", "CPU s", "ratio", "MB",
                  "pictures/hour");
  for (const auto& [name, row] : result["rows"].items()) {
    text += fmt::format("{:<16} {:>8.2f} {:>8.2f} {:>7.2f} {:>9.1f} {:>13.0f}\n", name,
                        row["wall_s"].get<double>(), row["cpu_s"].get<double>(),
                        row["ratio"].get<double>(), row["megabytes"].get<double>(),
                        row["images_per_hour"].get<double>());
  }
  return text;
}

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/slam_benchmark.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "core/util/error.h"
#include "core/util/percentile.h"
#include "harness/benchmarks/measurement.h"
#include "slam/features/orb_extractor.h"
#include "slam/tags/tag_detector.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostImages = 40;  // for measuring ORB and tags, at most
constexpr std::size_t kQuarters = 4;

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Json spread(const std::vector<double>& values) {
  return {{"mean", rounded(mean(values))},
          {"p50", rounded(percentile(values, 0.5))},
          {"p95", rounded(percentile(values, 0.95))},
          {"max", rounded(std::ranges::max(values))}};
}

Json by_quarter(const std::vector<double>& values) {
  Json quarters = Json::array();
  const std::size_t size = values.size() / kQuarters;
  for (std::size_t q = 0; q < kQuarters && size > 0; ++q) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(q * size);
    quarters.push_back(rounded(mean({begin, begin + static_cast<std::ptrdiff_t>(size)})));
  }
  return quarters;
}

Json rounded_stages(const StageTimes& times) {
  Json stages = Json::object();
  for (const auto& [stage, samples] : times.samples()) {
    if (!samples.empty()) stages[stage] = spread(samples);
  }
  return stages;
}

/// One run over all frames with a subset of the cameras.
Json measure_cameras(const SlamBenchmark& benchmark, const std::string& name,
                     const std::vector<std::string>& cameras) {
  slam::SlamConfig config = benchmark.slam;
  config.cameras = cameras;
  reset_peak_memory();
  const double before = peak_memory_mib();
  WorkerPool pool(benchmark.threads);
  const auto slam = slam::make_slam(config, benchmark.rig, benchmark.tags, pool);
  std::vector<double> cpu;
  std::vector<double> wall;
  int tracked = 0;
  for (std::size_t i = 0; i < benchmark.frames.size(); ++i) {
    Estimate estimate;
    const Timing timing = measure([&] { estimate = slam->process(benchmark.frames[i]); });
    tracked += estimate.status == TrackingStatus::kTracking;
    if (i < static_cast<std::size_t>(benchmark.warm_up)) continue;
    cpu.push_back(timing.cpu_ms);
    wall.push_back(timing.wall_ms);
  }
  return {{"cameras", name},
          {"tracked", rounded(tracked / static_cast<double>(benchmark.frames.size()))},
          {"wall_ms", spread(wall)},
          {"cpu_ms", spread(cpu)},
          {"cpu_ms_by_quarter", by_quarter(cpu)},
          {"stages_ms", rounded_stages(slam->times())},
          {"memory_mib", rounded(peak_memory_mib() - before)}};
}

/// CPU time of work on single images of a camera, one thread.
Json measure_images(const SlamBenchmark& benchmark, int camera,
                    const std::function<void(const cv::Mat&)>& work) {
  std::vector<double> cpu;
  const std::size_t step = std::max<std::size_t>(1, benchmark.frames.size() / kMostImages);
  for (std::size_t i = 0; i < benchmark.frames.size(); i += step) {
    const cv::Mat& image = benchmark.frames[i].images[static_cast<std::size_t>(camera)];
    if (image.empty()) continue;
    if (cpu.empty()) work(image);  // once to fill caches
    cpu.push_back(measure([&] { work(image); }).cpu_ms);
  }
  return cpu.empty() ? Json() : spread(cpu);
}

std::string cpu_line(const char* what, const Json& figures) {
  if (figures.is_null()) return "";
  return fmt::format("  {:<28}{:>8.2f} ms of CPU an image, p95 {:.2f}\n", what,
                     figures["p50"].get<double>(), figures["p95"].get<double>());
}

std::string run_lines(const Json& run) {
  const auto of = [&](const char* figure, const char* which) {
    return run[figure][which].get<double>();
  };
  std::string text = fmt::format(
      "  {}: {:.0f} % tracked\n"
      "    wall a frame  {:8.2f} ms median, {:.2f} p95, {:.2f} at most\n"
      "    CPU a frame   {:8.2f} ms mean, {:.2f} median, {:.2f} p95\n"
      "    memory        {:8.1f} MiB\n",
      run["cameras"].get<std::string>(), 100 * run["tracked"].get<double>(), of("wall_ms", "p50"),
      of("wall_ms", "p95"), of("wall_ms", "max"), of("cpu_ms", "mean"), of("cpu_ms", "p50"),
      of("cpu_ms", "p95"), run["memory_mib"].get<double>());
  for (const auto& [stage, figures] : run["stages_ms"].items()) {
    text += fmt::format("    {:<20}{:8.2f} ms median, {:.2f} p95, {:.2f} at most\n", stage,
                        figures["p50"].get<double>(), figures["p95"].get<double>(),
                        figures["max"].get<double>());
  }
  return text;
}

}  // namespace

std::vector<Frame> preload(FrameSource& source, std::int64_t most) {
  std::vector<Frame> frames;
  while (static_cast<std::int64_t>(frames.size()) < most) {
    std::optional<Sample> sample = source.next();
    if (!sample) break;
    for (cv::Mat& image : sample->frame.images) {
      if (image.channels() == 1) continue;
      cv::Mat grey;
      cv::cvtColor(image, grey, cv::COLOR_RGB2GRAY);
      image = grey;
    }
    frames.push_back(std::move(sample->frame));
  }
  return frames;
}

Json measure_slam(const SlamBenchmark& benchmark) {
  if (static_cast<int>(benchmark.frames.size()) <= benchmark.warm_up) {
    fail("bench slam: expected more than {} frames to warm up with, found {}", benchmark.warm_up,
         benchmark.frames.size());
  }
  const Rig& rig = benchmark.rig;
  std::vector<std::string> pairs;
  for (const StereoPair& pair : rig.stereo_pairs) pairs.push_back(pair.name);
  Json result{{"name", benchmark.name},
              {"frames", benchmark.frames.size() - static_cast<std::size_t>(benchmark.warm_up)},
              {"threads", benchmark.threads},
              {"features", benchmark.slam.features.features}};
  result["runs"].push_back(measure_cameras(benchmark, "all cameras", benchmark.slam.cameras));
  if (!rig.tag_cameras.empty()) {
    result["runs"].push_back(measure_cameras(benchmark, "stereo pairs", pairs));
  }
  if (pairs.size() > 1) {
    result["runs"].push_back(measure_cameras(benchmark, pairs.front(), {pairs.front()}));
  }
  const slam::OrbExtractor extractor(benchmark.slam.features);
  result["orb_cpu_ms"] = measure_images(benchmark, rig.stereo_pairs.front().left,
                                        [&](const cv::Mat& image) { extractor.extract(image); });
  if (rig.tag_cameras.empty()) return result;
  const int camera = rig.tag_cameras.front();
  slam::TagDetector detector(benchmark.slam.tags, benchmark.tags);
  result["tags_cpu_ms"] = measure_images(benchmark, camera, [&](const cv::Mat& image) {
    detector.detect(image, rig.cameras[static_cast<std::size_t>(camera)].model, camera);
  });
  return result;
}

std::string slam_table(const Json& result) {
  std::string text =
      fmt::format("{}: {} frames, {} threads, {} features an image\n",
                  result["name"].get<std::string>(), result["frames"].get<std::size_t>(),
                  result["threads"].get<int>(), result["features"].get<int>());
  for (const Json& run : result["runs"]) text += run_lines(run);
  text += cpu_line("ORB extraction", result["orb_cpu_ms"]);
  if (result.contains("tags_cpu_ms")) text += cpu_line("tag search", result["tags_cpu_ms"]);
  return text;
}

}  // namespace vinebench::harness

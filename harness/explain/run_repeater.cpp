// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/run_repeater.h"

#include <fmt/format.h>

#include <filesystem>
#include <numeric>

#include "core/util/error.h"
#include "harness/explain/child_drive.h"
#include "harness/sets/child_process.h"
#include "sim/render/gl/platform/gl_context.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

std::ptrdiff_t threads_of_this_process() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"),
                       std::filesystem::directory_iterator());
}

/// Whether this process may draw and then be forked: it has one thread, and would have one.
bool can_draw_and_fork(const sim::RendererConfig& renderer) {
  if (threads_of_this_process() != 1 || !sim::draws_in_calling_thread(renderer)) return false;
  if (renderer.engine != sim::RenderEngineKind::kGl) return true;
  return run_in_child("drawing", [&] {
           sim::gl_version(renderer.backend);
           return std::to_string(threads_of_this_process());
         }) == "1";
}

}  // namespace

RunRepeater::RunRepeater(const ExplainRequest& request, std::int64_t splice, std::int64_t last)
    : request_(request),
      last_(last),
      known_(request.live_poses, request.differences),
      original_{request.scenario},
      drive_(draw(splice - 1)),
      slam_(slam::make_slam(request.scenario.slam, told_rig(original_),
                            registered_tags(request.scenario), pool_)) {}

RunRepeater::~RunRepeater() = default;

std::unique_ptr<FrameSource> RunRepeater::draw(std::int64_t last) {
  const sim::SimulationConfig& config = request_.scenario.simulation;
  const auto drive = [this, last](WorkerPool& pool) {
    return std::make_unique<VariantDrive>(original_, Splice{}, last, request_.machine, pool,
                                          drawn_);
  };
  if (can_draw_and_fork(config.renderer)) {
    const auto seed = static_cast<std::uint64_t>(request_.scenario.seed);
    drawn_ = std::make_shared<sim::DrawnScene>(config, seed, request_.machine.plant_cache, 1);
    return drive(pool_);
  }
  if (last < 0) return nullptr;
  const auto in_child = [this, drive] {
    drawing_ = std::make_unique<WorkerPool>(1);
    return drive(*drawing_);
  };
  return std::make_unique<ChildDrive>(in_child, told_rig(original_));
}

void RunRepeater::advance_to(std::int64_t frame) {
  while (next_ < frame) advance();
}

void RunRepeater::advance() {
  const std::optional<Sample> sample = drive_->next();
  if (!sample) fail("the drive ends before frame {}", next_);
  if (!sample->truth.path.empty()) splice_.path_end = sample->truth.path.back();
  splice_.before = sample->frame.stamp;
  splice_.first = ++next_;
  past_.push_back(step_of(*sample, slam_->process(sample->frame)));
  known_.check(past_.back());
}

Rerun RunRepeater::rerun(const Job& job, std::int64_t last) const {
  if (job.from_start) {
    return run_variant(job.variant, {}, last_, request_.machine, {.drawn = drawn_});
  }
  return run_variant(job.variant, splice_, last, request_.machine,
                     {.drawn = drawn_, .slam = slam_.get()});
}

std::vector<Rerun> RunRepeater::make(std::vector<Job>& jobs, std::int64_t last) {
  std::vector<Rerun> reruns(jobs.size());
  std::vector<std::size_t> open(jobs.size());
  std::iota(open.begin(), open.end(), 0);
  while (!open.empty()) {
    std::erase_if(open, [&](std::size_t i) {
      const auto known = from_start_.find(jobs[i].name);
      if (known == from_start_.end()) return false;
      jobs[i].from_start = true;
      reruns[i] = known->second;
      return true;
    });
    make_once(jobs, open, last, reruns);
    std::erase_if(open, [&](std::size_t i) {
      if (jobs[i].from_start) from_start_[jobs[i].name] = reruns[i];
      return reruns[i].same_drive;
    });
    for (const std::size_t i : open) jobs[i].from_start = true;
  }
  return reruns;
}

void RunRepeater::make_once(const std::vector<Job>& jobs, const std::vector<std::size_t>& open,
                            std::int64_t last, std::vector<Rerun>& reruns) {
  std::string failure;
  run_in_children({.count = open.size(),
                   .at_once = request_.at_once,
                   .name = [&](std::size_t i) { return "rerun " + jobs[open[i]].name; },
                   .job = [&](std::size_t i) { return pack_rerun(rerun(jobs[open[i]], last)); },
                   .done =
                       [&](std::size_t i, const ChildOutcome& outcome) {
                         if (!outcome.ok) {
                           failure = fmt::format("{}: {}", jobs[open[i]].name, outcome.text);
                           return;
                         }
                         reruns[open[i]] = unpack_rerun(outcome.text);
                         note(jobs[open[i]], reruns[open[i]]);
                       },
                   .stopped = [&] { return !failure.empty(); }});
  if (!failure.empty()) fail("{}", failure);
}

void RunRepeater::note(const Job& job, const Rerun& rerun) {
  ++reruns_;
  seconds_ += rerun.seconds;
  if (request_.progress == nullptr) return;
  *request_.progress << fmt::format("{}: {:.1f} s of processor time\n", job.name, rerun.seconds)
                     << std::flush;
}

StretchDrift RunRepeater::drift(const Rerun& rerun, const Stretch& stretch,
                                std::int64_t aligned) const {
  std::vector<Step> steps = rerun.steps;
  if (!steps.empty() && steps.front().index == next_ && !past_.empty()) {
    steps.insert(steps.begin(), past_.back());
  }
  return drift_of(steps, stretch, aligned);
}

}  // namespace vinebench::harness

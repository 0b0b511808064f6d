// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/explain/explain_request.h"
#include "harness/explain/repeated_run.h"
#include "harness/explain/rerun.h"

namespace vinebench::harness {

/// A rerun to make: without some factors, or with a placebo.
struct Job {
  std::string name;
  Variant variant;
  std::vector<std::size_t> factors{};
  bool from_start = false;  ///< else from the splice on
};

/// Repeats a run up to a frame, and from there on variants of it, in forked processes.
class RunRepeater {
 public:
  /// The frames up to that of index `splice` - 1 will be repeated as they were, those from the
  /// start on up to `last`. The request must outlive this. Draws in this process, and keeps the
  /// scene for the reruns, where it may be forked all the same; else in another one.
  RunRepeater(const ExplainRequest& request, std::int64_t splice, std::int64_t last);
  ~RunRepeater();

  /// Repeats the run up to the frame before this one. Throws Error if its poses are others.
  void advance_to(std::int64_t frame);
  std::int64_t next() const { return next_; }  ///< index of the next frame

  /// Makes the reruns, up to the frame of index `last`. Those whose drive turns out to be another
  /// one, which is then noted in the job, are made again from the start. Throws Error if one fails.
  std::vector<Rerun> make(std::vector<Job>& jobs, std::int64_t last);

  /// With the frame that it is aligned at, which is of the past unless the rerun has one of its
  /// own.
  StretchDrift drift(const Rerun& rerun, const Stretch& stretch, std::int64_t aligned) const;

  const Variant& original() const { return original_; }
  const KnownPoses& known() const { return known_; }
  int reruns() const { return reruns_; }
  double seconds() const { return seconds_; }  ///< processor time of all of them

 private:
  std::unique_ptr<FrameSource> draw(std::int64_t last);
  void advance();
  Rerun rerun(const Job& job, std::int64_t last) const;
  void make_once(const std::vector<Job>& jobs, const std::vector<std::size_t>& open,
                 std::int64_t last, std::vector<Rerun>& reruns);
  void note(const Job& job, const Rerun& rerun);

  const ExplainRequest& request_;
  std::int64_t last_;
  KnownPoses known_;
  Variant original_;
  WorkerPool pool_{1};
  std::unique_ptr<WorkerPool> drawing_;  ///< in the drive's process
  std::shared_ptr<sim::DrawnScene> drawn_;
  std::unique_ptr<FrameSource> drive_;
  std::unique_ptr<slam::MappingSystem> slam_;
  std::int64_t next_ = 0;
  Splice splice_;
  std::vector<Step> past_;
  std::map<std::string, Rerun> from_start_;  ///< by the jobs' names
  int reruns_ = 0;
  double seconds_ = 0;
};

}  // namespace vinebench::harness

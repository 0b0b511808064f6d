// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace vinebench {

/// Wall-clock times by stage, milliseconds. Reported beside the results, never part of them.
class StageTimes {
 public:
  void add(const std::string& stage, double milliseconds) {
    samples_[stage].push_back(milliseconds);
  }
  void merge(const StageTimes& other) {
    for (const auto& [stage, samples] : other.samples_) {
      auto& mine = samples_[stage];
      mine.insert(mine.end(), samples.begin(), samples.end());
    }
  }
  const std::map<std::string, std::vector<double>>& samples() const { return samples_; }

 private:
  std::map<std::string, std::vector<double>> samples_;
};

/// Adds the time from its construction to its destruction to a stage.
class ScopedTimer {
 public:
  ScopedTimer(StageTimes& times, std::string stage)
      : times_(times), stage_(std::move(stage)), start_(std::chrono::steady_clock::now()) {}
  ScopedTimer(const ScopedTimer&) = delete;
  ScopedTimer& operator=(const ScopedTimer&) = delete;
  ~ScopedTimer() {
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start_;
    times_.add(stage_, elapsed.count());
  }

 private:
  StageTimes& times_;
  std::string stage_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace vinebench

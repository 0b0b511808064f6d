// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/dataset_encoder.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <numeric>
#include <utility>

#include "core/files/files.h"
#include "core/files/output_file.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kWaitingFrames = 2;

/// Groups tasks with the same bytes, in the order of the first of each.
std::vector<std::vector<FileTask>> grouped(std::vector<FileTask> tasks) {
  std::vector<std::vector<FileTask>> groups;
  std::map<std::string, std::size_t> group_of;
  for (FileTask& task : tasks) {
    const auto [place, first] = group_of.try_emplace(task.key, groups.size());
    if (first) groups.emplace_back();
    groups[place->second].push_back(std::move(task));
  }
  return groups;
}

/// Hands the bytes to all of the group, whose files are one on the disk where it has hard links.
/// How often it has the bytes.
std::size_t put(const std::vector<FileTask>& group, const std::string& bytes) {
  std::size_t copies = 0;
  const fs::path* written = nullptr;
  for (const FileTask& task : group) {
    if (!task.take && written != nullptr && link_file(*written, task.file)) continue;
    ++copies;
    if (task.take) {
      task.take(bytes);
      continue;
    }
    write_file_atomically(task.file, bytes);
    written = &task.file;
  }
  return copies;
}

}  // namespace

DatasetFrame own_frame(const Sample& sample, std::int64_t number) {
  DatasetFrame frame{number, sample.frame, sample.truth};
  for (cv::Mat& image : frame.frame.images) image = image.clone();
  return frame;
}

DatasetEncoder::DatasetEncoder(Writers writers, int threads, const fs::path& root,
                               FileManifest* manifest)
    : writers_(std::move(writers)),
      pool_(threads),
      root_(root),
      manifest_(manifest),
      worker_(kWaitingFrames) {}

void DatasetEncoder::submit(DatasetFrame frame) {
  worker_.submit(
      [this, shared = std::make_shared<const DatasetFrame>(std::move(frame))] { write(shared); });
}

/// Files before lists, so that listed files exist.
void DatasetEncoder::write(const std::shared_ptr<const DatasetFrame>& frame) {
  std::vector<FileTask> tasks;
  for (const auto& writer : writers_) {
    for (FileTask& task : writer->files(frame)) tasks.push_back(std::move(task));
  }
  const auto groups = grouped(std::move(tasks));
  const std::vector<std::size_t> order = longest_first(groups);
  std::vector<std::string> hashes(groups.size());
  std::vector<double> seconds(groups.size());
  pool_.for_each(groups.size(), [&](std::size_t place) {
    const std::size_t i = order[place];
    const auto start = std::chrono::steady_clock::now();
    const std::string bytes = groups[i].front().bytes();
    if (manifest_ != nullptr) hashes[i] = xxh128(bytes);
    bytes_ += bytes.size() * put(groups[i], bytes);
    seconds[i] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  });
  for (std::size_t i = 0; i < groups.size(); ++i) seconds_[groups[i].front().key] = seconds[i];
  for (const auto& writer : writers_) writer->commit(*frame);
  if (manifest_ == nullptr) return;
  std::vector<ListedFile> listed;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const FileTask& task : groups[i]) {
      if (task.take) continue;
      listed.push_back({task.file.lexically_relative(root_).string(), hashes[i]});
    }
  }
  manifest_->add(listed);
}

/// Longest tasks first, by the times of the previous frame.
std::vector<std::size_t> DatasetEncoder::longest_first(const std::vector<TaskGroup>& groups) const {
  std::vector<std::size_t> order(groups.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) {
    const auto known = seconds_.find(groups[i].front().key);
    return known == seconds_.end() ? 0.0 : known->second;
  });
  return order;
}

void DatasetEncoder::finish() {
  worker_.wait();
  for (const auto& writer : writers_) writer->finish();
}

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "scenarios/dataset_encoder.h"

#include <map>
#include <utility>

#include "slam/base/files.h"

namespace vinebench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kWaitingFrames = 2;

/// Tasks of the same bytes, in the order of the first of each.
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

}  // namespace

DatasetFrame own_frame(const Sample& sample, std::int64_t number) {
  DatasetFrame frame{number, sample.frame, sample.truth};
  for (cv::Mat& image : frame.frame.images) image = image.clone();
  return frame;
}

DatasetEncoder::DatasetEncoder(Formats formats, int threads, const fs::path& root,
                               FileManifest* manifest)
    : formats_(std::move(formats)),
      pool_(threads),
      root_(root),
      manifest_(manifest),
      worker_(kWaitingFrames) {}

void DatasetEncoder::submit(DatasetFrame frame) {
  worker_.submit(
      [this, shared = std::make_shared<const DatasetFrame>(std::move(frame))] { write(shared); });
}

/// Files first: what is in the lists is on the disk.
void DatasetEncoder::write(const std::shared_ptr<const DatasetFrame>& frame) {
  std::vector<FileTask> tasks;
  for (const auto& format : formats_) {
    for (FileTask& task : format->files(frame)) tasks.push_back(std::move(task));
  }
  const auto groups = grouped(std::move(tasks));
  std::vector<std::string> hashes(groups.size());
  pool_.for_each(groups.size(), [&](std::size_t i) {
    const std::string bytes = groups[i].front().bytes();
    if (manifest_ != nullptr) hashes[i] = xxh128(bytes);
    for (const FileTask& task : groups[i]) {
      task.take ? task.take(bytes) : write_file_atomically(task.file, bytes);
    }
    bytes_ += bytes.size() * groups[i].size();
  });
  for (const auto& format : formats_) format->commit(*frame);
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

void DatasetEncoder::finish() {
  worker_.wait();
  for (const auto& format : formats_) format->finish();
}

}  // namespace vinebench

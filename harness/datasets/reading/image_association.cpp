// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/image_association.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace vinebench::harness {
namespace {

void add_events(RecordedFrame& frame, const SourceEvent& event, int count) {
  for (int i = 0; i < count; ++i) frame.events.push_back(event);
}

void note_faults(const ImageList& list, RecordedFrame& first) {
  add_events(first, {"stamp_out_of_order", list.camera, "sorted"}, list.out_of_order);
  add_events(first, {"stamp_repeated", list.camera, "dropped"}, list.repeated);
}

/// Frames missing in the first camera are reported at the frame after them.
void note_gaps(Stamp period, const std::string& camera, std::vector<RecordedFrame>& frames) {
  for (std::size_t i = 1; i < frames.size() && period > 0; ++i) {
    const Stamp step = frames[i].stamp - frames[i - 1].stamp;
    const auto missing =
        static_cast<int>(std::llround(static_cast<double>(step) / static_cast<double>(period)) - 1);
    if (missing < 1) continue;
    const std::string detail =
        fmt::format("about {} frames missing before this one: {:.3f} s", missing, to_seconds(step));
    frames[i].events.push_back({"frames_missing", camera, detail});
  }
}

/// Index of the frame nearest in time.
std::size_t nearest_frame(const std::vector<RecordedFrame>& frames, Stamp stamp) {
  const auto after = std::ranges::lower_bound(frames, stamp, {}, &RecordedFrame::stamp);
  const auto index = static_cast<std::size_t>(after - frames.begin());
  if (index == frames.size()) return index - 1;
  if (index == 0) return 0;
  return stamp - frames[index - 1].stamp <= frames[index].stamp - stamp ? index - 1 : index;
}

/// The image of a camera is of that instant.
void set_stamp(RecordedFrame& frame, std::size_t camera, Stamp stamp) {
  std::vector<Stamp>& stamps = frame.image_stamps;
  if (stamps.empty() && stamp == frame.stamp) return;
  if (stamps.empty()) stamps.assign(frame.images.size(), frame.stamp);
  stamps[camera] = stamp;
}

/// Each image goes to its nearest frame; each frame keeps the nearest of its images.
void associate(const ImageList& list, std::size_t camera, Stamp half,
               std::vector<RecordedFrame>& frames) {
  std::vector<Stamp> off(frames.size(), half + 1);
  int differ = 0;
  Stamp most = 0;
  for (const ImageList::Entry& entry : list.entries) {
    const std::size_t index = nearest_frame(frames, entry.stamp);
    RecordedFrame& frame = frames[index];
    const Stamp distance = std::abs(entry.stamp - frame.stamp);
    const bool taken = distance < off[index];
    const bool replaces = taken && !frame.images[camera].empty();
    if (taken) {
      off[index] = distance;
      frame.images[camera] = entry.file;
      set_stamp(frame, camera, entry.stamp);
    }
    if (!taken || replaces) {
      const std::string detail = fmt::format("stamp {}", format_seconds(entry.stamp));
      frame.events.push_back({"picture_unmatched", list.camera, detail});
    }
  }
  for (const Stamp distance : off) {
    if (distance == 0 || distance > half) continue;
    ++differ;
    most = std::max(most, distance);
  }
  if (differ == 0) return;
  frames.front().events.push_back(
      {"stamps_differ", list.camera,
       fmt::format("in {} frames, by {:.3f} ms at most", differ, 1e3 * to_seconds(most))});
}

}  // namespace

void put_in_order(ImageList& list) {
  std::vector<ImageList::Entry>& entries = list.entries;
  Stamp latest = entries.empty() ? 0 : entries.front().stamp;
  for (const ImageList::Entry& entry : entries) {
    if (entry.stamp < latest) ++list.out_of_order;
    latest = std::max(latest, entry.stamp);
  }
  std::ranges::stable_sort(entries, {}, &ImageList::Entry::stamp);
  const auto repeated =
      std::unique(entries.begin(), entries.end(),
                  [](const auto& a, const auto& b) { return a.stamp == b.stamp; });
  list.repeated = static_cast<int>(entries.end() - repeated);
  entries.erase(repeated, entries.end());
}

std::vector<Stamp> instants_of(const ImageList& list) {
  std::vector<Stamp> instants;
  for (const ImageList::Entry& entry : list.entries) instants.push_back(entry.stamp);
  return instants;
}

Stamp median_period(const std::vector<Stamp>& instants) {
  std::vector<Stamp> steps;
  for (std::size_t i = 1; i < instants.size(); ++i) steps.push_back(instants[i] - instants[i - 1]);
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  return *middle;
}

std::vector<RecordedFrame> associate_images(const std::vector<ImageList>& lists,
                                            const std::vector<Stamp>& instants) {
  std::vector<RecordedFrame> frames;
  for (const Stamp stamp : instants) {
    frames.push_back({stamp, std::vector<std::filesystem::path>(lists.size()), {}});
  }
  if (frames.empty()) return frames;
  const Stamp period = median_period(instants);
  note_gaps(period, lists.front().camera, frames);
  for (std::size_t camera = 0; camera < lists.size(); ++camera) {
    note_faults(lists[camera], frames.front());
    associate(lists[camera], camera, period / 2, frames);
  }
  return frames;
}

}  // namespace vinebench::harness

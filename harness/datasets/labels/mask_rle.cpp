// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/labels/mask_rle.h"

#include <algorithm>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr int kGroupBits = 5;
constexpr int kMore = 0x20;
constexpr int kSign = 0x10;
constexpr char kZero = '0';

void append_number(std::string& text, std::int64_t value) {
  bool more = true;
  while (more) {
    int group = static_cast<int>(value & (kMore - 1));
    value >>= kGroupBits;
    more = (group & kSign) != 0 ? value != -1 : value != 0;
    if (more) group |= kMore;
    text += static_cast<char>(kZero + group);
  }
}

/// Throws where the text ends within a number.
std::int64_t take_number(const std::string& text, std::size_t& at) {
  std::int64_t value = 0;
  for (int shift = 0;; shift += kGroupBits) {
    const int group = at < text.size() ? text[at++] - kZero : -1;
    if (group < 0 || group >= 2 * kMore || shift > 50) fail("run lengths: not compressed counts");
    value |= static_cast<std::int64_t>(group & (kMore - 1)) << shift;
    if ((group & kMore) != 0) continue;
    if ((group & kSign) != 0) value |= -(std::int64_t{1} << (shift + kGroupBits));
    return value;
  }
}

}  // namespace

Runs united(std::vector<Runs> masks) {
  Runs all;
  for (const Runs& runs : masks) all.insert(all.end(), runs.begin(), runs.end());
  std::ranges::sort(all, {}, &Run::begin);
  Runs merged;
  for (const Run& run : all) {
    if (!merged.empty() && merged.back().end == run.begin) {
      merged.back().end = run.end;
    } else {
      merged.push_back(run);
    }
  }
  return merged;
}

std::int64_t area_of(const Runs& runs) {
  std::int64_t area = 0;
  for (const Run& run : runs) area += run.end - run.begin;
  return area;
}

cv::Rect box_of(const Runs& runs, int height) {
  if (runs.empty()) return {};
  int top = height;
  int bottom = -1;
  for (const Run& run : runs) {
    const bool one_column = run.begin / height == (run.end - 1) / height;
    top = std::min(top, one_column ? static_cast<int>(run.begin % height) : 0);
    bottom = std::max(bottom, one_column ? static_cast<int>((run.end - 1) % height) : height - 1);
  }
  const auto left = static_cast<int>(runs.front().begin / height);
  const auto right = static_cast<int>((runs.back().end - 1) / height);
  return {left, top, right - left + 1, bottom - top + 1};
}

std::string compress(const Runs& runs, std::int64_t pixels) {
  std::vector<std::int64_t> counts;
  std::int64_t at = 0;
  for (const Run& run : runs) {
    counts.push_back(run.begin - at);
    counts.push_back(run.end - run.begin);
    at = run.end;
  }
  if (at < pixels || counts.empty()) counts.push_back(pixels - at);
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    append_number(text, i > 2 ? counts[i] - counts[i - 2] : counts[i]);
  }
  return text;
}

Runs decompress(const std::string& text, std::int64_t pixels) {
  std::vector<std::int64_t> counts;
  for (std::size_t at = 0; at < text.size();) {
    std::int64_t count = take_number(text, at);
    if (counts.size() > 2) count += counts[counts.size() - 2];
    if (count < 0 || count > pixels) {
      fail("run lengths: expected counts from 0 to {}, found {}", pixels, count);
    }
    counts.push_back(count);
  }
  Runs runs;
  std::int64_t at = 0;
  for (std::size_t i = 0; i < counts.size(); at += counts[i++]) {
    if (i % 2 == 1 && counts[i] > 0) runs.push_back({at, at + counts[i]});
  }
  if (at != pixels) fail("run lengths: counts of {} pixels, expected {}", at, pixels);
  return runs;
}

cv::Mat mask_of(const Runs& runs, const cv::Size& size) {
  cv::Mat mask(size, CV_8UC1, cv::Scalar(0));
  for (const Run& run : runs) {
    for (std::int64_t i = run.begin; i < run.end; ++i) {
      mask.at<std::uint8_t>(static_cast<int>(i % size.height), static_cast<int>(i / size.height)) =
          255;
    }
  }
  return mask;
}

}  // namespace vinebench::harness

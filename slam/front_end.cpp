// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/front_end.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/util/error.h"
#include "slam/camera/rectification.h"

namespace vinebench::slam {
namespace {

/// Structure runs along one diagonal on the left of an image and along the other on the right, so
/// that rows that are off stretch disparities. Where self-calibration finds what is wrong with the
/// columns, rows are put straight that are off by little. Of one pair alone it does not, and what
/// is off at the image's edge alone (distortion) is better left there.
constexpr RowTolerance kRowsOfSeveralPairs{0.1, 0.1};
constexpr RowTolerance kRowsOfOnePair{0.5, std::numeric_limits<double>::infinity()};

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace

FrontEnd::FrontEnd(const FrontEndSettings& settings, const StereoRig& rig,
                   const std::vector<RegisteredTag>& tags, WorkerPool& pool)
    : rig_(rig), stereo_(settings.stereo), extractor_(settings.features), pool_(pool) {
  if (settings.wheels) odometry_.emplace(*settings.wheels);
  for (std::size_t i = 0; i < rig_.tag_cameras.size(); ++i) {
    detectors_.emplace_back(settings.tags, tags);
  }
  left_.resize(rig_.pairs.size());
  right_.resize(rig_.pairs.size());
  right_images_.resize(rig_.pairs.size());
  balances_.resize(rig_.pairs.size());
  const RowTolerance tolerance = rig_.pairs.size() == 1 ? kRowsOfOnePair : kRowsOfSeveralPairs;
  for (const RectifiedPair& pair : rig_.pairs) alignments_.emplace_back(pair.lens, tolerance);
  sightings_.resize(rig_.tag_cameras.size());
}

cv::Mat FrontEnd::grey(const Frame& frame, int camera) const {
  const RigCamera& expected = rig_.cameras[static_cast<std::size_t>(camera)];
  if (frame.images.size() != rig_.cameras.size()) {
    fail("frame {}: expected {} images, one a camera of the rig, found {}", frame.index,
         rig_.cameras.size(), frame.images.size());
  }
  if (!frame.image_stamps.empty() && frame.image_stamps.size() != frame.images.size()) {
    fail("frame {}: expected {} stamps of images, found {}", frame.index, frame.images.size(),
         frame.image_stamps.size());
  }
  const cv::Mat& image = frame.images[static_cast<std::size_t>(camera)];
  if (image.empty()) return image;
  if (image.cols != expected.model.width || image.rows != expected.model.height) {
    fail("frame {}: camera '{}': expected an image of {} x {}, found {} x {}", frame.index,
         expected.name, expected.model.width, expected.model.height, image.cols, image.rows);
  }
  if (image.type() == CV_8UC1) return image;
  if (image.type() != CV_8UC3) {
    fail("frame {}: camera '{}': expected an 8-bit grey or RGB image", frame.index, expected.name);
  }
  cv::Mat converted;
  cv::cvtColor(image, converted, cv::COLOR_RGB2GRAY);
  return converted;
}

Extraction FrontEnd::extract_right(std::size_t p, double gain) const {
  const cv::Mat& image = right_images_[p];
  if (image.empty()) return {};
  if (stereo_.search == StereoSearch::kFeatures) return extractor_.extract(image);
  return {{}, extractor_.pyramid(EyeBalance::balanced(alignments_[p].aligned(image), gain))};
}

void FrontEnd::extract(const Frame& frame, StageTimes& times) {
  // The tag camera's large image first: it takes longest.
  const std::size_t tag_jobs = rig_.tag_cameras.size();
  std::vector<double> spent(tag_jobs + rig_.pairs.size());
  pool_.for_each(spent.size(), [&](std::size_t job) {
    const auto start = std::chrono::steady_clock::now();
    if (job < tag_jobs) {
      const int camera = rig_.tag_cameras[job];
      const cv::Mat image = grey(frame, camera);
      sightings_[job].clear();
      if (!image.empty()) {
        sightings_[job] = detectors_[job].detect(
            image, rig_.cameras[static_cast<std::size_t>(camera)].model, camera);
      }
    } else {
      const std::size_t p = job - tag_jobs;
      const Rectification* const rectify = rig_.pairs[p].rectification.get();
      cv::Mat left = grey(frame, rig_.pairs[p].left_camera);
      cv::Mat right = grey(frame, rig_.pairs[p].right_camera);
      if (rectify != nullptr && !left.empty()) left = rectify->left(left);
      if (rectify != nullptr && !right.empty()) right = rectify->right(right);
      left_[p] = left.empty() ? Extraction{} : extractor_.extract(left);
      if (rectify != nullptr) rectify->drop_unseen(left_[p].features, extractor_);
      right_images_[p] = right;
      right_[p] = extract_right(p, balances_[p].gain());
    }
    spent[job] = milliseconds_since(start);
  });
  double tags = 0;
  double features = 0;
  for (std::size_t job = 0; job < spent.size(); ++job) {
    (job < tag_jobs ? tags : features) += spent[job];
  }
  times.add("features", features);
  if (tag_jobs > 0) times.add("tags", tags);
}

std::vector<StereoMatch> FrontEnd::match_pair(std::size_t p) {
  const Extraction& left = left_[p];
  const RectifiedPair& pair = rig_.pairs[p];
  const auto search = [&](const Extraction& of_left, const Extraction& of_right) {
    return match_stereo(of_left, of_right, pair.lens, pair.baseline, extractor_, stereo_);
  };
  std::vector<StereoMatch> matches = search(left, right_[p]);
  if (stereo_.search == StereoSearch::kFeatures) return matches;  // looks on the rows about, too
  if (alignments_[p].search_shift(left, right_[p].pyramid, matches, search)) {
    right_[p] = extract_right(p, balances_[p].gain());
    matches = search(left, right_[p]);
  }
  EyeBalance& balance = balances_[p];
  if (const auto gain = balance.suspect(left.pyramid.front(), right_images_[p], matches)) {
    Extraction right = extract_right(p, *gain);
    std::vector<StereoMatch> with_gain = search(left, right);
    if (balance.believe(*gain, matches, with_gain)) {
      matches = std::move(with_gain);
      right_[p] = std::move(right);
    }
  }
  balance.measure(left, right_[p].pyramid, matches, extractor_);
  alignments_[p].measure(left, right_[p].pyramid, matches, extractor_);
  if (count_found(matches) < static_cast<std::size_t>(stereo_.few)) {
    StereoConfig config = stereo_;
    config.max_residual = std::max(config.max_residual, config.dirty_residual);
    std::vector<StereoMatch> looser =
        match_stereo(left, right_[p], pair.lens, pair.baseline, extractor_, config);
    if (is_dirty(matches, looser, stereo_)) matches = std::move(looser);
  }
  return matches;
}

void FrontEnd::match(FrameFeatures& features, StageTimes& times) {
  std::vector<double> spent(rig_.pairs.size());
  pool_.for_each(rig_.pairs.size(), [&](std::size_t p) {
    const auto start = std::chrono::steady_clock::now();
    Extraction& left = left_[p];
    StereoView& view = features.views[p];
    const RectifiedPair& pair = rig_.pairs[p];
    view.stereo.assign(left.features.size(), StereoMatch{});
    if (!left.pyramid.empty() && !right_[p].pyramid.empty()) {
      view.stereo = match_pair(p);
    }
    view.features = std::move(left.features);
    features.pyramids[p] = std::move(left.pyramid);
    features.right_pyramids[p] = std::move(right_[p].pyramid);
    view.grid = FeatureGrid(view.features.keypoints, pair.lens.width, pair.lens.height);
    spent[p] = milliseconds_since(start);
  });
  double total = 0;
  for (const double one : spent) total += one;
  times.add("stereo", total);
}

std::shared_ptr<FrameFeatures> FrontEnd::process(const Frame& frame, StageTimes& times) {
  auto features = std::make_shared<FrameFeatures>();
  features->index = frame.index;
  features->stamp = frame.stamp;
  features->views.resize(rig_.pairs.size());
  features->pyramids.resize(rig_.pairs.size());
  features->right_pyramids.resize(rig_.pairs.size());
  if (odometry_) features->wheels = odometry_->step(frame.wheels);
  features->imu = frame.imu;
  const auto late = [&frame](int camera) {
    return to_seconds(frame.image_stamp(static_cast<std::size_t>(camera)) - frame.stamp);
  };
  for (std::size_t p = 0; p < rig_.pairs.size(); ++p) {
    features->views[p].late = late(rig_.pairs[p].left_camera);
  }
  extract(frame, times);
  match(*features, times);
  for (const std::vector<TagSighting>& seen : sightings_) {
    for (const TagSighting& sighting : seen) {
      features->tags.push_back(sighting);
      features->tags.back().late = late(sighting.camera);
    }
  }
  return features;
}

}  // namespace vinebench::slam

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/diagnosis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/util/percentile.h"
#include "harness/judge/degraded_segments.h"
#include "harness/judge/image_conditions.h"

namespace vinebench::harness {
namespace {

constexpr double kShown = 1.0 / 3;         // of a segment's ticks, for a cause to be named
constexpr double kOccluded = 0.5;          // of an image's pixels
constexpr double kClearView = 0.2;         // likewise, at most
constexpr double kSeenMoving = 0.05;       // likewise, at least
constexpr double kFewOfUsual = 0.4;        // of a camera's median of features
constexpr double kFewFeatures = 100;       // absolute minimum
constexpr double kHealthyInliers = 0.5;    // of the run's median
constexpr double kSpacingTolerance = 0.2;  // of the plants' spacing

/// Which causes are present in the ticks of a segment.
class CauseFinder {
 public:
  CauseFinder(const RunRecord& record, const RunResults& results, const Trial& trial)
      : record_(record), results_(results), trial_(trial), images_(record, trial.site) {
    for (const StereoPair& pair : record.rig.stereo_pairs) {
      cameras_.push_back(static_cast<std::size_t>(pair.left));
    }
    for (std::size_t i = 0; i < record.rig.cameras.size(); ++i) {
      if (record.rig.stereo_pairs.empty()) cameras_.push_back(i);
      usual_features_.push_back(median_features(i));
    }
    reads_tags_ = std::ranges::any_of(record.ticks,
                                      [](const Tick& tick) { return !tick.estimate.tags.empty(); });
  }

  std::vector<DegradedSegment> causes_of(const DegradedSegment& segment) const {
    std::vector<DegradedSegment> found;
    add_images(found, segment);
    add_share(found, segment, Cause::kWrongTag, wrong_tags(segment));
    add_share(found, segment, Cause::kMissedTag, missed_tags(segment));
    if (jumped_by_plants(segment)) add_share(found, segment, Cause::kRepeatedPattern, 1);
    add_capture(found, segment);
    std::ranges::stable_sort(found, std::greater(), &DegradedSegment::share);
    if (found.empty()) {
      add_share(found, segment,
                trial_.miscalibrated ? Cause::kCalibrationError : Cause::kUnexplained, 1);
    }
    return found;
  }

 private:
  const Tick& tick(std::size_t i) const { return record_.ticks[i]; }

  /// What the images show.
  void add_images(std::vector<DegradedSegment>& found, const DegradedSegment& segment) const {
    add_seen(found, segment, Cause::kDroppedImages,
             [&](std::size_t i, std::size_t c) { return images_.is_dropped(i, c); });
    add_seen(found, segment, Cause::kOcclusion, [&](std::size_t i, std::size_t c) {
      return images_.occlusion(i, c).total() >= kOccluded;
    });
    add_seen(found, segment, Cause::kMotionBlur,
             [&](std::size_t i, std::size_t c) { return images_.is_blurred(i, c); });
    add_seen(found, segment, Cause::kMovingObjects, [&](std::size_t i, std::size_t c) {
      return images_.moving(i, c).total() >= kSeenMoving &&
             images_.occlusion(i, c).total() < kOccluded;
    });
    for (DegradedSegment& one : found) name_occluder(one);
    add_seen(found, segment, Cause::kLittleTexture,
             [&](std::size_t i, std::size_t c) { return lacks_texture(i, c); });
  }

  /// How they were taken.
  void add_capture(std::vector<DegradedSegment>& found, const DegradedSegment& segment) const {
    add_seen(found, segment, Cause::kExposure,
             [&](std::size_t i, std::size_t c) { return images_.is_badly_exposed(i, c); });
    add_seen(found, segment, Cause::kRollingShutter,
             [&](std::size_t i, std::size_t c) { return images_.is_rolling(i, c); });
    add_seen(found, segment, Cause::kTimeOffset,
             [&](std::size_t i, std::size_t c) { return images_.is_mistimed(i, c); });
  }

  double median_features(std::size_t camera) const {
    std::vector<double> counts;
    for (const Tick& t : record_.ticks) {
      if (camera < t.estimate.cameras.size()) {
        counts.push_back(t.estimate.cameras[camera].features);
      }
    }
    return counts.empty() ? 0 : percentile(counts, 0.5);
  }

  static DegradedSegment with(const DegradedSegment& segment, Cause cause, double share) {
    DegradedSegment diagnosed = segment;
    diagnosed.cause = cause;
    diagnosed.share = share;
    return diagnosed;
  }

  static void add_share(std::vector<DegradedSegment>& found, const DegradedSegment& segment,
                        Cause cause, double share) {
    if (share >= kShown) found.push_back(with(segment, cause, share));
  }

  /// With the cameras in which it is present long enough, and the largest share among them.
  void add_seen(std::vector<DegradedSegment>& found, const DegradedSegment& segment, Cause cause,
                const auto& shows) const {
    DegradedSegment diagnosed = with(segment, cause, 0);
    for (const std::size_t camera : cameras_) {
      const double share = share_of(segment, [&](std::size_t i) { return bool(shows(i, camera)); });
      if (share < kShown) continue;
      diagnosed.cameras.push_back(camera);
      diagnosed.share = std::max(diagnosed.share, share);
    }
    if (!diagnosed.cameras.empty()) found.push_back(diagnosed);
  }

  static double share_of(const DegradedSegment& segment, const auto& shows) {
    int count = 0;
    for (std::size_t i = segment.first; i <= segment.last; ++i) count += shows(i) ? 1 : 0;
    return count / static_cast<double>(segment.last - segment.first + 1);
  }

  /// The class that covers most in the cameras that the segment names, over all its ticks.
  void name_occluder(DegradedSegment& segment) const {
    if (segment.cause != Cause::kOcclusion && segment.cause != Cause::kMovingObjects) return;
    Occlusion sum;
    for (std::size_t i = segment.first; i <= segment.last; ++i) {
      for (const std::size_t camera : segment.cameras) {
        const Occlusion seen = segment.cause == Cause::kOcclusion ? images_.occlusion(i, camera)
                                                                  : images_.moving(i, camera);
        for (std::size_t c = 0; c < kOccluderClasses; ++c) sum.shares[c] += seen.shares[c];
      }
    }
    segment.occluder = sum.largest();
  }

  bool lacks_texture(std::size_t i, std::size_t camera) const {
    const double usual = usual_features_[camera];
    if (usual <= 0 || camera >= tick(i).estimate.cameras.size()) return false;
    if (images_.is_dropped(i, camera) || images_.is_blurred(i, camera) ||
        images_.occlusion(i, camera).total() > kClearView) {
      return false;
    }
    const double features = tick(i).estimate.cameras[camera].features;
    return features < std::max(kFewOfUsual * usual, kFewFeatures);
  }

  /// A wrong loop closure takes precedence over rejected tags.
  double wrong_tags(const DegradedSegment& segment) const {
    const bool closed = std::ranges::any_of(results_.loops.closures, [&](const JudgedClosure& c) {
      return c.wrong() && c.tick >= segment.first && c.tick <= segment.last;
    });
    if (closed) return 1;
    return share_of(segment, [&](std::size_t i) {
      return std::ranges::any_of(tick(i).estimate.rejected_tags, [](const RejectedTag& tag) {
        return tag.reason != TagRejection::kAmbiguous;
      });
    });
  }

  double missed_tags(const DegradedSegment& segment) const {
    if (!reads_tags_) return 0;
    return share_of(segment, [&](std::size_t i) {
      return std::ranges::any_of(tick(i).truth.visible_tags, [&](int visible) {
        const WorldTag& tag = record_.tags[static_cast<std::size_t>(visible)];
        return std::ranges::none_of(tick(i).estimate.tags, [&](const TagSighting& sighting) {
          return sighting.id == tag.id && sighting.family == tag.family;
        });
      });
    });
  }

  /// Along a row, by a multiple of the plant spacing, while tracking was good.
  bool jumped_by_plants(const DegradedSegment& segment) const {
    const Site& site = trial_.site;
    const auto error = error_growth(record_, segment.first, segment.last);
    if (site.rows.empty() || !error || segment.untracked > 0 ||
        segment.inliers < kHealthyInliers * segment.usual_inliers) {
      return false;
    }
    const double spacing = site.vine_spacing;
    return std::ranges::any_of(site.rows, [&](const Site::Row& row) {
      const Eigen::Vector2d along = (row.end - row.start).normalized();
      const double ahead = std::abs(along.dot(error->head<2>()));
      const double aside =
          (*error - (Eigen::Vector3d() << along, 0).finished() * along.dot(error->head<2>()))
              .norm();
      const double plants = std::round(ahead / spacing);
      return plants >= 1 && std::abs(ahead - plants * spacing) <= kSpacingTolerance * spacing &&
             aside <= kSpacingTolerance * spacing;
    });
  }

  const RunRecord& record_;
  const RunResults& results_;
  const Trial& trial_;
  ImageConditions images_;
  std::vector<std::size_t>
      cameras_;  ///< left cameras: a right camera's features are matches of theirs
  std::vector<double> usual_features_;
  bool reads_tags_ = false;
};

std::string cameras_text(const RunRecord& record, const DegradedSegment& diagnosed) {
  std::vector<std::string> names;
  for (const std::size_t camera : diagnosed.cameras) {
    names.push_back(record.rig.cameras[camera].name);
  }
  return names.empty() ? "" : fmt::format(" in {}", fmt::join(names, ", "));
}

std::string cause_text(const DegradedSegment& diagnosed) {
  const std::string by = diagnosed.occluder ? " by " + name_of(*diagnosed.occluder) : "";
  return name_of(diagnosed.cause) + by;
}

std::string line_of(const RunRecord& record, const DegradedSegment& diagnosed) {
  std::string text = fmt::format(
      "  {:.2f} to {:.2f} s: {}{} ({:.0f} % of the time); error grew by {:.1f} mm",
      to_seconds(record.ticks[diagnosed.first].stamp),
      to_seconds(record.ticks[diagnosed.last].stamp), cause_text(diagnosed),
      cameras_text(record, diagnosed), 100 * diagnosed.share, 1e3 * diagnosed.error_growth);
  if (diagnosed.usual_inliers > 0) {
    text += fmt::format(", {:.0f} inliers of usually {:.0f}", diagnosed.inliers,
                        diagnosed.usual_inliers);
  }
  if (diagnosed.untracked > 0) text += fmt::format(", {} frames lost", diagnosed.untracked);
  return text + "\n";
}

}  // namespace

const char* name_of(Cause cause) {
  switch (cause) {
    case Cause::kDroppedImages:
      return "dropped pictures";
    case Cause::kOcclusion:
      return "occlusion";
    case Cause::kMotionBlur:
      return "motion blur";
    case Cause::kLittleTexture:
      return "little texture";
    case Cause::kWrongTag:
      return "wrong tag";
    case Cause::kMissedTag:
      return "missed tag";
    case Cause::kRepeatedPattern:
      return "repeated pattern";
    case Cause::kExposure:
      return "exposure";
    case Cause::kMovingObjects:
      return "moving objects";
    case Cause::kRollingShutter:
      return "rolling shutter";
    case Cause::kTimeOffset:
      return "time offset";
    case Cause::kCalibrationError:
      return "calibration error";
    case Cause::kUnexplained:
      return "unexplained";
  }
  return "";
}

std::vector<DegradedSegment> diagnose(const RunRecord& record, const RunResults& results,
                                      const Trial& trial) {
  const CauseFinder finder(record, results, trial);
  std::vector<DegradedSegment> segments;
  for (const DegradedSegment& segment : degraded_segments(record, results)) {
    const std::vector<DegradedSegment> causes = finder.causes_of(segment);
    segments.insert(segments.end(), causes.begin(), causes.end());
  }
  return segments;
}

std::string format_diagnosis(const RunRecord& record,
                             const std::vector<DegradedSegment>& segments) {
  const auto any = [&](const auto& holds) { return std::ranges::any_of(record.ticks, holds); };
  if (!any([](const Tick& tick) { return is_tracked(tick.estimate); })) {
    return "no degraded segment can be found: there was never a pose that cameras support\n";
  }
  if (!any([](const Tick& tick) { return tick.truth.known; })) {
    return "no degraded segment can be found: the truth is not known\n";
  }
  if (segments.empty()) {
    return "no degraded segment: no weak tracking, no fast growth of the error\n";
  }
  std::string text = "degraded segments and their causes:\n";
  for (const DegradedSegment& diagnosed : segments) text += line_of(record, diagnosed);
  return text;
}

}  // namespace vinebench::harness

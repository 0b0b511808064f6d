// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/tag_detector.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagCircle21h7.h>
#include <apriltag/tagCircle49h12.h>
#include <apriltag/tagCustom48h12.h>
#include <apriltag/tagStandard41h12.h>
#include <apriltag/tagStandard52h13.h>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/util/error.h"
#include "slam/tags/tag_corners.h"
#include "slam/tags/tag_pose.h"
#include "slam/tags/tag_search.h"

namespace vinebench::slam {
namespace {

struct KnownFamily {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

constexpr KnownFamily kFamilies[] = {
    {"tag16h5", tag16h5_create, tag16h5_destroy},
    {"tag25h9", tag25h9_create, tag25h9_destroy},
    {"tag36h10", tag36h10_create, tag36h10_destroy},
    {"tag36h11", tag36h11_create, tag36h11_destroy},
    {"tagCircle21h7", tagCircle21h7_create, tagCircle21h7_destroy},
    {"tagCircle49h12", tagCircle49h12_create, tagCircle49h12_destroy},
    {"tagCustom48h12", tagCustom48h12_create, tagCustom48h12_destroy},
    {"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy},
    {"tagStandard52h13", tagStandard52h13_create, tagStandard52h13_destroy},
};

const KnownFamily& find_family(const std::string& name) {
  std::string names;
  for (const KnownFamily& family : kFamilies) {
    if (name == family.name) return family;
    names += (names.empty() ? "" : ", ") + std::string(family.name);
  }
  fail("tag detector: unknown tag family '{}'; expected one of {}", name, names);
}

using FamilyPtr = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;
using DetectorPtr = std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)>;
using DetectionsPtr = std::unique_ptr<zarray_t, void (*)(zarray_t*)>;

/// AprilTag takes the centre of the top left pixel for (0.5, 0.5), we for (0, 0).
constexpr double kPixelCentre = 0.5;

/// A corner nearer than this to the image's edge is guessed, not seen.
constexpr double kBorder = 5;  // px

/// One tag, found in two parts of the image that overlap.
bool are_the_same(const TagSighting& a, const TagSighting& b) {
  constexpr double kApart = 2;  // px
  return a.family == b.family && a.id == b.id && (a.corners[0] - b.corners[0]).norm() < kApart &&
         (a.corners[2] - b.corners[2]).norm() < kApart;
}

}  // namespace

struct TagDetector::Impl {
  TagDetectorConfig config;
  std::map<std::pair<std::string, int>, double> sizes;  ///< m, of the registered tags
  std::vector<FamilyPtr> families;                      ///< outlives the detector that uses them
  DetectorPtr detector{apriltag_detector_create(), apriltag_detector_destroy};

  Impl(const TagDetectorConfig& c, const std::vector<RegisteredTag>& registered) : config(c) {
    for (const RegisteredTag& tag : registered) sizes[{tag.family, tag.id}] = tag.size;
    for (const std::string& name : config.families) {
      const KnownFamily& family = find_family(name);
      families.emplace_back(family.create(), family.destroy);
      apriltag_detector_add_family_bits(detector.get(), families.back().get(), config.max_hamming);
    }
    detector->nthreads = 1;
    detector->quad_decimate = static_cast<float>(config.decimate);
    detector->refine_edges = true;
  }

  double size_of(const std::string& family, int id) const {
    const auto found = sizes.find({family, id});
    return found == sizes.end() ? config.size : found->second;
  }

  bool believes(const apriltag_detection_t& found) const {
    return static_cast<double>(found.decision_margin) >= config.min_margin &&
           found.hamming <= config.max_hamming;
  }

  /// Where to search. Families whose border is white, or has bits around it, everywhere.
  std::vector<cv::Rect> parts(const cv::Mat& grey) const {
    const bool guided = std::ranges::all_of(families, [](const FamilyPtr& family) {
      return !family->reversed_border && family->total_width <= family->width_at_border + 2;
    });
    if (!guided) return {cv::Rect({0, 0}, grey.size())};
    return find_tag_candidates(grey, static_cast<int>(config.decimate));
  }

  /// Nothing where the corners are not those of a square.
  std::optional<TagSighting> sighting(const apriltag_detection_t& found, const cv::Mat& grey,
                                      const cv::Rect& part, const PinholeCamera& model,
                                      int camera) const {
    TagSighting result;
    result.camera = camera;
    result.family = found.family->name;
    result.id = found.id;
    for (std::size_t i = 0; i < 4; ++i) {
      result.corners[i] = {found.p[i][0] - kPixelCentre + part.x,
                           found.p[i][1] - kPixelCentre + part.y};
    }
    result.corner_sigma =
        refine_tag_corners(grey, model, found.family->width_at_border, result.corners);
    const TagPose pose = estimate_tag_pose(result.corners, model, size_of(result.family, result.id),
                                           result.corner_sigma);
    if (!pose.square) return std::nullopt;
    result.T_cam_tag = pose.T_cam_tag;
    result.ambiguous = pose.ambiguous;
    return result;
  }

  /// Appends the sightings in a part of the image.
  void detect_in(const cv::Mat& grey, const cv::Rect& part, const PinholeCamera& model, int camera,
                 std::vector<TagSighting>& sightings) {
    // The library only reads the image; its interface is not const.
    image_u8_t image{part.width, part.height, static_cast<int32_t>(grey.step[0]),
                     const_cast<std::uint8_t*>(grey.ptr<std::uint8_t>(part.y)) + part.x};
    const DetectionsPtr found(apriltag_detector_detect(detector.get(), &image),
                              apriltag_detections_destroy);
    for (int i = 0; i < zarray_size(found.get()); ++i) {
      const apriltag_detection_t* detection = nullptr;
      zarray_get(found.get(), i, static_cast<void*>(&detection));
      if (!believes(*detection)) continue;
      std::optional<TagSighting> seen = sighting(*detection, grey, part, model, camera);
      if (!seen) continue;
      const bool whole = std::ranges::all_of(seen->corners, [&](const Eigen::Vector2d& corner) {
        return model.contains(corner, kBorder);
      });
      if (whole) sightings.push_back(std::move(*seen));
    }
  }
};

TagDetector::TagDetector(const TagDetectorConfig& config, std::vector<RegisteredTag> registered)
    : impl_(std::make_unique<Impl>(config, registered)) {}
TagDetector::TagDetector(TagDetector&&) noexcept = default;
TagDetector& TagDetector::operator=(TagDetector&&) noexcept = default;
TagDetector::~TagDetector() = default;

std::vector<TagSighting> TagDetector::detect(const cv::Mat& grey, const PinholeCamera& model,
                                             int camera) {
  if (grey.type() != CV_8UC1 || grey.empty()) {
    fail("tag detector: expected a grey image of 8 bits (CV_8UC1), found {} x {} of type {}",
         grey.cols, grey.rows, cv::typeToString(grey.type()));
  }
  std::vector<TagSighting> sightings;
  for (const cv::Rect& part : impl_->parts(grey)) {
    impl_->detect_in(grey, part, model, camera, sightings);
  }
  std::sort(sightings.begin(), sightings.end(), [](const TagSighting& a, const TagSighting& b) {
    return std::tuple(a.family, a.id, a.corners[0].x(), a.corners[0].y()) <
           std::tuple(b.family, b.id, b.corners[0].x(), b.corners[0].y());
  });
  const auto end = std::unique(sightings.begin(), sightings.end(), are_the_same);
  sightings.erase(end, sightings.end());
  return sightings;
}

}  // namespace vinebench::slam

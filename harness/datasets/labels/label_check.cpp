// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/labels/label_check.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <system_error>

#include "core/truth/labels.h"
#include "harness/datasets/coco/coco_check.h"
#include "harness/datasets/format/calibration_file.h"
#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFramesLookedAt = 6;
constexpr double kHalfMillimetre = 0.0005 + 1e-6;
constexpr double kDisparityStep = 1.0 / 256;
constexpr double kFlowStep = 1.0 / 64;
constexpr double kFlowZero = 32768;
constexpr double kFlowTolerance = 0.1;  // px
constexpr double kAgreeing = 0.9;       // share of the pixels
constexpr double kNearest = 0.05;       // m before a camera

/// The label images of one camera at one frame; what is not recorded is empty.
struct Labels {
  cv::Mat depth;      ///< CV_16UC1, mm
  cv::Mat disparity;  ///< CV_16UC1
  cv::Mat flow;       ///< CV_16UC3, BGR
  cv::Mat semantic;   ///< CV_8UC1
  cv::Mat instances;  ///< CV_8UC3, BGR
};

bool has_wind(const fs::path& scenario) {
  const YAML::Node speed = YAML::LoadFile(scenario.string())["world"]["wind"]["speed"];
  return speed.as<double>(0) != 0;
}

class Checker {
 public:
  Checker(const fs::path& sequence, const std::vector<RecordedPose>& frames)
      : folder_(sequence),
        frames_(frames),
        rig_(read_calibration(sequence / "calibration.yaml")),
        windy_(has_wind(sequence / "scenario.resolved.yaml")) {}

  LabelCheck run() {
    const std::size_t step = (frames_.size() + kFramesLookedAt - 1) / kFramesLookedAt;
    for (std::size_t frame = 0; frame < frames_.size(); frame += step) {
      for (std::size_t camera = 0; camera < rig_.cameras.size(); ++camera) {
        check(frame, camera);
      }
    }
    std::error_code ignored;
    if (fs::exists(folder_ / "coco/instances.json", ignored)) {
      for (const DatasetFault& fault : check_coco(folder_ / "coco")) {
        result_.faults.push_back({"coco/" + fault.file, fault.problem});
      }
    }
    return std::move(result_);
  }

 private:
  std::string name(const char* format, std::size_t frame, std::size_t camera) const {
    return fmt::format("{}/{}/{}", format, rig_.cameras[camera].name,
                       numbered(static_cast<std::int64_t>(frame), "png"));
  }

  cv::Mat read(const char* format, int type, std::size_t frame, std::size_t camera) {
    const std::string file = name(format, frame, camera);
    std::error_code ignored;
    if (!fs::exists(folder_ / file, ignored)) return {};
    const cv::Mat image = cv::imread((folder_ / file).string(), cv::IMREAD_UNCHANGED);
    const PinholeCamera& model = rig_.cameras[camera].model;
    ++result_.images;
    if (image.size() == cv::Size(model.width, model.height) && image.type() == type) {
      return image;
    }
    fault(file, fmt::format("is no whole image of {} x {} pixels of its kind", model.width,
                            model.height));
    return {};
  }

  void fault(const std::string& file, const std::string& problem) {
    result_.faults.push_back({file, problem});
  }

  void check(std::size_t frame, std::size_t camera) {
    Labels labels;
    labels.depth = read("depth", CV_16UC1, frame, camera);
    labels.disparity = read("disparity", CV_16UC1, frame, camera);
    labels.flow = read("flow", CV_16UC3, frame, camera);
    labels.semantic = read("semantic", CV_8UC1, frame, camera);
    labels.instances = read("instances", CV_8UC3, frame, camera);
    if (!labels.depth.empty() && !labels.semantic.empty()) check_sky(labels, frame, camera);
    if (!labels.depth.empty() && !labels.disparity.empty()) check_disparity(labels, frame, camera);
    if (!labels.instances.empty() && !labels.semantic.empty()) check_bunches(labels, frame, camera);
    if (!labels.depth.empty() && !labels.flow.empty()) check_flow(labels, frame, camera);
  }

  /// Counts the pixels that `wrong` holds for; any is a fault.
  template <class Wrong>
  void expect_none(const std::string& file, const cv::Size& size, const std::string& problem,
                   const Wrong& wrong) {
    std::int64_t count = 0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) count += wrong(y, x) ? 1 : 0;
    }
    if (count > 0) fault(file, fmt::format("{} at {} pixels", problem, count));
  }

  void check_sky(const Labels& labels, std::size_t frame, std::size_t camera) {
    expect_none(name("depth", frame, camera), labels.depth.size(), "has depth in the sky",
                [&](int y, int x) {
                  const bool sky = labels.semantic.at<std::uint8_t>(y, x) ==
                                   static_cast<std::uint8_t>(Label::kSky);
                  return sky && labels.depth.at<std::uint16_t>(y, x) != 0;
                });
  }

  void check_bunches(const Labels& labels, std::size_t frame, std::size_t camera) {
    expect_none(name("instances", frame, camera), labels.instances.size(),
                "tells bunches where semantic has none", [&](int y, int x) {
                  const cv::Vec3b& id = labels.instances.at<cv::Vec3b>(y, x);  // blue, green, red
                  const bool numbered_part = id[2] != 0 && (id[0] != 0 || id[1] != 0);
                  const bool bunch = labels.semantic.at<std::uint8_t>(y, x) ==
                                     static_cast<std::uint8_t>(Label::kBunch);
                  return numbered_part && !bunch;
                });
  }

  void check_disparity(const Labels& labels, std::size_t frame, std::size_t camera) {
    for (const StereoPair& pair : rig_.stereo_pairs) {
      if (pair.left != static_cast<int>(camera)) continue;
      const double focal_baseline = rig_.cameras[camera].model.fx * rig_.baseline(pair);
      expect_none(name("disparity", frame, camera), labels.depth.size(),
                  "is not focal length · baseline / depth", [&](int y, int x) {
                    const double z = labels.depth.at<std::uint16_t>(y, x) * 1e-3;
                    const int code = labels.disparity.at<std::uint16_t>(y, x);
                    if (z <= 0 || code == 0) return false;
                    const double expected = focal_baseline / z;
                    const double tolerance = kDisparityStep + expected / z * kHalfMillimetre * 1.1;
                    return std::abs(code * kDisparityStep - expected) > tolerance;
                  });
    }
  }

  /// Whether a pixel's thing may move by itself, for all that is known of it.
  bool may_move(const Labels& labels, int y, int x) const {
    if (labels.semantic.empty()) return windy_;
    switch (static_cast<Label>(labels.semantic.at<std::uint8_t>(y, x))) {
      case Label::kRover:
        return true;
      case Label::kLeaf:
      case Label::kCane:
      case Label::kBunch:
      case Label::kGrass:
        return windy_;
      default:
        return false;
    }
  }

  void check_flow(const Labels& labels, std::size_t frame, std::size_t camera) {
    if (frame + 1 >= frames_.size()) return;
    const RigCamera& mounted = rig_.cameras[camera];
    const Pose T_next_now = (frames_[frame + 1].T_world_body * mounted.T_body_cam).inverse() *
                            (frames_[frame].T_world_body * mounted.T_body_cam);
    std::int64_t looked_at = 0;
    std::int64_t agreeing = 0;
    for (int y = 0; y < labels.depth.rows; ++y) {
      for (int x = 0; x < labels.depth.cols; ++x) {
        const double z = labels.depth.at<std::uint16_t>(y, x) * 1e-3;
        const cv::Vec3w& code = labels.flow.at<cv::Vec3w>(y, x);  // valid, v, u
        if (z <= 0 || code[0] == 0 || may_move(labels, y, x)) continue;
        const auto place = [&](double depth) {
          const Eigen::Vector3d p = T_next_now * (depth * mounted.model.unproject({x, y}));
          return p.z() < kNearest ? Eigen::Vector2d(1e9, 1e9) : mounted.model.project(p);
        };
        const Eigen::Vector2d expected = place(z);
        const double by_depth = (place(z + kHalfMillimetre) - expected).norm();
        const Eigen::Vector2d told(x + (code[2] - kFlowZero) * kFlowStep,
                                   y + (code[1] - kFlowZero) * kFlowStep);
        ++looked_at;
        if ((told - expected).norm() <= kFlowTolerance + by_depth) ++agreeing;
      }
    }
    if (static_cast<double>(agreeing) < kAgreeing * static_cast<double>(looked_at)) {
      fault(name("flow", frame, camera),
            fmt::format("agrees with depth and poses at {} of {} pixels", agreeing, looked_at));
    }
  }

  fs::path folder_;
  const std::vector<RecordedPose>& frames_;
  Rig rig_;
  bool windy_;
  LabelCheck result_;
};

}  // namespace

LabelCheck check_labels(const fs::path& sequence, const std::vector<RecordedPose>& frames) {
  return Checker(sequence, frames).run();
}

}  // namespace vinebench::harness

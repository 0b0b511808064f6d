// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/coco/coco_check.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <system_error>

#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/datasets/coco/coco_file.h"
#include "harness/datasets/files/image_file.h"
#include "harness/datasets/files/json_file.h"
#include "harness/datasets/labels/mask_rle.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kPanopticLookedAt = 12;

class Checker {
 public:
  explicit Checker(const fs::path& folder) : folder_(folder) {}

  std::vector<DatasetFault> run() {
    try {
      check_instances();
      check_panoptic();
    } catch (const Json::exception& error) {  // a missing key or a wrong type
      faults_.push_back({file_, error.what()});
    }
    return std::move(faults_);
  }

 private:
  void fault(const std::string& problem) { faults_.push_back({file_, problem}); }

  /// Sizes of the images by their ids.
  std::map<std::int64_t, cv::Size> read_images(const Json& root) {
    std::map<std::int64_t, cv::Size> sizes;
    for (const Json& image : root.at("images")) {
      const cv::Size size(image.at("width").get<int>(), image.at("height").get<int>());
      if (size.width < 1 || size.height < 1 || size.width > kLargestImageSide ||
          size.height > kLargestImageSide) {
        fault(fmt::format("image {}: expected 1 to {} pixels a side",
                          image.at("id").get<std::int64_t>(), kLargestImageSide));
        continue;
      }
      if (!sizes.emplace(image.at("id"), size).second) {
        fault(fmt::format("image {} is listed twice", image.at("id").get<std::int64_t>()));
      }
      const auto name = image.at("file_name").get<std::string>();
      std::error_code ignored;
      const bool found = fs::exists(folder_ / kCocoImages / name, ignored) ||
                         fs::exists(folder_ / name, ignored);  // of version 0.2.0 and earlier
      if (!found) fault(name + ": image is missing");
    }
    return sizes;
  }

  static std::set<int> read_categories(const Json& root) {
    std::set<int> ids;
    for (const Json& category : root.at("categories")) ids.insert(category.at("id").get<int>());
    return ids;
  }

  void check_instances() {
    file_ = "instances.json";
    const Json root = read_json(folder_ / file_);
    const auto sizes = read_images(root);
    const std::set<int> categories = read_categories(root);
    std::set<std::int64_t> ids;
    for (const Json& annotation : root.at("annotations")) {
      const auto id = annotation.at("id").get<std::int64_t>();
      if (!ids.insert(id).second) fault(fmt::format("annotation {} is listed twice", id));
      const auto image = sizes.find(annotation.at("image_id").get<std::int64_t>());
      if (image == sizes.end() || !categories.contains(annotation.at("category_id").get<int>())) {
        fault(fmt::format("annotation {}: unknown image or category", id));
        continue;
      }
      annotation.at("iscrowd").get<int>();
      check_mask(annotation, image->second, id);
    }
  }

  void check_mask(const Json& annotation, const cv::Size& size, std::int64_t id) {
    const Json& mask = annotation.at("segmentation");
    if (mask.at("size") != Json::array({size.height, size.width})) {
      fault(fmt::format("annotation {}: its mask does not have its image's size", id));
      return;
    }
    Runs runs;
    try {
      runs = decompress(mask.at("counts").get<std::string>(), size.area());
    } catch (const Error& error) {
      fault(fmt::format("annotation {}: {}", id, error.what()));
      return;
    }
    const cv::Rect box = box_of(runs, size.height);
    if (annotation.at("area").get<std::int64_t>() != area_of(runs) ||
        annotation.at("bbox") != Json::array({box.x, box.y, box.width, box.height})) {
      fault(fmt::format("annotation {}: area or box do not match its mask", id));
    }
  }

  void check_panoptic() {
    file_ = "panoptic.json";
    const Json root = read_json(folder_ / file_);
    const auto sizes = read_images(root);
    const std::set<int> categories = read_categories(root);
    int looked_at = 0;
    for (const Json& annotation : root.at("annotations")) {
      if (++looked_at > kPanopticLookedAt) return;
      const auto name = annotation.at("file_name").get<std::string>();
      std::map<int, std::int64_t> areas = areas_of(read_panoptic(name));
      for (const Json& segment : annotation.at("segments_info")) {
        const auto found = areas.find(segment.at("id").get<int>());
        if (found == areas.end() || found->second != segment.at("area").get<std::int64_t>() ||
            !categories.contains(segment.at("category_id").get<int>())) {
          fault(fmt::format("{}: segment {} does not match the image", name,
                            segment.at("id").get<int>()));
        }
        if (found != areas.end()) areas.erase(found);
      }
      if (!areas.empty()) fault(fmt::format("{}: {} segments are not listed", name, areas.size()));
    }
  }

  cv::Mat read_panoptic(const std::string& name) {
    try {
      const cv::Mat image = read_image(folder_ / "panoptic" / name, cv::IMREAD_COLOR);
      if (image.empty()) fault(name + ": is not a complete image");
      return image;
    } catch (const Error& error) {
      fault(error.what());
      return {};
    }
  }

  static std::map<int, std::int64_t> areas_of(const cv::Mat& image) {
    std::map<int, std::int64_t> areas;
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        const auto& bgr = image.at<cv::Vec3b>(y, x);
        ++areas[bgr[2] | bgr[1] << 8 | bgr[0] << 16];
      }
    }
    return areas;
  }

  fs::path folder_;
  std::string file_;
  std::vector<DatasetFault> faults_;
};

}  // namespace

std::vector<DatasetFault> check_coco(const fs::path& folder) {
  return Checker(folder).run();
}

}  // namespace vinebench::harness

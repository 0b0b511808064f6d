// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// Consistency of the labels of a recording, read back from its files.

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <regex>

#include "core/trajectory.h"
#include "harness/datasets/coco/coco_check.h"
#include "harness/datasets/coco/coco_file.h"
#include "harness/datasets/dataset_check.h"
#include "harness/datasets/format/calibration_file.h"
#include "harness/datasets/labels/label_table.h"
#include "harness/datasets/labels/mask_rle.h"
#include "tests/support/small_scenario.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::json;

/// Of one channel.
cv::Mat read_npy(const std::filesystem::path& file, const cv::Size& size) {
  const std::string bytes = read_file(file);
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  std::uint16_t header = 0;
  std::memcpy(&header, bytes.data() + 8, 2);
  EXPECT_EQ((10 + header) % 64, 0);
  EXPECT_EQ(
      bytes.substr(10, header),
      fmt::format("{:<{}}\n",
                  fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}",
                              size.height, size.width),
                  header - 1));
  cv::Mat image(size, CV_32FC1);
  EXPECT_EQ(bytes.size(), 10u + header + 4 * image.total());
  std::memcpy(image.data, bytes.data() + 10 + header, 4 * image.total());
  return image;
}

class RecordedLabelsTest : public test::SmallScenario {
 protected:
  cv::Mat depth(const std::string& camera, int number) const {
    return read_npy(request_.out / "depth32" / camera / fmt::format("{:06}.npy", number),
                    size_of(camera));
  }
  cv::Mat read_image(const std::string& format, const std::string& camera, int number) const {
    const auto file = request_.out / format / camera / fmt::format("{:06}.png", number);
    return cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  }
  static cv::Size size_of(const std::string& camera) {
    return camera == "side" ? cv::Size(160, 96) : cv::Size(96, 64);
  }
  Label label(const cv::Mat& semantic, int y, int x) const {
    return static_cast<Label>(semantic.at<std::uint8_t>(y, x));
  }
};

TEST_F(RecordedLabelsTest, DepthReprojectsIntoTheOtherCameraAtTheDisparity) {
  record({"depth32", "depth", "disparity"});
  const Rig rig = read_calibration(request_.out / "calibration.yaml");
  const Pose T_right_left = rig.cameras[1].T_body_cam.inverse() * rig.cameras[0].T_body_cam;
  int seen = 0;
  int same = 0;
  for (const int number : {0, 5}) {
    const cv::Mat z = depth("left", number);
    const cv::Mat mm = read_image("depth", "left", number);
    const cv::Mat z_right = depth("right", number);
    const cv::Mat codes = read_image("disparity", "left", number);
    for (int y = 0; y < z.rows; ++y) {
      for (int x = 0; x < z.cols; ++x) {
        const double metres = z.at<float>(y, x);
        EXPECT_NEAR(mm.at<std::uint16_t>(y, x) * 1e-3, metres < 65.535 ? metres : 0, 0.000501);
        if (metres == 0) continue;
        const Eigen::Vector3d p = T_right_left * (metres * rig.cameras[0].model.unproject({x, y}));
        const Eigen::Vector2d at = rig.cameras[1].model.project(p);
        ASSERT_NEAR(x - at.x(), codes.at<std::uint16_t>(y, x) / 256.0, 0.05);  // px
        ASSERT_NEAR(at.y(), y, 1e-6);
        const int column = static_cast<int>(std::lround(at.x()));
        if (column < 0) continue;
        ++seen;
        // The other camera sees the same point unless it is hidden: most are visible.
        same += std::abs(z_right.at<float>(y, column) - metres) < 0.03 * metres ? 1 : 0;
      }
    }
  }
  EXPECT_GT(seen, 4000);
  EXPECT_GT(same, 0.75 * seen);
}

TEST_F(RecordedLabelsTest, FlowLeadsToThePointInTheNextFrame) {
  record({"depth32", "flow", "flo", "semantic", "tum"});
  const Rig rig = read_calibration(request_.out / "calibration.yaml");
  int moved = 0;
  for (const std::string camera : {"left", "side"}) {
    const Trajectory poses = read_tum(request_.out / "tum" / (camera + ".txt"));
    const PinholeCamera& model = rig.cameras[camera == "left" ? 0 : 2].model;
    const Pose T_next_now = poses[5].pose.inverse() * poses[4].pose;
    const cv::Mat z = depth(camera, 4);
    const cv::Mat code = read_image("flow", camera, 4);
    const cv::Mat semantic = read_image("semantic", camera, 4);
    const std::string flo = read_file(request_.out / "flo" / camera / "000004.flo");
    ASSERT_EQ(flo.size(), 12 + 8 * z.total());
    EXPECT_EQ(flo.substr(0, 4), "PIEH");
    for (int y = 0; y < z.rows; ++y) {
      for (int x = 0; x < z.cols; ++x) {
        if (z.at<float>(y, x) == 0 || label(semantic, y, x) == Label::kRover) continue;
        const Eigen::Vector3d p = T_next_now * (z.at<float>(y, x) * model.unproject({x, y}));
        const auto& steps = code.at<cv::Vec3w>(y, x);  // valid, v, u
        ASSERT_EQ(steps[0], 1);
        const Eigen::Vector2d recorded((steps[2] - 32768) / 64.0, (steps[1] - 32768) / 64.0);
        const Eigen::Vector2d expected = model.project(p) - Eigen::Vector2d(x, y);
        ASSERT_LT((recorded - expected).norm(), 0.1) << camera << " " << x << " " << y;  // px
        std::array<float, 2> raw{};
        std::memcpy(raw.data(), flo.data() + 12 + 8 * (y * z.cols + x), 8);
        ASSERT_NEAR(raw[0], expected.x(), 0.02);
        moved += expected.norm() > 0.5 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(moved, 500);  // otherwise the test says nothing
  EXPECT_FALSE(std::filesystem::exists(request_.out / "flow/left/000005.png"));
}

// Small images use distant levels of plants, without individual bunches, unless detail is
// requested.
TEST_F(RecordedLabelsTest, CocoCountsEveryPixelOnce) {
  request_.overrides.emplace_back("renderer.lod_scale", "20");
  record({"coco", "semantic", "instances"});
  const Json root = Json::parse(read_file(request_.out / "coco/instances.json"));
  std::map<std::int64_t, Json> images;
  for (const Json& image : root["images"]) {
    images[image["id"]] = image;
    // A name is relative to the folder of the images, as COCO's readers expect it.
    EXPECT_TRUE(std::filesystem::exists(request_.out / "coco/images" / image["file_name"]));
  }
  ASSERT_EQ(images.size(), 18u);
  std::map<std::int64_t, std::map<int, std::int64_t>> areas;  // by image and category
  int bunches = 0;
  for (const Json& annotation : root["annotations"]) {
    const Json& image = images.at(annotation["image_id"]);
    const int category = annotation["category_id"];
    areas[annotation["image_id"]][category] += annotation["area"].get<std::int64_t>();
    const Json& mask = annotation["segmentation"];
    const Runs runs =
        decompress(mask["counts"], mask["size"][0].get<int>() * mask["size"][1].get<int>());
    const cv::Rect box(annotation["bbox"][0], annotation["bbox"][1], annotation["bbox"][2],
                       annotation["bbox"][3]);
    const cv::Rect whole(0, 0, image["width"], image["height"]);
    EXPECT_EQ(box & whole, box);
    if (category != category_id(Category::kBunch)) continue;
    ++bunches;
    EXPECT_GE(annotation["visibility"], 0);
    EXPECT_LE(annotation["truncation"], 1);
    // Its pixels have its number in the instance image.
    const std::string camera = image["camera"];
    const cv::Mat ids = read_image("instances", camera, image["frame"]);
    const cv::Mat mine = mask_of(runs, ids.size());
    for (int y = 0; y < ids.rows; ++y) {
      for (int x = 0; x < ids.cols; ++x) {
        const auto& bgr = ids.at<cv::Vec3b>(y, x);
        const int id = bgr[2] | bgr[1] << 8 | bgr[0] << 16;
        ASSERT_EQ(id == annotation["instance"].get<int>(), mine.at<std::uint8_t>(y, x) != 0);
      }
    }
  }
  EXPECT_GT(bunches, 10);
  for (const auto& [id, image] : images) {
    const cv::Mat semantic = read_image("semantic", image["camera"], image["frame"]);
    std::map<int, std::int64_t> pixels;
    for (int y = 0; y < semantic.rows; ++y) {
      for (int x = 0; x < semantic.cols; ++x) {
        const Category category = category_of(label(semantic, y, x));
        if (!is_thing(category)) continue;
        ++pixels[category_id(category)];
        if (category <= Category::kLeaf) ++pixels[category_id(Category::kPlant)];
      }
    }
    EXPECT_EQ(areas[id], pixels) << image.dump();
  }
}

// Up to version 0.2.0 the names of a COCO file began with the folder.
TEST_F(RecordedLabelsTest, NamesOfImagesWithTheirFolderAreStillRead) {
  record({"coco"});
  std::map<std::string, std::string> merged;
  for (const std::string form : {"new", "old"}) {
    for (const char* name : {"instances.json", "panoptic.json"}) {
      const std::filesystem::path file = request_.out / "coco" / name;
      std::string text = read_file(file);
      if (form == "old") {
        const std::size_t begin = text.find("\"images\": [");
        const std::size_t end = text.find("\n]", begin);
        const std::string images = std::regex_replace(
            text.substr(begin, end - begin), std::regex("(\"file_name\":\")"), "$1images/");
        write_file_atomically(file, text.replace(begin, end - begin, images));
      }
    }
    EXPECT_TRUE(check_coco(request_.out / "coco").empty()) << form;
    merge_coco(request_.out, {"coco"}, {});
    merged[form] = read_file(request_.out / "instances.json");
  }
  EXPECT_EQ(merged["old"], merged["new"]);
  EXPECT_NE(merged["new"].find("\"file_name\":\"coco/images/left_000000.png\""), std::string::npos);
}

TEST_F(RecordedLabelsTest, AllOfThemPassTheCheck) {
  record(all_formats());
  const DatasetReport report = check_dataset(request_.out);
  for (const DatasetFault& fault : report.faults) ADD_FAILURE() << fault.file << fault.problem;
  // Six frames of three cameras: depth, semantic, instances; disparity of one; five flows of three.
  EXPECT_EQ(report.label_images, 6 * (3 * 3 + 1) + 5 * 3);
}

TEST_F(RecordedLabelsTest, LabelsChooseWhatInstancesAreOf) {
  request_.options.categories = parse_categories({"bunch", "post"});
  record({"coco"});
  const Json root = Json::parse(read_file(request_.out / "coco/instances.json"));
  ASSERT_EQ(root["categories"].size(), 2u);
  EXPECT_EQ(root["categories"][0]["name"], "bunch");
  for (const Json& annotation : root["annotations"]) {
    EXPECT_TRUE(annotation["category_id"] == category_id(Category::kBunch) ||
                annotation["category_id"] == category_id(Category::kPost));
  }
}

TEST_F(RecordedLabelsTest, SmallThingsCanBeLeftOut) {
  const auto areas = [&](std::int64_t least, const char* folder) {
    request_.options.least_area = least;
    request_.out = folder_ / folder;
    record({"coco"});
    std::vector<std::int64_t> found;
    const Json root = Json::parse(read_file(request_.out / "coco/instances.json"));
    for (const Json& annotation : root["annotations"]) found.push_back(annotation["area"]);
    EXPECT_TRUE(check_dataset(request_.out).faults.empty());
    return found;
  };
  const std::vector<std::int64_t> all = areas(0, "all");
  ASSERT_FALSE(all.empty());
  const std::int64_t least = *std::ranges::max_element(all);
  const auto largest = std::ranges::count(all, least);
  ASSERT_LT(largest, std::ssize(all));
  EXPECT_EQ(areas(least, "large"), std::vector<std::int64_t>(largest, least));
}

}  // namespace
}  // namespace vinebench::harness

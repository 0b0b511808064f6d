// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/labels/label_formats.h"

#include <fmt/format.h>

#include <cmath>

#include "core/truth/rover_flow.h"
#include "core/util/error.h"
#include "core/util/files.h"
#include "harness/datasets/format/slam_settings.h"
#include "harness/datasets/labels/label_table.h"
#include "harness/datasets/labels/truth_colours.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kMillimetres = 1000;
constexpr double kMostCode = 65535;
constexpr double kDisparitySteps = 256;  // per px, KITTI
constexpr double kFlowSteps = 64;        // per px, KITTI
constexpr double kFlowZero = 32768;

bool delivered(const DatasetFrame& frame, std::size_t camera) {
  return !frame.frame.images.at(camera).empty();
}

const RenderedImage& truth_of(const DatasetFrame& frame, std::size_t camera) {
  return frame.truth.views.at(camera).image;
}

std::vector<std::string> make_camera_folders(const fs::path& folder, const RecordingNotes& notes) {
  std::vector<std::string> names;
  for (const RigConfig::Camera& camera : notes.rig.cameras) {
    make_folder(folder / camera.name);
    names.push_back(camera.name);
  }
  return names;
}

}  // namespace

ImageFormat::ImageFormat(const fs::path& folder, const RecordingNotes& notes, std::string name,
                         std::string ending, Encode encode)
    : folder_(folder),
      cameras_(make_camera_folders(folder, notes)),
      name_(std::move(name)),
      ending_(std::move(ending)),
      encode_(std::move(encode)) {}

std::vector<FileTask> ImageFormat::files(const std::shared_ptr<const DatasetFrame>& frame) {
  std::vector<FileTask> tasks;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!delivered(*frame, i)) continue;
    tasks.push_back({fmt::format("{} {} {}", name_, ending_, i),
                     folder_ / cameras_[i] / numbered(frame->number, ending_),
                     [this, frame, i] { return encode_(*frame, i); }});
  }
  return tasks;
}

std::unique_ptr<DatasetFormat> make_rgb_format(const fs::path& folder, const RecordingNotes& notes,
                                               ImageKind kind) {
  return std::make_unique<ImageFormat>(folder, notes, "rgb",
                                       yaml_names(kind).at(static_cast<std::size_t>(kind)),
                                       [kind](const DatasetFrame& frame, std::size_t camera) {
                                         return encode_image(frame.frame.images[camera], kind);
                                       });
}

std::unique_ptr<DatasetFormat> make_depth_format(const fs::path& folder,
                                                 const RecordingNotes& notes) {
  return std::make_unique<ImageFormat>(
      folder, notes, "depth", "png", [](const DatasetFrame& frame, std::size_t camera) {
        return encode_png(millimetres(truth_of(frame, camera).depth));
      });
}

std::unique_ptr<DatasetFormat> make_depth32_format(const fs::path& folder,
                                                   const RecordingNotes& notes) {
  return std::make_unique<ImageFormat>(folder, notes, "depth32", "npy",
                                       [](const DatasetFrame& frame, std::size_t camera) {
                                         return encode_npy(truth_of(frame, camera).depth);
                                       });
}

std::unique_ptr<DatasetFormat> make_normals_format(const fs::path& folder,
                                                   const RecordingNotes& notes) {
  return std::make_unique<ImageFormat>(
      folder, notes, "normals", "png", [](const DatasetFrame& frame, std::size_t camera) {
        return encode_png(colour_normals(truth_of(frame, camera).normals));
      });
}

std::unique_ptr<DatasetFormat> make_semantic_format(const fs::path& folder,
                                                    const RecordingNotes& notes) {
  make_folder(folder);
  write_file_atomically(folder / "labels.yaml", label_table_text());
  return std::make_unique<ImageFormat>(folder, notes, "semantic", "png",
                                       [](const DatasetFrame& frame, std::size_t camera) {
                                         return encode_png(truth_of(frame, camera).labels);
                                       });
}

cv::Mat millimetres(const cv::Mat& depth) {
  cv::Mat codes(depth.size(), CV_16UC1);
  for (int y = 0; y < depth.rows; ++y) {
    const auto* from = depth.ptr<float>(y);
    auto* to = codes.ptr<std::uint16_t>(y);
    for (int x = 0; x < depth.cols; ++x) {
      const double mm = static_cast<double>(from[x]) * kMillimetres + 0.5;
      to[x] = mm < kMostCode + 1 ? static_cast<std::uint16_t>(mm) : std::uint16_t{0};
    }
  }
  return codes;
}

DisparityFormat::DisparityFormat(const fs::path& folder, const RecordingNotes& notes)
    : folder_(folder) {
  Rig rig = notes.rig.make();
  rig.cameras = notes.true_cameras;
  if (rig.stereo_pairs.empty()) fail("disparity: expected a stereo pair among the cameras");
  for (const StereoPair& pair : rig.stereo_pairs) {
    if (!is_rectified(rig, pair)) {
      fail("disparity: the cameras of pair '{}' are not rectified as they truly are", pair.name);
    }
    const auto left = static_cast<std::size_t>(pair.left);
    cameras_.push_back(
        {left, rig.cameras[left].name, rig.cameras[left].model.fx * rig.baseline(pair)});
    make_folder(folder / cameras_.back().name);
  }
}

std::vector<FileTask> DisparityFormat::files(const std::shared_ptr<const DatasetFrame>& frame) {
  std::vector<FileTask> tasks;
  for (const Camera& camera : cameras_) {
    if (!delivered(*frame, camera.camera)) continue;
    tasks.push_back({fmt::format("disparity {}", camera.camera),
                     folder_ / camera.name / numbered(frame->number, "png"), [frame, &camera] {
                       const cv::Mat& depth = truth_of(*frame, camera.camera).depth;
                       cv::Mat codes(depth.size(), CV_16UC1);
                       for (int y = 0; y < depth.rows; ++y) {
                         const auto* z = depth.ptr<float>(y);
                         auto* code = codes.ptr<std::uint16_t>(y);
                         for (int x = 0; x < depth.cols; ++x) {
                           const double px = camera.focal_baseline / static_cast<double>(z[x]);
                           const double steps = px * kDisparitySteps + 0.5;
                           const bool fits = z[x] > 0 && steps < kMostCode + 1;
                           code[x] = fits ? static_cast<std::uint16_t>(steps) : std::uint16_t{0};
                         }
                       }
                       return encode_png(codes);
                     }});
  }
  return tasks;
}

FlowTruth flow_between(const DatasetFrame& a, const DatasetFrame& b, std::size_t camera,
                       const Pose& T_body_cam) {
  TruthView from = a.truth.views.at(camera);
  const TruthView& to = b.truth.views.at(camera);
  from.image.motion = from.image.motion.clone();  // not the frame's own
  const Pose T_cam_body = T_body_cam.inverse();
  move_rover(from.camera, from.T_world_cam, from.T_world_cam * T_cam_body,
             to.T_world_cam * T_cam_body, from.image.labels, from.image.depth, from.image.motion);
  return optical_flow(from, to);
}

cv::Mat kitti_flow(const cv::Mat& flow) {
  cv::Mat codes(flow.size(), CV_16UC3);
  for (int y = 0; y < flow.rows; ++y) {
    const auto* f = flow.ptr<cv::Vec2f>(y);
    auto* code = codes.ptr<cv::Vec3w>(y);
    for (int x = 0; x < flow.cols; ++x) {
      const double u = static_cast<double>(f[x][0]) * kFlowSteps + kFlowZero + 0.5;
      const double v = static_cast<double>(f[x][1]) * kFlowSteps + kFlowZero + 0.5;
      const auto fits = [](double step) { return step >= 0 && step < kMostCode + 1; };  // not NaN
      code[x] = fits(u) && fits(v)
                    ? cv::Vec3w(static_cast<std::uint16_t>(u), static_cast<std::uint16_t>(v), 1)
                    : cv::Vec3w(0, 0, 0);
    }
  }
  return codes;
}

FlowFormat::FlowFormat(const Folders& folders, const RecordingNotes& notes)
    : folders_(folders), cameras_(notes.true_cameras) {
  for (const RigCamera& camera : cameras_) {
    if (camera.model.has_distortion()) {
      fail("flow: camera '{}' has lens distortion, expected ideal pinholes", camera.name);
    }
    if (!folders.kitti.empty()) make_folder(folders.kitti / camera.name);
    if (!folders.kitti.empty()) make_folder(folders.kitti / "visible" / camera.name);
    if (!folders.flo.empty()) make_folder(folders.flo / camera.name);
  }
}

std::vector<FileTask> FlowFormat::files(const std::shared_ptr<const DatasetFrame>& frame) {
  const std::shared_ptr<const DatasetFrame> before = std::exchange(before_, frame);
  std::vector<FileTask> tasks;
  if (before == nullptr) return tasks;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!delivered(*before, i) || !delivered(*frame, i)) continue;
    const fs::path kitti = folders_.kitti / cameras_[i].name / numbered(before->number, "png");
    const fs::path flo = folders_.flo / cameras_[i].name / numbered(before->number, "flo");
    const auto truth = [this, before, frame, i] {
      return flow_between(*before, *frame, i, cameras_[i].T_body_cam);
    };
    if (folders_.kitti.empty()) {
      tasks.push_back(
          {fmt::format("flo {}", i), flo, [truth] { return encode_flo(truth().flow); }});
      continue;
    }
    // All come of one computation; its thread writes the others too.
    const fs::path mask =
        folders_.kitti / "visible" / cameras_[i].name / numbered(before->number, "png");
    tasks.push_back({fmt::format("flow {}", i), kitti, [this, truth, mask, flo] {
                       const FlowTruth flow = truth();
                       write_file_atomically(mask, encode_png(flow.visible));
                       if (!folders_.flo.empty()) write_file_atomically(flo, encode_flo(flow.flow));
                       return encode_png(kitti_flow(flow.flow));
                     }});
  }
  return tasks;
}

std::int32_t instance_id(const SceneIndex& scene, std::int32_t number) {
  constexpr std::int32_t kRover = 1;
  constexpr std::int32_t kMost = 0xffffff;
  switch (scene.thing(number)) {
    case Thing::kNone:
    case Thing::kGround:
    case Thing::kCover:
      return 0;
    case Thing::kRover:
      return kRover;
    default:
      break;
  }
  if (number > kMost) fail("instances: number {} does not fit into 24 bits", number);
  return number;
}

cv::Mat id_colours(const cv::Mat& ids) {
  cv::Mat colours(ids.size(), CV_8UC3);
  for (int y = 0; y < ids.rows; ++y) {
    const auto* id = ids.ptr<std::int32_t>(y);
    auto* colour = colours.ptr<cv::Vec3b>(y);
    for (int x = 0; x < ids.cols; ++x) {
      colour[x] = {static_cast<std::uint8_t>(id[x]), static_cast<std::uint8_t>(id[x] >> 8),
                   static_cast<std::uint8_t>(id[x] >> 16)};
    }
  }
  return colours;
}

InstanceFormat::InstanceFormat(const fs::path& folder, const RecordingNotes& notes,
                               const SceneIndex& scene)
    : folder_(folder),
      cameras_(make_camera_folders(folder, notes)),
      scene_(scene),
      table_(folder / "instances.csv") {
  table_.append("#id,thing,number of its kind,bunch,model,red,green,blue\n");
}

void InstanceFormat::name_new_ones(const cv::Mat& instances) {
  std::int32_t last = 0;
  for (int y = 0; y < instances.rows; ++y) {
    const auto* number = instances.ptr<std::int32_t>(y);
    for (int x = 0; x < instances.cols; ++x) {
      if (number[x] == last) continue;
      last = number[x];
      if (ids_.contains(last)) continue;
      const std::int32_t id = ids_[last] = last == 0 ? 0 : instance_id(scene_, last);
      if (id == 0) continue;
      const InstanceName name = scene_.name(last);
      const cv::Vec3b colour = instance_colour(last);
      table_.append(fmt::format("{},{},{},{},{},{},{},{}\n", id, name_of(name.thing), name.id,
                                name.part, name.model, colour[0], colour[1], colour[2]));
    }
  }
}

std::vector<FileTask> InstanceFormat::files(const std::shared_ptr<const DatasetFrame>& frame) {
  std::vector<FileTask> tasks;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!delivered(*frame, i)) continue;
    name_new_ones(truth_of(*frame, i).instances);
    tasks.push_back({fmt::format("instances {}", i),
                     folder_ / cameras_[i] / numbered(frame->number, "png"), [this, frame, i] {
                       const cv::Mat& numbers = truth_of(*frame, i).instances;
                       cv::Mat ids(numbers.size(), CV_32SC1, cv::Scalar(0));
                       std::int32_t last = 0;
                       std::int32_t id = 0;
                       for (int y = 0; y < numbers.rows; ++y) {
                         for (int x = 0; x < numbers.cols; ++x) {
                           const auto number = numbers.at<std::int32_t>(y, x);
                           if (number != last) id = instance_id(scene_, last = number);
                           ids.at<std::int32_t>(y, x) = id;
                         }
                       }
                       return encode_png(id_colours(ids));
                     }});
  }
  return tasks;
}

}  // namespace vinebench::harness

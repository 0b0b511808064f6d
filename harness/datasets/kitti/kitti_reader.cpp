// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/kitti/kitti_reader.h"

#include <algorithm>
#include <array>
#include <map>

#include "core/files/input_file.h"
#include "core/util/error.h"
#include "harness/datasets/files/text_table.h"
#include "harness/datasets/kitti/kitti_images.h"
#include "harness/datasets/kitti/kitti_projection.h"
#include "harness/datasets/reading/groundtruth.h"
#include "harness/datasets/reading/recorded_images.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMatrixSize = 12;
constexpr std::size_t kCameras = 2;

/// The folders of a stereo pair, and its lines of calib.txt.
struct Layout {
  const char* left;
  const char* right;
  std::size_t left_matrix;
  std::size_t right_matrix;
};

constexpr std::array<Layout, 5> kLayouts{{{"image_0", "image_1", 0, 1},
                                          {"image_2", "image_3", 2, 3},
                                          {"image_l", "image_r", 0, 1},
                                          {"image_left", "image_right", 0, 1},
                                          {"left", "right", 0, 1}}};

const Layout* find_layout(const fs::path& folder) {
  std::error_code ignored;
  for (const Layout& layout : kLayouts) {
    if (fs::is_directory(folder / layout.left, ignored)) return &layout;
  }
  return nullptr;
}

Projection projection_of(const TableRow& row, std::size_t first) {
  if (row.fields.size() - first != kMatrixSize) {
    row.fault(fmt::format("expected 12 numbers (3 x 4, row by row), found {}",
                          row.fields.size() - first));
  }
  Projection P;
  for (std::size_t i = 0; i < kMatrixSize; ++i) {
    P(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = row.number(first + i);
  }
  if (!is_projection(P)) row.fault(kProjectionExpected);
  return P;
}

/// The matrices by number: from the label `P2:`, otherwise from the line's position.
std::map<std::size_t, Projection> read_projections(const fs::path& file) {
  std::map<std::size_t, Projection> matrices;
  for (const TableRow& row : read_rows(file)) {
    const std::string& label = row.fields.front();
    if (is_number(label)) {
      matrices[matrices.size()] = projection_of(row, 0);
    } else if (label.size() == 3 && label[0] == 'P' && label[2] == ':') {
      matrices[static_cast<std::size_t>(label[1] - '0')] = projection_of(row, 1);
    }  // others, such as Tr:, belong to the laser scanner
  }
  return matrices;
}

/// The body is at the first camera (P0), whose poses are in poses.txt.
Pose first_camera_mount() {
  return Rig::mount(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
}

RigCamera camera_of(const std::string& name, const Projection& P) {
  RigCamera camera = camera_of_projection(P);
  camera.name = name;
  camera.T_body_cam = first_camera_mount() * camera.T_body_cam;
  return camera;
}

Rig read_rig(const fs::path& folder, const Layout& layout) {
  const fs::path file = folder / "calib.txt";
  const auto matrices = read_projections(file);
  for (const std::size_t wanted : {layout.left_matrix, layout.right_matrix}) {
    if (matrices.contains(wanted)) continue;
    fail("{}: expected a matrix P{} for the images in {} and {}", file.string(), wanted,
         layout.left, layout.right);
  }
  Rig rig;
  rig.name = "KITTI";
  rig.cameras = {camera_of("left", matrices.at(layout.left_matrix)),
                 camera_of("right", matrices.at(layout.right_matrix))};
  rig.stereo_pairs = {{"front", 0, 1}};
  return rig;
}

/// One frame for every number from the first to the last of either camera.
std::vector<RecordedFrame> read_frames(const fs::path& folder, const Layout& layout) {
  const auto left = images_in(folder / layout.left);
  const auto right = images_in(folder / layout.right);
  const std::int64_t first = std::min(left.begin()->first, right.begin()->first);
  const std::int64_t last = std::max(left.rbegin()->first, right.rbegin()->first);
  const auto most = static_cast<std::int64_t>(10 * (left.size() + right.size()));
  if (last - first >= most) {
    fail("{}: expected images numbered without great gaps, found {} to {} for {} and {} images",
         folder.string(), first, last, left.size(), right.size());
  }
  std::vector<RecordedFrame> frames;
  for (std::int64_t number = first; number <= last; ++number) {
    const auto of = [&](const auto& camera) {
      const auto found = camera.find(number);
      return found == camera.end() ? fs::path() : found->second;
    };
    frames.push_back({stamp_of_frame(number - first, kKittiRate), {of(left), of(right)}, {}});
  }
  return frames;
}

/// Stamps from times.txt, a line a frame; the frames' rate.
void read_times(const fs::path& folder, Recording& recording) {
  recording.rig.rate_hz = kKittiRate;
  const fs::path file = folder / "times.txt";
  if (!is_present(file)) return;
  const std::vector<TableRow> rows = read_table(file);
  std::vector<RecordedFrame>& frames = recording.frames;
  if (rows.size() != frames.size()) {
    fail("{}: expected {} lines, one a frame, found {}", file.string(), frames.size(), rows.size());
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    frames[i].stamp = rows[i].seconds(0);
    if (i > 0 && frames[i].stamp <= frames[i - 1].stamp) {
      rows[i].fault("expected a later time than the line before");
    }
  }
  const double seconds = to_seconds(frames.back().stamp - frames.front().stamp);
  if (frames.size() > 1) recording.rig.rate_hz = static_cast<double>(frames.size() - 1) / seconds;
}

/// In the folder itself, or as in the original data set: sequences/00 and poses/00.txt.
fs::path find_poses(const fs::path& folder) {
  const fs::path whole = fs::weakly_canonical(folder);
  const fs::path original =
      whole.parent_path().parent_path() / "poses" / (whole.filename().string() + ".txt");
  for (const fs::path& file : {folder / "poses.txt", original}) {
    if (is_present(file)) return file;
  }
  return {};
}

/// Extensions of our recordings; optional.
fs::path ours(const fs::path& file) {
  return is_present(file) ? file : fs::path();
}

/// The size is taken from the images; calib.txt does not have it.
void set_sizes(Recording& recording) {
  for (std::size_t camera = 0; camera < recording.rig.cameras.size(); ++camera) {
    PinholeCamera& model = recording.rig.cameras[camera].model;
    const cv::Size size = first_image_size(recording, camera);
    if (size.empty()) {
      fail("{}: no image of the {} camera can be read",
           recording.frames.front().images[camera].string(), recording.rig.cameras[camera].name);
    }
    model.width = size.width;
    model.height = size.height;
  }
}

}  // namespace

bool is_kitti(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / "calib.txt", ignored) || find_layout(folder) != nullptr;
}

Recording read_kitti(const fs::path& folder, const RecordingOptions& options) {
  const Layout* layout = find_layout(folder);
  if (layout == nullptr) {
    fail(
        "{}: expected the folders image_0 and image_1, image_2 and image_3, or image_l and "
        "image_r beside calib.txt",
        folder.string());
  }
  Recording recording;
  recording.format = "KITTI odometry";
  const fs::path rig = options.rig.empty() ? ours(folder / "rig.yaml") : options.rig;
  if (rig.empty()) {
    recording.rig = read_rig(folder, *layout);
  } else {
    set_rig(rig, kCameras, recording);
  }
  recording.T_body_left =
      rig.empty() ? first_camera_mount() : recording.rig.cameras.front().T_body_cam;
  recording.settings = ours(folder / "slam.yaml");
  recording.frames = read_frames(folder, *layout);
  read_times(folder, recording);
  delay_images(recording);  // the poses are those of the frames
  if (rig.empty()) set_sizes(recording);
  const fs::path poses = find_poses(folder);
  if (options.groundtruth.empty() && !poses.empty()) {
    recording.truth = read_groundtruth(poses, recording);
  }
  return recording;
}

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>

#include "harness/datasets/files/append_file.h"
#include "harness/datasets/files/image_codec.h"
#include "harness/datasets/format/dataset_format.h"

namespace vinebench::harness {

// Images a camera: FOLDER/<camera>/000012.png and so on. Docs: docs/datasets.md.

/// A format that makes one file of each camera's image or truth.
class ImageFormat : public DatasetFormat {
 public:
  /// The bytes for a camera of a frame; a camera that delivered nothing is passed over.
  using Encode = std::function<std::string(const DatasetFrame&, std::size_t camera)>;

  /// `name` keeps it apart from other formats; `ending` is the files'.
  ImageFormat(const std::filesystem::path& folder, const RecordingNotes& notes, std::string name,
              std::string ending, Encode encode);

  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) override;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> cameras_;
  std::string name_;
  std::string ending_;
  Encode encode_;
};

std::unique_ptr<DatasetFormat> make_rgb_format(const std::filesystem::path& folder,
                                               const RecordingNotes& notes, ImageKind kind);
/// 16-bit PNG in mm, 0 for sky and beyond 65.535 m.
std::unique_ptr<DatasetFormat> make_depth_format(const std::filesystem::path& folder,
                                                 const RecordingNotes& notes);
/// NumPy files of floats, m, 0 for sky.
std::unique_ptr<DatasetFormat> make_depth32_format(const std::filesystem::path& folder,
                                                   const RecordingNotes& notes);
/// Red to the right, green up, blue towards the camera, each from -1 (0) to 1 (255).
std::unique_ptr<DatasetFormat> make_normals_format(const std::filesystem::path& folder,
                                                   const RecordingNotes& notes);
/// 8-bit PNG of Label, and labels.yaml with names and colours.
std::unique_ptr<DatasetFormat> make_semantic_format(const std::filesystem::path& folder,
                                                    const RecordingNotes& notes);

/// Disparity of every rectified pair's left camera, 16-bit PNG in 1/256 px, 0 for none. Throws
/// Error where a pair is not rectified, or there is none.
class DisparityFormat : public DatasetFormat {
 public:
  DisparityFormat(const std::filesystem::path& folder, const RecordingNotes& notes);
  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) override;

 private:
  struct Camera {
    std::size_t camera;
    std::string name;
    double focal_baseline;  ///< px m
  };
  std::filesystem::path folder_;
  std::vector<Camera> cameras_;
};

/// Flow from each frame to the next one of the data set, as 16-bit PNG of KITTI (1/64 px around
/// 2^15, blue 1 where known) and as Middlebury's .flo, and beside KITTI's a mask of what the next
/// frame still shows. Throws Error for cameras with distortion.
class FlowFormat : public DatasetFormat {
 public:
  struct Folders {
    std::filesystem::path kitti;  ///< none where empty
    std::filesystem::path flo;    ///< likewise
  };
  FlowFormat(const Folders& folders, const RecordingNotes& notes);
  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) override;

 private:
  Folders folders_;
  std::vector<RigCamera> cameras_;
  std::shared_ptr<const DatasetFrame> before_;
};

/// Truth flow of a camera from one frame to the next, the rover's own pixels included.
FlowTruth flow_between(const DatasetFrame& a, const DatasetFrame& b, std::size_t camera,
                       const Pose& T_body_cam);

/// KITTI's code of a flow, CV_16UC3 (RGB).
cv::Mat kitti_flow(const cv::Mat& flow);

/// Depth (m) as CV_16UC1 in mm; 0 beyond 65.535 m.
cv::Mat millimetres(const cv::Mat& depth);

/// Instances as RGB images, id = R + 256 G + 65536 B: a plant, post, tag, box or person has
/// RenderedImage::instances' own number (its low byte says which bunch), the rover 1, all else 0;
/// and instances.csv, which says what the numbers are.
class InstanceFormat : public DatasetFormat {
 public:
  InstanceFormat(const std::filesystem::path& folder, const RecordingNotes& notes,
                 const SceneIndex& scene);
  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) override;

 private:
  void name_new_ones(const cv::Mat& instances);

  std::filesystem::path folder_;
  std::vector<std::string> cameras_;
  const SceneIndex& scene_;
  AppendFile table_;
  std::map<std::int32_t, std::int32_t> ids_;  ///< of every number seen so far
};

/// Ids (CV_32SC1, 0 to 2^24 - 1) as RGB.
cv::Mat id_colours(const cv::Mat& ids);

/// The id that a number of RenderedImage::instances has in images. Throws Error above 2^24 - 1.
std::int32_t instance_id(const SceneIndex& scene, std::int32_t number);

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "harness/datasets/format/label_images.h"
#include "tests/support/test_folder.h"

namespace vinebench::test {

/// A sequence of two frames at the world's origin, with label images of one camera of 4 x 3 pixels,
/// fx = 10 px, that looks along the world's x axis.
class LabelFolder {
 public:
  static constexpr int kLabelWidth = 4;
  static constexpr int kLabelHeight = 3;

  LabelFolder() {
    sequence_.folder = folder_.path();
    sequence_.frames = {{0, {}}, {1, {}}};
    RigCamera camera;
    camera.name = "left";
    camera.model = {
        .width = kLabelWidth, .height = kLabelHeight, .fx = 10, .fy = 10, .cx = 1.5, .cy = 1};
    camera.T_body_cam = Rig::mount(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
    sequence_.rig.cameras.push_back(camera);
  }

  /// An image of this value at frame 0.
  static cv::Mat filled(int type, const cv::Scalar& value) {
    return {kLabelHeight, kLabelWidth, type, value};
  }
  void put(const std::string& format, const cv::Mat& image) const {
    std::filesystem::create_directories(folder_ / (format + "/left"));
    cv::imwrite((folder_ / (format + "/left/000000.png")).string(), image);
  }
  harness::RecordedSequence& sequence() { return sequence_; }

  /// What a check finds at frame 0: "file: problem" each.
  template <class Check>
  std::vector<std::string> faults_of(const Check& check) const {
    std::vector<harness::DatasetFault> faults;
    harness::LabelImages images(sequence_, 0, 0, faults);
    check(images);
    std::vector<std::string> texts;
    for (const harness::DatasetFault& fault : faults) {
      texts.push_back(fault.file + ": " + fault.problem);
    }
    return texts;
  }

 private:
  TestFolder folder_;
  harness::RecordedSequence sequence_;
};

}  // namespace vinebench::test

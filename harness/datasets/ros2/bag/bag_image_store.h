// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_map>

#include "harness/datasets/reading/image_association.h"
#include "harness/datasets/reading/recording.h"
#include "harness/datasets/ros2/bag/bag_cameras.h"

namespace vinebench::harness {

/// Reads images out of a bag.
class BagImageStore : public ImageStore {
 public:
  explicit BagImageStore(const BagContents& contents) : files_(contents.files) {}

  /// Names the images of a camera, and lists them in order of time.
  ImageList add(const BagContents& contents, const BagCamera& camera);

  cv::Mat read_grey(const std::filesystem::path& image) const override;

 private:
  struct Place {
    std::size_t file = 0;
    MessagePlace message;
    bool compressed = false;
  };
  std::vector<std::shared_ptr<BagFile>> files_;
  std::unordered_map<std::string, Place> places_;
};

/// A message's image, 8-bit grey; Throws Error for a size that does not agree with the data and for
/// another encoding than mono8, rgb8, bgr8, rgba8, bgra8, 8UC1 and 8UC3. `name` is for errors.
cv::Mat grey_of_message(const EncodedMessage& message, bool compressed, const std::string& name);

}  // namespace vinebench::harness

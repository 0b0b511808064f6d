// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/bag_image_store.h"

#include <array>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/files/image_size.h"
#include "core/util/error.h"
#include "harness/datasets/files/image_file.h"
#include "harness/datasets/reading/recorded_images.h"
#include "harness/datasets/ros2/cdr/ros2_messages.h"

namespace vinebench::harness {
namespace {

/// How an encoding's pixels become grey.
struct Encoding {
  const char* name;
  int channels;
  int conversion;  ///< of cv::cvtColor; unused for grey
};

constexpr std::array<Encoding, 7> kEncodings{{{"mono8", 1, 0},
                                              {"8UC1", 1, 0},
                                              {"rgb8", 3, cv::COLOR_RGB2GRAY},
                                              {"bgr8", 3, cv::COLOR_BGR2GRAY},
                                              {"8UC3", 3, cv::COLOR_BGR2GRAY},
                                              {"rgba8", 4, cv::COLOR_RGBA2GRAY},
                                              {"bgra8", 4, cv::COLOR_BGRA2GRAY}}};

const Encoding& encoding_of(const PaddedImage& image, const std::string& name) {
  for (const Encoding& encoding : kEncodings) {
    if (image.encoding == encoding.name) return encoding;
  }
  fail("{}: expected the encoding mono8, rgb8 or bgr8, found '{}'", name, image.encoding);
}

cv::Mat grey_of_raw(const PaddedImage& image, const std::string& name) {
  const Encoding& encoding = encoding_of(image, name);
  const double pixels = double{1} * image.width * image.height;
  if (pixels < 1 || pixels > kMostPixels) {
    fail("{}: expected 1 to {:.0f} pixels, found {} x {}", name, kMostPixels, image.width,
         image.height);
  }
  const std::uint64_t row = std::uint64_t{image.width} * static_cast<unsigned>(encoding.channels);
  if (image.step < row || std::uint64_t{image.step} * image.height > image.bytes.size()) {
    fail("{}: expected {} rows of {} bytes or more, found {} bytes in rows of {}", name,
         image.height, row, image.bytes.size(), image.step);
  }
  const cv::Mat whole(static_cast<int>(image.height), static_cast<int>(image.width),
                      CV_8UC(encoding.channels), const_cast<char*>(image.bytes.data()), image.step);
  if (encoding.channels == 1) return whole.clone();  // the message ends with this function
  cv::Mat grey;
  cv::cvtColor(whole, grey, encoding.conversion);
  return grey;
}

}  // namespace

cv::Mat grey_of_message(const EncodedMessage& message, bool compressed, const std::string& name) {
  if (!compressed) return grey_of_raw(decode_image(message), name);
  return grey_of_decoded(decode_image(decode_compressed_image(message).bytes, name,
                                      cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION));
}

ImageList BagImageStore::add(const BagContents& contents, const BagCamera& camera) {
  const BagImages& images = contents.images.at(camera.topic);
  ImageList list;
  list.camera = camera.name;
  for (const BagImages::Entry& entry : images.entries) {
    const std::string name =
        fmt::format("{}:{}:{}", contents.names[entry.file].string(), camera.topic, entry.stamp);
    places_.try_emplace(name,
                        Place{entry.file, entry.place, images.type == ros2::kCompressedImage});
    list.entries.push_back({entry.stamp, name});
  }
  put_in_order(list);
  return list;
}

cv::Mat BagImageStore::read_grey(const std::filesystem::path& image) const {
  const auto place = places_.find(image.string());
  if (place == places_.end()) fail("{}: is not in the bag", image.string());
  const auto& [file, message, compressed] = place->second;
  const std::string bytes = files_[file]->read(message);
  return grey_of_message({bytes, files_[file]->coding()}, compressed, image.string());
}

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/format_writer.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "core/util/error.h"
#include "harness/datasets/files/image_codec.h"

namespace vinebench::harness {

std::string numbered(std::int64_t number, const std::string& ending) {
  return fmt::format("{:06}.{}", number, ending);
}

FileTask camera_image(const std::shared_ptr<const DatasetFrame>& frame, std::size_t camera,
                      bool colour, std::filesystem::path file) {
  return {fmt::format("{} png {}", colour ? "rgb" : "grey", camera), std::move(file),
          [frame, camera, colour] {
            const cv::Mat& image = frame->frame.images[camera];
            return encode_png(colour ? image : to_grey(image), PngContent::kNoise);
          }};
}

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/processing/jpeg.h"

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

class Jpeg : public CodeEffect {
 public:
  explicit Jpeg(int quality) : quality_(quality) {}
  /// 4:2:0 is the encoder's default. Its colours are BGR.
  void apply(cv::Mat& codes, const Shot&) override {
    cv::cvtColor(codes, bgr_, cv::COLOR_RGB2BGR);
    if (!cv::imencode(".jpg", bgr_, file_, {cv::IMWRITE_JPEG_QUALITY, quality_})) {
      fail("jpeg: an image of {} x {} pixels cannot be encoded", codes.cols, codes.rows);
    }
    cv::cvtColor(cv::imdecode(file_, cv::IMREAD_COLOR), codes, cv::COLOR_BGR2RGB);
  }

 private:
  int quality_;
  cv::Mat bgr_;
  std::vector<std::uint8_t> file_;
};

}  // namespace

std::unique_ptr<CodeEffect> make_jpeg(const JpegConfig& config) {
  if (!config.quality) return nullptr;
  return std::make_unique<Jpeg>(*config.quality);
}

}  // namespace vinebench::sim

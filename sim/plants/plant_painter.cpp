// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/plant_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace vinebench::sim {
namespace {

constexpr int kSamples = 3;        // per side of a pixel
constexpr int kTextureShrink = 4;  // for distant views
constexpr float kGamma = 2.2f;     // the shaders'

/// Light on a surface, up to a factor, under a sky that is brightest above and in front of it.
float light_on(const Eigen::Vector3f& normal, const Eigen::Vector3f& towards, float occlusion) {
  const Eigen::Vector3f n = normal.dot(towards) < 0 ? Eigen::Vector3f(-normal) : normal;
  return occlusion * (0.55f + 0.45f * n.z()) * (0.40f + 0.60f * n.dot(towards));
}

struct Sample {
  float depth = -std::numeric_limits<float>::infinity();
  float light = 0;
  float occlusion = 0;
  cv::Vec3b colour;
};

struct Projected {
  float x, y, depth, light, occlusion;
  Eigen::Vector2f uv;
  std::array<std::uint8_t, 3> tint;
};

class Canvas {
 public:
  explicit Canvas(const PaintWindow& window)
      : window_(window),
        size_(window.size * kSamples),
        samples_(static_cast<std::size_t>(size_.area())) {}

  void draw(const Primitive& part, const cv::Mat& texture) {
    for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
      triangle(project(part.vertices[part.indices[i]]), project(part.vertices[part.indices[i + 1]]),
               project(part.vertices[part.indices[i + 2]]), texture);
    }
  }

  PlantPainting finish() const {
    PlantPainting out;
    const auto [light, occlusion] = means();
    const cv::Vec3f mean = mean_colour();
    out.occlusion = occlusion;
    out.rgba.create(window_.size, CV_8UC4);
    out.depth.create(window_.size, CV_32F);
    for (int y = 0; y < window_.size.height; ++y) {
      for (int x = 0; x < window_.size.width; ++x) {
        resolve(x, y, light, mean, out);
      }
    }
    return out;
  }

 private:
  Projected project(const Vertex& v) const {
    const Eigen::Vector2f span = window_.to - window_.from;
    const float across = (v.position.dot(window_.right) - window_.from.x()) / span.x();
    const float up = (v.position.z() - window_.from.y()) / span.y();
    return {across * static_cast<float>(size_.width),
            (1 - up) * static_cast<float>(size_.height),
            v.position.dot(window_.towards),
            light_on(v.normal, window_.towards, v.occlusion),
            v.occlusion,
            v.uv,
            v.colour};
  }

  void triangle(const Projected& a, const Projected& b, const Projected& c,
                const cv::Mat& texture) {
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (std::abs(area) < 1e-6f) return;
    const int x0 = std::max(0, static_cast<int>(std::floor(std::min({a.x, b.x, c.x}))));
    const int x1 =
        std::min(size_.width - 1, static_cast<int>(std::ceil(std::max({a.x, b.x, c.x}))));
    const int y0 = std::max(0, static_cast<int>(std::floor(std::min({a.y, b.y, c.y}))));
    const int y1 =
        std::min(size_.height - 1, static_cast<int>(std::ceil(std::max({a.y, b.y, c.y}))));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
        const float wb = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) / area;
        const float wc = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
        if (wb >= 0 && wc >= 0 && wb + wc <= 1)
          sample(x, y, a, b, c, {1 - wb - wc, wb, wc}, texture);
      }
    }
  }

  void sample(int x, int y, const Projected& a, const Projected& b, const Projected& c,
              const Eigen::Vector3f& w, const cv::Mat& texture) {
    Sample& s = samples_[static_cast<std::size_t>(y * size_.width + x)];
    const float depth = w.dot(Eigen::Vector3f(a.depth, b.depth, c.depth));
    if (depth <= s.depth) return;
    const Eigen::Vector2f uv = w[0] * a.uv + w[1] * b.uv + w[2] * c.uv;
    s.depth = depth;
    s.light = w.dot(Eigen::Vector3f(a.light, b.light, c.light));
    s.occlusion = w.dot(Eigen::Vector3f(a.occlusion, b.occlusion, c.occlusion));
    const auto texel = [](float t, int n) {
      return std::clamp(static_cast<int>((t - std::floor(t)) * static_cast<float>(n)), 0, n - 1);
    };
    s.colour = texture.at<cv::Vec3b>(texel(uv.y(), texture.rows), texel(uv.x(), texture.cols));
    for (int i = 0; i < 3; ++i) {
      s.colour[i] = static_cast<std::uint8_t>(s.colour[i] * a.tint.at(i) / 255);  // as shaders do
    }
  }

  /// Means of light and occlusion over all visible pixels.
  std::pair<float, float> means() const {
    double light = 0, occlusion = 0, count = 0;
    for (const Sample& s : samples_) {
      if (!std::isfinite(s.depth)) continue;
      light += s.light;
      occlusion += s.occlusion;
      ++count;
    }
    if (count == 0) return {1.0f, 1.0f};
    return {static_cast<float>(light / count), static_cast<float>(occlusion / count)};
  }

  cv::Vec3f mean_colour() const {
    cv::Vec3d sum(0, 0, 0);
    double count = 0;
    for (const Sample& s : samples_) {
      if (!std::isfinite(s.depth)) continue;
      sum += cv::Vec3d(s.colour);
      ++count;
    }
    return count == 0 ? cv::Vec3f(0, 0, 0) : cv::Vec3f(sum / count);
  }

  void resolve(int x, int y, float mean_light, const cv::Vec3f& mean, PlantPainting& out) const {
    cv::Vec3f sum(0, 0, 0);
    float depth = 0, count = 0;
    for (int i = 0; i < kSamples * kSamples; ++i) {
      const int at = (y * kSamples + i / kSamples) * size_.width + x * kSamples + i % kSamples;
      const Sample& s = samples_[static_cast<std::size_t>(at)];
      if (!std::isfinite(s.depth)) continue;
      const float shade = std::clamp(s.light / mean_light, 0.15f, 2.5f);
      for (int c = 0; c < 3; ++c) {
        sum[c] += shade * std::pow(static_cast<float>(s.colour[c]) / 255.0f, kGamma);
      }
      depth += s.depth;
      ++count;
    }
    cv::Vec4b& to = out.rgba.at<cv::Vec4b>(y, x);
    for (int c = 0; c < 3; ++c) {
      const float value = count > 0 ? 255 * std::pow(sum[c] / count, 1 / kGamma) : mean[c];
      to[c] = cv::saturate_cast<uchar>(value);
    }
    to[3] = cv::saturate_cast<uchar>(255 * count / (kSamples * kSamples));
    out.depth.at<float>(y, x) = count > 0 ? depth / count : std::numeric_limits<float>::quiet_NaN();
  }

  const PaintWindow& window_;
  cv::Size size_;
  std::vector<Sample> samples_;
};

cv::Mat shrunk(const Texture& texture) {
  cv::Mat rgb, small;
  cv::cvtColor(texture.rgba, rgb, cv::COLOR_RGBA2RGB);
  const cv::Size size(std::max(1, rgb.cols / kTextureShrink),
                      std::max(1, rgb.rows / kTextureShrink));
  cv::resize(rgb, small, size, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace

PlantPainting paint_plant(const std::vector<Primitive>& parts, const std::vector<Texture>& textures,
                          const std::vector<Material>& materials, const PaintWindow& window) {
  std::vector<cv::Mat> images;
  for (const Texture& texture : textures) images.push_back(shrunk(texture));
  const cv::Mat white(1, 1, CV_8UC3, cv::Scalar::all(255));
  Canvas canvas(window);
  for (const Primitive& part : parts) {
    const int texture = materials.at(static_cast<std::size_t>(part.material)).texture;
    canvas.draw(part, texture < 0 ? white : images.at(static_cast<std::size_t>(texture)));
  }
  return canvas.finish();
}

}  // namespace vinebench::sim

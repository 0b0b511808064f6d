// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/realism_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/util/base64.h"
#include "core/util/error.h"
#include "core/util/xml_text.h"
#include "harness/datasets/files/image_file.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kPictures = 8;  // of each set
constexpr int kShownWidth = 560;      // px
constexpr int kQuality = 85;          // of JPEG

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Realism</title>
<meta name="viewport" content="width=device-width, initial-scale=1"><style>
:root { color-scheme: light dark; }
body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 76rem; padding: 0 1rem; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .15rem .7rem; text-align: right; } th:first-child, td:first-child { text-align: left; }
tr.outside td:first-child { font-weight: 600; }
.range { position: relative; width: 14rem; height: .8rem; background: #8884; }
.range .band { position: absolute; left: 10%; width: 80%; height: 100%; background: #4a85; }
.range .mark { position: absolute; width: 3px; margin-left: -1px; height: 100%; background: currentColor; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: .6rem; margin: .6rem 0; }
.pair img { width: 100%; } .pair span { opacity: .7; }
</style></head><body>
)";

std::string image_of(const MeasuredPicture& picture, int width) {
  const cv::Mat bgr = read_image(picture.file, cv::IMREAD_COLOR);
  if (bgr.empty()) fail("{}: damaged", picture.file.string());
  cv::Mat shown;
  const cv::Mat cut = standard_picture(bgr, width);
  cv::resize(cut, shown, {kShownWidth, cut.rows * kShownWidth / cut.cols}, 0, 0, cv::INTER_AREA);
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", shown, bytes, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  return fmt::format("<img alt=\"{}\" src=\"data:image/jpeg;base64,{}\">",
                     xml_escaped(picture.name),
                     base64({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
}

/// Evenly spread over the set, those whose files are known.
std::vector<MeasuredPicture> shown_of(const PictureSet& set) {
  std::vector<MeasuredPicture> known;
  std::ranges::copy_if(set.pictures, std::back_inserter(known),
                       [](const MeasuredPicture& picture) { return !picture.file.empty(); });
  std::vector<MeasuredPicture> shown;
  const std::size_t count = std::min(kPictures, known.size());
  for (std::size_t i = 0; i < count; ++i) shown.push_back(known[i * known.size() / count]);
  return shown;
}

std::string row_of(const StatisticComparison& s) {
  return fmt::format(
      "<tr class=\"{}\"><td>{}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td>"
      "<td>{:.0f} %</td><td><div class=\"range\" role=\"img\" aria-label=\"{:.0f} % of the real "
      "pictures are below\"><div class=\"band\"></div><div class=\"mark\" style=\"left:{:.1f}%\">"
      "</div></div></td></tr>\n",
      s.inside() ? "inside" : "outside", xml_escaped(s.name), s.low, s.middle, s.high, s.ours,
      100 * s.share, 100 * s.share, 100 * s.share);
}

std::string pairs_of(const PictureSet& real, const PictureSet& ours) {
  const std::vector<MeasuredPicture> left = shown_of(real);
  const std::vector<MeasuredPicture> right = shown_of(ours);
  std::string text;
  for (std::size_t i = 0; i < std::max(left.size(), right.size()); ++i) {
    text += "<div class=\"pair\">";
    text +=
        i < left.size() ? image_of(left[i], real.width) : "<span>no real picture at hand</span>";
    text += i < right.size() ? image_of(right[i], ours.width) : "<span>none of ours</span>";
    text += "</div>\n";
  }
  return text;
}

}  // namespace

std::string realism_page(const PictureSet& real, const std::vector<RealismEntry>& entries) {
  std::string page = kHead;
  for (const auto& [realism, ours] : entries) {
    page +=
        fmt::format("<h1>{} against {}</h1>\n<p>{} of {} medians inside the real 10 to 90 % range",
                    xml_escaped(realism.ours), xml_escaped(realism.real), realism.inside(),
                    realism.statistics.size());
    if (realism.separability) page += fmt::format("; separability {:.2f}", *realism.separability);
    page += fmt::format(
        ". {} real pictures, {} of ours.</p>\n<table><tr><th>statistic</th><th>real 10 %</th>"
        "<th>median</th><th>90 %</th><th>ours</th><th>at</th><th>among the real ones</th></tr>\n",
        real.pictures.size(), ours.pictures.size());
    for (const StatisticComparison& statistic : realism.statistics) page += row_of(statistic);
    page += "</table>\n<h2>Real, ours</h2>\n" + pairs_of(real, ours);
  }
  return page + "</body></html>\n";
}

}  // namespace vinebench::harness

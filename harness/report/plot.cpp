// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/plot.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "core/util/xml_text.h"

namespace vinebench::harness {
namespace {

constexpr double kMargin = 0.6;                                      // m around everything
constexpr double kMaxWidth = 1000;                                   // px of the map
constexpr double kMaxHeight = 700;                                   // px
constexpr double kLeft = 60, kTop = 60, kRight = 230, kBottom = 60;  // px around the map
constexpr double kLegendHeight = 330;                                // px

/// Dark blue to yellow: readable for the colour-blind and in print (after the viridis scale).
constexpr std::array<const char*, 6> kScale{"#440154", "#414487", "#2a788e",
                                            "#22a884", "#7ad151", "#fde725"};

/// Draws in metres; the y axis is flipped here only.
class Drawing {
 public:
  explicit Drawing(const Eigen::AlignedBox2d& bounds) : bounds_(bounds) {
    scale_ = std::min(kMaxWidth / bounds.sizes().x(), kMaxHeight / bounds.sizes().y());
    width_ = scale_ * bounds.sizes().x();
    height_ = scale_ * bounds.sizes().y();
  }

  double x(double metres) const { return kLeft + scale_ * (metres - bounds_.min().x()); }
  double y(double metres) const { return kTop + scale_ * (bounds_.max().y() - metres); }
  double pixels(double metres) const { return scale_ * metres; }
  double width() const { return width_; }
  double height() const { return height_; }
  const Eigen::AlignedBox2d& bounds() const { return bounds_; }

  void add(const std::string& element) { body_ += element + "\n"; }
  void text(double px, double py, const std::string& words, const char* style = "") {
    add(fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>", px, py, style,
                    xml_escaped(words)));
  }
  void title(const std::string& words) {
    constexpr double kLetter = 10;  // px, mean width of a bold letter, upper bound
    text(kLeft, 30, words, "font-size=\"16\" font-weight=\"bold\"");
    title_end_ = 2 * kLeft + kLetter * static_cast<double>(words.size());
  }
  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const std::string& style) {
    add(fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" {}/>", x(a.x()),
                    y(a.y()), x(b.x()), y(b.y()), style));
  }
  void circle(const Eigen::Vector2d& centre, double radius_px, const std::string& style) {
    add(fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" {}/>", x(centre.x()),
                    y(centre.y()), radius_px, style));
  }
  void path(const std::vector<Eigen::Vector2d>& points, const std::string& style) {
    std::string list;
    for (const Eigen::Vector2d& p : points)
      list += fmt::format("{:.2f},{:.2f} ", x(p.x()), y(p.y()));
    if (!list.empty()) add(fmt::format("<polyline points=\"{}\" fill=\"none\" {}/>", list, style));
  }

  std::string document() const {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"13\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        "<clipPath id=\"map\"><rect x=\"{2}\" y=\"{3}\" width=\"{4:.1f}\" height=\"{5:.1f}\"/>"
        "</clipPath>\n{6}</svg>\n",
        std::max(width_ + kLeft + kRight, title_end_),
        std::max(height_ + kTop + kBottom, kLegendHeight), kLeft, kTop, width_, height_, body_);
  }

 private:
  Eigen::AlignedBox2d bounds_;
  double scale_ = 1, width_ = 0, height_ = 0;
  double title_end_ = 0;  ///< px
  std::string body_;
};

/// Bounds of site and true path, so that a diverged estimate does not change the scale; those of
/// the estimate if there is no truth.
Eigen::AlignedBox2d bounds_of(const Site& site, const RunRecord& record) {
  Eigen::AlignedBox2d bounds;
  for (const auto& row : site.rows) bounds.extend(row.start).extend(row.end);
  for (const WorldTag& tag : site.tags) {
    bounds.extend(tag.T_world_tag.translation.head<2>().eval());
  }
  for (const Site::Object& object : site.objects) {
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(object.size.norm() / 2);
    bounds.extend((object.centre - half).eval()).extend((object.centre + half).eval());
  }
  for (const Tick& tick : record.ticks) {
    if (tick.truth.known) bounds.extend(tick.truth.T_world_body.translation.head<2>().eval());
  }
  if (bounds.isEmpty()) {
    for (const StampedPose& at : record.summary.trajectory) {
      bounds.extend(at.pose.translation.head<2>().eval());
    }
  }
  if (bounds.isEmpty()) bounds.extend(Eigen::Vector2d::Zero().eval());
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kMargin);
  return {bounds.min() - margin, bounds.max() + margin};
}

void draw_axes(Drawing& drawing) {
  const Eigen::Vector2d low = drawing.bounds().min();
  const Eigen::Vector2d high = drawing.bounds().max();
  const double step = std::pow(10, std::ceil(std::log10((high - low).maxCoeff() / 20)));
  const char* grid = "stroke=\"#dddddd\" stroke-width=\"1\"";
  for (double x = std::ceil(low.x() / step) * step; x <= high.x(); x += step) {
    drawing.line({x, low.y()}, {x, high.y()}, grid);
    drawing.text(drawing.x(x), kTop + drawing.height() + 18, fmt::format("{:g}", x + 0.0),  // no -0
                 "text-anchor=\"middle\"");
  }
  for (double y = std::ceil(low.y() / step) * step; y <= high.y(); y += step) {
    drawing.line({low.x(), y}, {high.x(), y}, grid);
    drawing.text(kLeft - 8, drawing.y(y) + 4, fmt::format("{:g}", y + 0.0), "text-anchor=\"end\"");
  }
  drawing.text(kLeft + drawing.width() / 2, kTop + drawing.height() + 42, "x, east (m)",
               "text-anchor=\"middle\"");
  const double middle = kTop + drawing.height() / 2;
  drawing.text(
      16, middle, "y, north (m)",
      fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 16 {:.1f})\"", middle).c_str());
}

void draw_object(Drawing& drawing, const Site::Object& object) {
  const Eigen::Vector3d c = 255 * object.colour;
  drawing.add(
      fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
                  "transform=\"rotate({:.3f} {:.2f} {:.2f})\" fill=\"rgb({:.0f},{:.0f},{:.0f})\"/>",
                  drawing.x(object.centre.x() - object.size.x() / 2),
                  drawing.y(object.centre.y() + object.size.y() / 2),
                  drawing.pixels(object.size.x()), drawing.pixels(object.size.y()), -object.yaw_deg,
                  drawing.x(object.centre.x()), drawing.y(object.centre.y()), c.x(), c.y(), c.z()));
}

void draw_tag(Drawing& drawing, const WorldTag& tag) {
  // The printed face is normal to the tag's negative z axis.
  const Eigen::Vector2d face =
      -(tag.T_world_tag.rotation * Eigen::Vector3d::UnitZ()).head<2>().normalized();
  const Eigen::Vector2d along(-face.y(), face.x());
  const Eigen::Vector2d centre = tag.T_world_tag.translation.head<2>();
  drawing.line(centre - along * tag.size / 2, centre + along * tag.size / 2,
               "stroke=\"#d62728\" stroke-width=\"6\"");
  drawing.line(centre, centre + 0.15 * face, "stroke=\"#d62728\" stroke-width=\"2\"");
  drawing.text(drawing.x(centre.x()) + 8, drawing.y(centre.y()) + 22, fmt::format("tag {}", tag.id),
               "fill=\"#d62728\"");
}

void draw_site(Drawing& drawing, const Site& site) {
  for (const auto& row : site.rows) {
    drawing.line(row.start, row.end,
                 fmt::format("stroke=\"#c5dfb3\" stroke-width=\"{:.2f}\"",
                             drawing.pixels(site.canopy_depth)));
  }
  for (const Eigen::Vector2d& vine : site.vines) {
    drawing.circle(vine, 3, "fill=\"#4c8c2b\"");
  }
  for (const Eigen::Vector2d& post : site.posts) {
    drawing.circle(post, std::max(2.5, drawing.pixels(site.post_radius)), "fill=\"#7f6a4f\"");
  }
  for (const Site::Object& object : site.objects) draw_object(drawing, object);
  for (const auto& tag : site.tags) draw_tag(drawing, tag);
}

const char* colour_of(double error, double top) {
  const double place = top > 0 ? error / top * kScale.size() : 0;
  return kScale.at(std::min(kScale.size() - 1, static_cast<std::size_t>(place)));
}

/// The true path as a broad grey line, darker where cameras were blind.
void draw_truth(Drawing& drawing, const RunRecord& record, const RunResults& results) {
  std::vector<Eigen::Vector2d> all;
  std::vector<Eigen::Vector2d> blind;
  for (std::size_t i = 0; i < record.ticks.size(); ++i) {
    if (!record.ticks[i].truth.known) continue;
    all.push_back(record.ticks[i].truth.T_world_body.translation.head<2>());
    if (results.blind && i >= results.blind->first && i <= results.blind->last) {
      blind.push_back(all.back());
    }
  }
  const std::string round = "stroke-linejoin=\"round\" stroke-linecap=\"round\"";
  drawing.path(all, "stroke=\"#bbbbbb\" stroke-width=\"8\" " + round);
  drawing.path(blind, "stroke=\"#555555\" stroke-width=\"8\" " + round);
}

void draw_estimate(Drawing& drawing, const RunRecord& record, const RunResults& results,
                   double top) {
  const std::vector<PosePair> pairs = associate(true_trajectory(record), record.summary.trajectory);
  const Stamp gap = 2 * stamp_of_frame(1, record.rig.rate_hz);
  const auto place = [&](const PosePair& pair) {
    return (results.corrected->T_world_map * pair.T_map_body.translation).eval();
  };
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    if (pairs[i].stamp - pairs[i - 1].stamp > gap) continue;
    const Eigen::Vector3d to = place(pairs[i]);
    const double error = (to - pairs[i].T_world_body.translation).norm();
    drawing.line(place(pairs[i - 1]).head<2>(), to.head<2>(),
                 fmt::format("stroke=\"{}\" stroke-width=\"3\"", colour_of(error, top)));
  }
}

/// Without a truth for alignment and colours.
void draw_estimate_alone(Drawing& drawing, const RunRecord& record) {
  std::vector<Eigen::Vector2d> path;
  for (const StampedPose& at : record.summary.trajectory) {
    path.push_back(at.pose.translation.head<2>());
  }
  drawing.path(path, fmt::format("stroke=\"{}\" stroke-width=\"3\"", kScale.front()));
}

void draw_closures(Drawing& drawing, const RunRecord& record, const RunResults& results) {
  for (const JudgedClosure& judged : results.loops.closures) {
    if (!record.ticks[judged.tick].truth.known) continue;
    const Eigen::Vector2d at = record.ticks[judged.tick].truth.T_world_body.translation.head<2>();
    drawing.circle(at, 9,
                   fmt::format("fill=\"none\" stroke-width=\"2.5\" stroke=\"{}\"",
                               judged.correct ? "#1f77b4" : "#d62728"));
  }
}

void draw_ends(Drawing& drawing, const RunRecord& record) {
  const Trajectory truth = true_trajectory(record);
  const Trajectory& path = truth.empty() ? record.summary.trajectory : truth;
  if (path.empty()) return;
  const Eigen::Vector2d start = path.front().pose.translation.head<2>();
  const Eigen::Vector2d end = path.back().pose.translation.head<2>();
  drawing.circle(start, 5, "fill=\"white\" stroke=\"black\" stroke-width=\"2\"");
  drawing.circle(end, 3, "fill=\"black\"");
}

/// One line of the legend per call, from top to bottom.
class Legend {
 public:
  explicit Legend(Drawing& drawing) : drawing_(drawing), x_(kLeft + drawing.width() + 20) {}
  void entry(const std::string& words, const std::string& stroke, double width) {
    drawing_.add(
        fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
                    "stroke-width=\"{}\"/>",
                    x_, y_ - 4, x_ + 24, y_ - 4, stroke, width));
    drawing_.text(x_ + 32, y_, words);
    y_ += 20;
  }
  void mark(const std::string& words, double radius, const std::string& style) {
    drawing_.add(fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" {}/>", x_ + 12, y_ - 4,
                             radius, style));
    drawing_.text(x_ + 32, y_, words);
    y_ += 20;
  }
  void heading(const std::string& words) {
    y_ += 8;
    drawing_.text(x_, y_, words, "font-weight=\"bold\"");
    y_ += 20;
  }

 private:
  Drawing& drawing_;
  double x_;
  double y_ = kTop + 12;
};

std::string rgb(const Eigen::Vector3d& colour) {
  const Eigen::Vector3d c = 255 * colour;
  return fmt::format("rgb({:.0f},{:.0f},{:.0f})", c.x(), c.y(), c.z());
}

/// Each class once, in the colour of its first.
void describe_occluders(Legend& legend, const Site& site) {
  std::set<OccluderClass> described;
  for (const Site::Object& object : site.objects) {
    if (described.insert(object.kind).second) {
      legend.entry(name_of(object.kind), rgb(object.colour), 12);
    }
  }
}

void describe_site(Legend& legend, const Site& site) {
  if (!site.rows.empty()) {
    legend.entry("vine row", "#c5dfb3", 12);
    legend.mark("vine", 3, "fill=\"#4c8c2b\"");
    legend.mark("post", 3, "fill=\"#7f6a4f\"");
  }
  if (!site.tags.empty()) legend.entry("tag and its facing direction", "#d62728", 6);
  describe_occluders(legend, site);
}

void draw_legend(Drawing& drawing, const Site& site, const RunResults& results, double top) {
  Legend legend(drawing);
  legend.entry("truth", "#bbbbbb", 8);
  if (results.blind) legend.entry("truth, cameras blind", "#555555", 8);
  describe_site(legend, site);
  legend.mark("start", 5, "fill=\"white\" stroke=\"black\" stroke-width=\"2\"");
  legend.mark("end", 3, "fill=\"black\"");
  if (!results.loops.closures.empty()) {
    legend.mark("loop closed", 9, "fill=\"none\" stroke=\"#1f77b4\" stroke-width=\"2.5\"");
  }
  if (!results.corrected) return;
  legend.heading("estimate, error (mm)");
  for (std::size_t i = 0; i < kScale.size(); ++i) {
    const double step = 1000 * top / kScale.size();
    const double low = step * static_cast<double>(i);
    legend.entry(fmt::format("{:.1f} to {:.1f}", low, low + step), kScale.at(i), 3);
  }
}

std::string title_of(const Trial& trial, const RunResults& results) {
  std::string title = trial.name;
  if (!trial.site.rows.empty()) title += fmt::format(", seed {}", trial.seed);
  if (results.corrected) {
    title += fmt::format(": ATE {:.1f} mm SE(3)-aligned, {:.1f} mm first pose aligned",
                         1000 * results.corrected->ate.rmse, 1000 * results.corrected->origin.rmse);
  }
  return title;
}

}  // namespace

std::string plot_svg(const Trial& trial, const RunRecord& record, const RunResults& results) {
  Drawing drawing(bounds_of(trial.site, record));
  const double top = results.corrected ? results.corrected->ate.max : 0;
  drawing.title(title_of(trial, results));
  draw_axes(drawing);
  drawing.add("<g clip-path=\"url(#map)\">");
  draw_site(drawing, trial.site);
  draw_truth(drawing, record, results);
  if (results.corrected) draw_estimate(drawing, record, results, top);
  if (true_trajectory(record).empty()) draw_estimate_alone(drawing, record);
  draw_closures(drawing, record, results);
  draw_ends(drawing, record);
  drawing.add("</g>");
  draw_legend(drawing, trial.site, results, top);
  return drawing.document();
}

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

struct apriltag_family;

namespace vinebench::sim {

/// A family of the AprilTag library: its code table and its printed layout.
class TagFamily {
 public:
  /// Throws Error for a name that the library does not know.
  explicit TagFamily(const std::string& name);

  static std::vector<std::string> names();
  static bool known(const std::string& name);

  int size() const;              ///< how many tags it has
  int modules() const;           ///< cells a side of the whole image
  int border_modules() const;    ///< cells a side of the square whose corners the detector reports
  bool reversed_border() const;  ///< white on black

  /// The printed image, CV_8UC1, one pixel a cell, 0 or 255. Throws Error for an unknown id.
  cv::Mat image(int id) const;

  const apriltag_family* get() const { return family_.get(); }

 private:
  std::shared_ptr<apriltag_family> family_;
};

inline constexpr int kTagBoardRim = 1;               ///< modules of white around the print
inline constexpr double kTagBoardThickness = 0.005;  ///< m

/// Side of a tag's board, in sides of the black square. Throws Error for an unknown family.
double tag_board_scale(const std::string& family);

}  // namespace vinebench::sim

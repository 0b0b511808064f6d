// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/trajectory.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "core/files/files.h"
#include "core/util/error.h"

namespace vinebench {
namespace {

double parse_number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (*end != '\0' || !std::isfinite(value)) fail("expected a number, found '{}'", text);
  return value;
}

StampedPose parse_line(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  if (words.size() != 8) {
    fail("expected 8 columns (t x y z qx qy qz qw), found {}", words.size());
  }
  std::array<double, 7> v{};
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = parse_number(words[i + 1]);
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (std::abs(q.norm() - 1.0) > 1e-2) fail("expected a unit quaternion, found norm {}", q.norm());
  return {parse_seconds(words[0]), Pose{q.normalized(), {v[0], v[1], v[2]}}};
}

}  // namespace

Trajectory read_tum(const std::filesystem::path& file) {
  std::istringstream in(read_file(file, FileKind::kTable));
  Trajectory trajectory;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    try {
      trajectory.push_back(parse_line(line));
    } catch (const Error& error) {
      fail("{}:{}: {}", file.string(), number, error.what());
    }
    const std::size_t n = trajectory.size();
    if (n > 1 && trajectory[n - 1].stamp <= trajectory[n - 2].stamp) {
      fail("{}:{}: expected ascending stamps, found {} after {}", file.string(), number,
           format_seconds(trajectory[n - 1].stamp), format_seconds(trajectory[n - 2].stamp));
    }
  }
  return trajectory;
}

std::string format_tum(const Trajectory& trajectory) {
  std::string text;
  for (const auto& [stamp, pose] : trajectory) {
    const Eigen::Vector3d& p = pose.translation;
    const Eigen::Quaterniond& q = pose.rotation;
    text += fmt::format("{} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n",
                        format_seconds(stamp), p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

void write_tum(const Trajectory& trajectory, const std::filesystem::path& file) {
  write_file_atomically(file, format_tum(trajectory));
}

}  // namespace vinebench

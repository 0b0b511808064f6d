// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/black_regions.h"

#include <algorithm>
#include <cstdint>

namespace vinebench::slam {
namespace {

constexpr int kRegionTile = 4;  // px
using Bytes = std::vector<std::uint8_t>;

/// Darkest and brightest grey level of each tile.
struct Tiles {
  int columns;
  int rows;
  Bytes darkest;
  Bytes brightest;

  explicit Tiles(const cv::Mat& image)
      : columns(image.cols / kRegionTile),
        rows(image.rows / kRegionTile),
        darkest(static_cast<std::size_t>(columns * rows)),
        brightest(darkest.size()) {
    const auto width = static_cast<std::size_t>(columns * kRegionTile);
    Bytes low(width);
    Bytes high(width);
    std::size_t tile = 0;
    for (int row = 0; row < rows; ++row) {
      const std::uint8_t* line[kRegionTile];
      for (int i = 0; i < kRegionTile; ++i)
        line[i] = image.ptr<std::uint8_t>(row * kRegionTile + i);
      for (std::size_t x = 0; x < width; ++x) {
        low[x] = std::min(std::min(line[0][x], line[1][x]), std::min(line[2][x], line[3][x]));
        high[x] = std::max(std::max(line[0][x], line[1][x]), std::max(line[2][x], line[3][x]));
      }
      for (std::size_t x = 0; x < width; x += kRegionTile, ++tile) {
        darkest[tile] = std::min({low[x], low[x + 1], low[x + 2], low[x + 3]});
        brightest[tile] = std::max({high[x], high[x + 1], high[x + 2], high[x + 3]});
      }
    }
  }

  /// A grey level below this is black in the tile; 0 where the contrast around is too low.
  std::uint8_t limit(int column, int row, int contrast) const {
    int low = 255;
    int high = 0;
    for (int r = std::max(0, row - 1); r <= std::min(rows - 1, row + 1); ++r) {
      for (int c = std::max(0, column - 1); c <= std::min(columns - 1, column + 1); ++c) {
        const auto tile = static_cast<std::size_t>(r * columns + c);
        low = std::min<int>(low, darkest[tile]);
        high = std::max<int>(high, brightest[tile]);
      }
    }
    if (high - low < contrast) return 0;
    return static_cast<std::uint8_t>(low + (high - low) / 2 + 1);
  }
};

/// Appends the black runs of a row, each a region of its own yet.
void append_runs(const std::uint8_t* grey, const Bytes& limits, int row, Bytes& black,
                 std::vector<BlackRun>& runs) {
  const auto width = static_cast<int>(limits.size());
  for (std::size_t x = 0; x < limits.size(); ++x) black[x] = grey[x] < limits[x] ? 1 : 0;
  black[limits.size()] = 0;
  int first = -1;
  for (int x = 0; x <= width; ++x) {
    const bool is_black = black[static_cast<std::size_t>(x)] != 0;
    if (is_black == (first >= 0)) continue;
    if (is_black) {
      first = x;
    } else {
      runs.push_back({row, first, x - 1, static_cast<int>(runs.size())});
      first = -1;
    }
  }
}

/// Trees of runs by their `region`; a root is its own.
int root_of(std::vector<BlackRun>& runs, int run) {
  const auto parent = [&](int r) -> int& { return runs[static_cast<std::size_t>(r)].region; };
  while (parent(run) != run) {
    parent(run) = parent(parent(run));
    run = parent(run);
  }
  return run;
}

/// Joins the runs [middle, end) of a row to those [begin, middle) of the row above.
void join_rows(std::vector<BlackRun>& runs, std::size_t begin, std::size_t middle) {
  std::size_t above = begin;
  for (std::size_t below = middle; below < runs.size(); ++below) {
    while (above < middle && runs[above].last < runs[below].first) ++above;
    for (std::size_t a = above; a < middle && runs[a].first <= runs[below].last; ++a) {
      const int one = root_of(runs, static_cast<int>(a));
      const int other = root_of(runs, static_cast<int>(below));
      runs[static_cast<std::size_t>(std::max(one, other))].region = std::min(one, other);
    }
  }
}

/// Numbers the trees, and sums them up.
std::vector<BlackRegion> number_regions(std::vector<BlackRun>& runs) {
  std::vector<BlackRegion> regions;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    BlackRun& run = runs[i];
    // A root comes before the rest of its tree, whose parents have their final number by then.
    if (run.region == static_cast<int>(i)) {
      run.region = static_cast<int>(regions.size());
      regions.push_back({run.first, run.last, run.row, run.row, 0});
    } else {
      run.region = runs[static_cast<std::size_t>(run.region)].region;
    }
    BlackRegion& region = regions[static_cast<std::size_t>(run.region)];
    region.left = std::min(region.left, run.first);
    region.right = std::max(region.right, run.last);
    region.bottom = run.row;
    region.pixels += run.last - run.first + 1;
  }
  return regions;
}

}  // namespace

BlackRegions find_black_regions(const cv::Mat& image, int contrast) {
  BlackRegions found;
  const Tiles tiles(image);
  if (tiles.columns == 0 || tiles.rows == 0) return found;
  Bytes limits(static_cast<std::size_t>(image.cols));
  Bytes black(limits.size() + 1);
  std::size_t above = 0;
  for (int row = 0; row < image.rows; ++row) {
    // What is left over at the right and the bottom belongs to the last tiles.
    if (row % kRegionTile == 0 && row / kRegionTile < tiles.rows) {
      for (int column = 0; column < tiles.columns; ++column) {
        const bool last = column + 1 == tiles.columns;
        std::fill(limits.begin() + column * kRegionTile,
                  last ? limits.end() : limits.begin() + (column + 1) * kRegionTile,
                  tiles.limit(column, row / kRegionTile, contrast));
      }
    }
    const std::size_t begin = found.runs.size();
    append_runs(image.ptr<std::uint8_t>(row), limits, row, black, found.runs);
    join_rows(found.runs, above, begin);
    above = begin;
  }
  found.regions = number_regions(found.runs);
  return found;
}

}  // namespace vinebench::slam

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/tag_family.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagCircle21h7.h>
#include <apriltag/tagCircle49h12.h>
#include <apriltag/tagCustom48h12.h>
#include <apriltag/tagStandard41h12.h>
#include <apriltag/tagStandard52h13.h>

#include <algorithm>
#include <array>

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

struct Entry {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

constexpr std::array<Entry, 9> kFamilies{{
    {"tag16h5", tag16h5_create, tag16h5_destroy},
    {"tag25h9", tag25h9_create, tag25h9_destroy},
    {"tag36h10", tag36h10_create, tag36h10_destroy},
    {"tag36h11", tag36h11_create, tag36h11_destroy},
    {"tagCircle21h7", tagCircle21h7_create, tagCircle21h7_destroy},
    {"tagCircle49h12", tagCircle49h12_create, tagCircle49h12_destroy},
    {"tagCustom48h12", tagCustom48h12_create, tagCustom48h12_destroy},
    {"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy},
    {"tagStandard52h13", tagStandard52h13_create, tagStandard52h13_destroy},
}};

const Entry* find(const std::string& name) {
  const auto it = std::find_if(kFamilies.begin(), kFamilies.end(),
                               [&](const Entry& entry) { return name == entry.name; });
  return it == kFamilies.end() ? nullptr : &*it;
}

}  // namespace

TagFamily::TagFamily(const std::string& name) {
  const Entry* entry = find(name);
  if (entry == nullptr) fail("no AprilTag family is called \"{}\"", name);
  family_ = {entry->create(), entry->destroy};
}

std::vector<std::string> TagFamily::names() {
  std::vector<std::string> names;
  for (const Entry& entry : kFamilies) names.emplace_back(entry.name);
  return names;
}

bool TagFamily::known(const std::string& name) {
  return find(name) != nullptr;
}
int TagFamily::size() const {
  return static_cast<int>(family_->ncodes);
}
int TagFamily::modules() const {
  return family_->total_width;
}
int TagFamily::border_modules() const {
  return family_->width_at_border;
}
bool TagFamily::reversed_border() const {
  return family_->reversed_border;
}

cv::Mat TagFamily::image(int id) const {
  if (id < 0 || id >= size()) fail("{} has no tag {}", family_->name, id);
  const std::unique_ptr<image_u8_t, void (*)(image_u8_t*)> image(
      apriltag_to_image(family_.get(), id), image_u8_destroy);
  const auto stride = static_cast<std::size_t>(image->stride);
  return cv::Mat(image->height, image->width, CV_8UC1, image->buf, stride).clone();
}

double tag_board_scale(const std::string& name) {
  const TagFamily family(name);
  return static_cast<double>(family.modules() + 2 * kTagBoardRim) / family.border_modules();
}

}  // namespace vinebench::sim

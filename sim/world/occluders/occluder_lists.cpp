// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/occluders/occluder_lists.h"

#include <algorithm>

namespace vinebench::sim {
namespace {

Occluder occluder_of(const BoxEntry& box) {
  Occluder occluder;
  occluder.name = box.name;
  occluder.size = box.size;
  occluder.position = box.position;
  occluder.yaw_deg = box.yaw_deg;
  occluder.colour = box.colour;
  occluder.printed = box.printed;
  occluder.print_seed = box.print_seed;
  occluder.list = Occluder::List::kBoxes;
  return occluder;
}

Occluder occluder_of(const ObstacleEntry& obstacle) {
  Occluder occluder;
  occluder.shape = obstacle.kind == ObstacleEntry::Kind::kPerson ? Occluder::Shape::kPerson
                                                                 : Occluder::Shape::kCrate;
  occluder.position = obstacle.position;
  occluder.yaw_deg = obstacle.yaw_deg;
  occluder.height = obstacle.height;
  occluder.colour = obstacle.colour;
  occluder.list = Occluder::List::kObstacles;
  return occluder;
}

BoxEntry box_of(const Occluder& occluder) {
  return {occluder.name,       size_of(occluder), occluder.position,  occluder.yaw_deg,
          colour_of(occluder), occluder.printed,  occluder.print_seed};
}

ObstacleEntry obstacle_of(const Occluder& occluder) {
  const bool person = occluder.shape == Occluder::Shape::kPerson;
  return {person ? ObstacleEntry::Kind::kPerson : ObstacleEntry::Kind::kCrate, occluder.position,
          occluder.yaw_deg, occluder.height, colour_of(occluder)};
}

}  // namespace

OccluderLists split(const std::vector<Occluder>& occluders) {
  OccluderLists lists;
  for (const Occluder& occluder : occluders) {
    switch (occluder.list) {
      case Occluder::List::kBoxes:
        lists.boxes.push_back(box_of(occluder));
        break;
      case Occluder::List::kObstacles:
        lists.obstacles.push_back(obstacle_of(occluder));
        break;
      case Occluder::List::kOccluders:
        if (!lists.occluders) lists.occluders.emplace();
        lists.occluders->push_back(occluder);
        break;
    }
  }
  return lists;
}

std::vector<Occluder> join(const OccluderLists& lists) {
  std::vector<Occluder> occluders;
  for (const BoxEntry& box : lists.boxes) occluders.push_back(occluder_of(box));
  for (const ObstacleEntry& obstacle : lists.obstacles) occluders.push_back(occluder_of(obstacle));
  if (lists.occluders) {
    occluders.insert(occluders.end(), lists.occluders->begin(), lists.occluders->end());
  }
  return occluders;
}

void append_occluders(std::vector<Occluder>& occluders, const std::vector<Occluder>& more) {
  occluders.insert(occluders.end(), more.begin(), more.end());
  std::ranges::stable_sort(occluders, {}, &Occluder::list);
}

}  // namespace vinebench::sim

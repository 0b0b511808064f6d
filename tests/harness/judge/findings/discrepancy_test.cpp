// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/findings/discrepancy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/angle.h"

namespace vinebench::harness {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kFocal = 200;     // px
constexpr double kBaseline = 0.1;  // m

/// A pair ahead, a pair behind, and a single camera to the side.
Rig rig() {
  const PinholeCamera lens{640, 480, kFocal, kFocal, 319.5, 239.5, {}};
  Rig made;
  const auto add = [&](const char* name, double x, double y, double yaw) {
    made.cameras.push_back({name, lens, Rig::mount({x, y, 0}, {0, 0, yaw})});
  };
  add("fl", 0.3, kBaseline / 2, 0);
  add("fr", 0.3, -kBaseline / 2, 0);
  add("bl", -0.3, -kBaseline / 2, 180 * kRadiansPerDegree);
  add("br", -0.3, kBaseline / 2, 180 * kRadiansPerDegree);
  add("side", 0, -0.2, -90 * kRadiansPerDegree);
  made.stereo_pairs = {{"front", 0, 1}, {"back", 2, 3}};
  made.tag_cameras = {4};
  return made;
}

std::vector<std::string> texts(const std::vector<Discrepancy>& list) {
  std::vector<std::string> all;
  for (const Discrepancy& d : list) all.push_back(text_of(d));
  return all;
}

/// What a change of the rig that the estimator is told looks like.
template <class Change>
std::vector<std::string> told(const Change& change) {
  Rig wrong = rig();
  change(wrong);
  return texts(rig_discrepancies(wrong, rig()));
}

/// The right camera farther from the left one by the factor.
void stretch(Rig& rig, std::size_t left, std::size_t right, double factor) {
  const Eigen::Vector3d& from = rig.cameras[left].T_body_cam.translation;
  Eigen::Vector3d& to = rig.cameras[right].T_body_cam.translation;
  to = from + factor * (to - from);
}

TEST(RigDiscrepanciesTest, TheSameRigHasNone) {
  EXPECT_THAT(told([](Rig&) {}), IsEmpty());
}

// 4 % of 0.1 m are 4 mm, at 1 m 0.8 px; the pair's middle moves by half of that.
TEST(RigDiscrepanciesTest, ABaselineIsOfItsPairOrOfAll) {
  EXPECT_THAT(told([](Rig& r) { stretch(r, 0, 1, 1.04); }),
              ElementsAre("front pair: baseline 4 % too large", "front pair: position 2 mm off"));
  EXPECT_THAT(told([](Rig& r) {
                stretch(r, 0, 1, 0.96);
                stretch(r, 2, 3, 0.96);
              }),
              ElementsAre("all pairs: baseline 4 % too small", "all pairs: position 2 mm off"));
}

TEST(RigDiscrepanciesTest, LensesOfOneCameraOfAPairAndOfAll) {
  const auto longer = [](const std::vector<std::size_t>& cameras) {
    return told([&](Rig& r) {
      for (const std::size_t i : cameras) r.cameras[i].model.fx *= 1.01;
      for (const std::size_t i : cameras) r.cameras[i].model.fy *= 1.01;
    });
  };
  EXPECT_THAT(longer({2}), ElementsAre("bl: focal length 1 % too large"));
  EXPECT_THAT(longer({2, 3}), ElementsAre("back pair: focal length 1 % too large"));
  EXPECT_THAT(longer({0, 1, 2, 3}), ElementsAre("all pairs: focal length 1 % too large"));
  EXPECT_THAT(told([](Rig& r) { r.cameras[4].model.fy *= 0.98; }),
              ElementsAre("side: focal length, y 2 % too small"));
  EXPECT_THAT(told([](Rig& r) { r.cameras[1].model.cy -= 3; }),
              ElementsAre("fr: principal point, y 3 px too small"));
}

TEST(RigDiscrepanciesTest, MountsOfPairsAndOfCamerasToEachOther) {
  const auto turn = [](RigCamera& camera, double degrees) {
    camera.T_body_cam.rotation =
        exp_so3({0, 0, degrees * kRadiansPerDegree}) * camera.T_body_cam.rotation;
  };
  EXPECT_THAT(told([&](Rig& r) { turn(r.cameras[1], 0.5); }),
              ElementsAre("front pair: cameras to each other 0.5 deg off"));
  EXPECT_THAT(told([&](Rig& r) {
                turn(r.cameras[0], 0.5);
                turn(r.cameras[1], 0.5);
              }),
              ElementsAre("front pair: orientation 0.5 deg off"));
  EXPECT_THAT(told([](Rig& r) { r.cameras[4].T_body_cam.translation.z() += 0.03; }),
              ElementsAre("side: position 30 mm off"));
}

TEST(RigDiscrepanciesTest, SwappedCamerasAreNothingElse) {
  EXPECT_THAT(told([](Rig& r) {
                std::swap(r.cameras[0].model, r.cameras[1].model);
                std::swap(r.cameras[0].T_body_cam, r.cameras[1].T_body_cam);
              }),
              ElementsAre("fl and fr: swapped"));
}

TEST(TagDiscrepanciesTest, PlaceOrientationSizeAndNumber) {
  const std::vector<WorldTag> world{{"tag36h11", 3, 0.2, {}, true}};
  const auto surveyed = [&](RegisteredTag tag) {
    return texts(tag_discrepancies({tag}, world, kFocal));
  };
  EXPECT_THAT(surveyed({"tag36h11", 3, 0.2, {}}), IsEmpty());
  EXPECT_THAT(surveyed({"tag36h11", 3, 0.21, {}}), ElementsAre("tag 3: size 5 % too large"));
  EXPECT_THAT(surveyed({"tag36h11", 4, 0.2, {}}), ElementsAre("tag 4: not in the world"));
  RegisteredTag moved{"tag36h11", 3, 0.2, {}};
  moved.T_world_tag.translation.x() = 0.06;
  EXPECT_THAT(surveyed(moved), ElementsAre("tag 3: position 60 mm off"));
}

TEST(DiscrepanciesTest, TheOneThatMovesTheImagesMostComesFirst) {
  std::vector<Discrepancy> list{{"a", "exposure", 10, "ms", 1}, {"b", "exposure", -20, "ms", 2}};
  rank(list);
  EXPECT_EQ(format_discrepancies(list),
            "told and not so: b: exposure 20 ms too early; a: exposure 10 ms too late\n");
  EXPECT_EQ(format_discrepancies({}), "");
}

}  // namespace
}  // namespace vinebench::harness

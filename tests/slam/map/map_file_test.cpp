// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/map/map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/files/files.h"
#include "core/util/error.h"
#include "slam/map/binary_archive.h"
#include "slam/map/rig_fingerprint.h"
#include "tests/support/aisle_map.h"
#include "tests/support/special_files.h"
#include "tests/support/test_folder.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::SyntheticAisle;
using testing::AllOf;
using testing::HasSubstr;

/// CRC-64/XZ bit by bit, by its definition.
std::uint64_t slow_crc64(std::string_view bytes) {
  std::uint64_t crc = ~0ULL;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xC96C5795D7870F42ULL : 0);
    }
  }
  return ~crc;
}

/// The same bytes with a correct checksum.
std::string sealed(std::string bytes) {
  const std::size_t end = bytes.size() - 8;
  const std::uint64_t crc = slow_crc64(std::string_view(bytes).substr(0, end));
  for (std::size_t i = 0; i < 8; ++i) bytes[end + i] = static_cast<char>(crc >> (8 * i) & 0xffU);
  return bytes;
}

/// A small map with one element of each kind: two keyframes, patches, placed features, a tag, a
/// landmark that was removed.
AisleMap small_map(const SyntheticAisle& aisle) {
  AisleMap made(aisle, {Pose{}});
  const Pose second{exp_so3({0, 0, 0.05}), {0.1, 0.02, 0}};
  const Pose T_world_tag = made.rig.rig.cameras[4].T_body_cam * Pose{{1, 0, 0, 0}, {0, 0, 1}};
  auto frame = aisle.frame_with_tag(1, second, T_world_tag);
  for (StereoView& view : frame->views) {
    view.placed.assign(view.features.size(), 0);
    view.placed.front() = 1;
  }
  const int id = made.add(frame, second);
  auto& patches = made.map.keyframe(id).patches;
  for (const StereoView& view : frame->views) patches.emplace_back(view.features.size());
  Patch grey;
  grey.grey.fill(77);
  patches[0].add(1, grey);
  made.map.tags().push_back({"tag36h11", 0, 0.161, T_world_tag, true});
  made.map.calibration().pairs = {{}, {{exp_so3({0, 0.01, 0}), {0.005, 0, 0}}, 0.25}};
  made.map.calibration().pairs[1].right_turn.y() = 0.002;
  made.map.calibration().tag_times = {0.003};
  made.map.remove_landmark(made.map.keyframe(0).landmarks[0][2]);
  return made;
}

class MapFileTest : public testing::Test {
 protected:
  Map parse(const std::string& bytes) const { return parse_map(bytes, made_.rig, "row.map"); }

  /// The message of the Error for these bytes; "" if they are a valid map.
  std::string error_of(const std::string& bytes) const {
    try {
      parse(bytes);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }

  SyntheticAisle aisle_{0.5, 1, 60};
  AisleMap made_ = small_map(aisle_);
  const std::string bytes_ = format_map(made_.map, made_.rig);
};

TEST_F(MapFileTest, TheChecksumIsCrc64Xz) {
  EXPECT_EQ(slow_crc64("123456789"), 0x995DC9BBDF1939FAULL);  // the catalogue's check value
  EXPECT_EQ(sealed(bytes_), bytes_);
}

TEST_F(MapFileTest, SavedLoadedAndSavedAgainItIsTheSame) {
  EXPECT_EQ(format_map(parse(bytes_), made_.rig), bytes_);
}

TEST_F(MapFileTest, EverythingComesBack) {
  const Map map = parse(bytes_);
  ASSERT_EQ(map.keyframes().size(), 2u);
  const Keyframe& then = made_.map.keyframe(1);
  const Keyframe& now = map.keyframe(1);
  EXPECT_EQ(now.T_map_body.translation, then.T_map_body.translation);
  EXPECT_EQ(now.T_map_body.rotation.coeffs(), then.T_map_body.rotation.coeffs());
  EXPECT_TRUE(now.inherited());
  EXPECT_EQ(now.frame->stamp - map.keyframe(0).frame->stamp,
            then.frame->stamp - made_.map.keyframe(0).frame->stamp);
  EXPECT_EQ(now.covisible, then.covisible);
  ASSERT_EQ(now.frame->tags.size(), 1u);
  EXPECT_EQ(now.frame->tags[0].corners, then.frame->tags[0].corners);
  EXPECT_EQ(now.patches[0].find(1)->grey[60], 77);
  EXPECT_EQ(now.patches[0].find(0), nullptr);
  const StereoView& view = now.frame->views[1];
  EXPECT_EQ(view.placed, then.frame->views[1].placed);
  EXPECT_EQ(view.features.descriptors, then.frame->views[1].features.descriptors);
  EXPECT_EQ(view.stereo[3].depth, then.frame->views[1].stereo[3].depth);
  const Keypoint& keypoint = view.features.keypoints[3];
  std::vector<int> found;
  view.grid.query(keypoint.x, keypoint.y, 0.1F, 0, 7, found);
  EXPECT_THAT(found, testing::Contains(3));
  ASSERT_EQ(map.tags().size(), 1u);
  EXPECT_TRUE(map.tags()[0].fixed);
  ASSERT_EQ(map.calibration().pairs.size(), 2u);
  EXPECT_EQ(map.calibration().pairs[0].disparity_offset, 0);
  EXPECT_EQ(map.calibration().pairs[1].disparity_offset, 0.25);
  EXPECT_EQ(map.calibration().pairs[1].right_turn.y(), 0.002);
  EXPECT_EQ(map.calibration().pairs[1].T_nominal_camera.translation, Eigen::Vector3d(0.005, 0, 0));
  EXPECT_NEAR(angle_of(map.calibration().pairs[1].T_nominal_camera.rotation), 0.01, 1e-12);
}

TEST_F(MapFileTest, LandmarksKeepAllButTheirNumbers) {
  const Map map = parse(bytes_);
  EXPECT_EQ(map.landmarks().size() + 1, made_.map.landmarks().size());  // one was removed
  for (const Keyframe& keyframe : made_.map.keyframes()) {
    for (std::size_t v = 0; v < keyframe.landmarks.size(); ++v) {
      for (std::size_t f = 0; f < keyframe.landmarks[v].size(); ++f) {
        const int then = keyframe.landmarks[v][f];
        const int now = map.keyframe(keyframe.id).landmarks[v][f];
        ASSERT_EQ(then < 0, now < 0);
        if (then < 0) continue;
        EXPECT_EQ(map.landmark(now).id, now);
        EXPECT_EQ(map.landmark(now).position, made_.map.landmark(then).position);
        EXPECT_EQ(map.landmark(now).descriptor, made_.map.landmark(then).descriptor);
        EXPECT_EQ(map.landmark(now).observations.size(),
                  made_.map.landmark(then).observations.size());
      }
    }
  }
}

TEST_F(MapFileTest, AnEmptyMapIsAMap) {
  const std::string bytes = format_map(Map(1.2), made_.rig);
  EXPECT_TRUE(parse(bytes).keyframes().empty());
}

TEST_F(MapFileTest, CutOffAnywhereItIsAnError) {
  for (std::size_t n = 0; n < bytes_.size(); ++n) {
    const std::string error = error_of(bytes_.substr(0, n));
    ASSERT_THAT(error, HasSubstr("row.map: ")) << n;
    ASSERT_THAT(error, HasSubstr(n < 8 ? "not a map" : "cut off")) << n;
  }
  EXPECT_THAT(error_of(bytes_ + "x"), HasSubstr("goes on after its end"));
}

TEST_F(MapFileTest, AnyAlteredByteIsAnError) {
  for (std::size_t i = 0; i < bytes_.size(); ++i) {
    std::string altered = bytes_;
    altered[i] = static_cast<char>(altered[i] ^ (1 << (i % 8)));
    ASSERT_THAT(error_of(altered), HasSubstr("row.map: ")) << i;
  }
}

/// Bytes altered before the checksum was computed: they are rejected or give a usable map.
TEST_F(MapFileTest, AlteredBeforeSealingItIsAnErrorOrAMap) {
  int refused = 0;
  int accepted = 0;
  for (std::size_t i = 20; i < bytes_.size() - 8; i += 3) {  // covers fields at any alignment
    std::string altered = bytes_;
    altered[i] = static_cast<char>(altered[i] ^ (i % 2 == 0 ? 0xff : 1 << (i % 8)));
    altered = sealed(altered);
    try {
      Map map = parse(altered);
      for (const Landmark& landmark : map.landmarks())
        map.refresh(landmark.id, made_.rig.T_body_cams);
      ASSERT_FALSE(format_map(map, made_.rig).empty());
      ++accepted;
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 200);   // lengths, associations, levels, poses and all of the rig
  EXPECT_GT(accepted, 200);  // descriptors, low bits of numbers
}

TEST_F(MapFileTest, AnotherVersionIsSaidSo) {
  std::string other = bytes_;
  other[8] = 1;  // version, low byte
  EXPECT_THAT(error_of(sealed(other)),
              AllOf(HasSubstr("version 1"), HasSubstr("expected version 3 to 9")));
}

std::string rig_bytes(const EstimatorRig& rig, std::uint32_t version) {
  BinaryWriter writer(version);
  writer(rig_fingerprint(rig));
  return writer.take();
}

/// The same map with other contents and their size, as version 3 or later.
std::string with_contents(std::string bytes, std::uint32_t version) {
  bytes[8] = static_cast<char>(version);
  const std::uint64_t content = bytes.size() - 28;
  for (std::size_t i = 0; i < 8; ++i) bytes[12 + i] = static_cast<char>(content >> (8 * i) & 0xffU);
  return sealed(bytes);
}

/// Bytes at the end of a keyframe from version 6 on, and after these from version 8 on: how many
/// views, and how late each is.
constexpr std::size_t kVelocity = 6 * sizeof(double);
constexpr std::size_t kLate = sizeof(std::uint32_t) + 2 * sizeof(double);

/// Without the times of cameras for tags, which version 9 has at the end, of a map that knows of
/// `times`; the checksum is behind them.
std::string of_version_8(std::string bytes, std::size_t times) {
  const std::size_t end = sizeof(std::uint32_t) + times * (sizeof(std::int32_t) + sizeof(double));
  return bytes.erase(bytes.size() - 8 - end, end);
}

/// Also without what came with version 8, of a map of one keyframe and of no times.
std::string of_version_7(std::string bytes) {
  bytes = of_version_8(std::move(bytes), 0);
  return bytes.erase(bytes.size() - 8 - kLate, kLate);
}

TEST_F(MapFileTest, MapsOfVersion8AreRead) {
  const Map map = parse_map(with_contents(of_version_8(bytes_, 1), 8), made_.rig, "older.map");
  EXPECT_EQ(map.calibration().pairs.size(), 2u);
  EXPECT_EQ(map.calibration().tag_times, std::vector<double>{0});
}

// Of a camera that is not in use any more there is no time, and another has its own.
TEST_F(MapFileTest, TimesBelongToTheirCameras) {
  StereoRig fewer = made_.rig.rig;
  fewer.tag_cameras = {0, 4};
  const EstimatorRig rig(fewer, OrbConfig{});
  EXPECT_EQ(parse_map(bytes_, rig, "row.map").calibration().tag_times,
            (std::vector<double>{0, 0.003}));
  Map unknown = made_.map;
  unknown.calibration().tag_times = {std::nan("")};
  EXPECT_THAT(error_of(format_map(unknown, made_.rig)), HasSubstr("a camera's time"));
}

// Until version 7 all images were of their frame's stamp.
TEST_F(MapFileTest, MapsOfVersion7AreRead) {
  AisleMap one(aisle_, {Pose{}});
  const std::string older = of_version_7(format_map(one.map, one.rig));
  const Map map = parse_map(with_contents(older, 7), one.rig, "older.map");
  ASSERT_EQ(map.keyframes().size(), 1u);
  EXPECT_EQ(map.keyframe(0).frame->views[1].late, 0);
}

TEST_F(MapFileTest, WhenViewsWereTakenIsKept) {
  FrameFeatures frame = *made_.map.keyframe(1).frame;
  frame.views[1].late = 0.0125;
  made_.map.keyframe(1).frame = std::make_shared<const FrameFeatures>(frame);
  const std::string bytes = format_map(made_.map, made_.rig);
  EXPECT_EQ(parse(bytes).keyframe(1).frame->views[1].late, 0.0125);
  frame.views[1].late = std::nan("");
  made_.map.keyframe(1).frame = std::make_shared<const FrameFeatures>(frame);
  EXPECT_THAT(error_of(format_map(made_.map, made_.rig)), HasSubstr("a keyframe's features"));
}

// Until version 6 six numbers of each pair were missing at the end of it.
TEST_F(MapFileTest, CalibrationsOfVersion6AreRead) {
  AisleMap one(aisle_, {Pose{}});
  const std::size_t without = format_map(one.map, one.rig).size();
  one.map.calibration().pairs = {{}, {{exp_so3({0, 0.01, 0}), {0.005, 0, 0}}, 0.25}};
  one.map.calibration().pairs[1].readout = 0.02;
  std::string older = of_version_7(format_map(one.map, one.rig));
  const std::size_t pair = (older.size() + kLate - without) / 2, missing = 6 * sizeof(double);
  const std::size_t at =
      20 + rig_bytes(one.rig, 6).size() + sizeof(double) + sizeof(std::uint64_t);  // the scale, 2
  older.erase(at + 2 * pair - missing, missing);
  older.erase(at + pair - missing, missing);
  const Map map = parse_map(with_contents(older, 6), one.rig, "older.map");
  ASSERT_EQ(map.calibration().pairs.size(), 2u);
  EXPECT_EQ(map.calibration().pairs[1].disparity_offset, 0.25);
  EXPECT_EQ(map.calibration().pairs[1].readout, 0.02);
  EXPECT_EQ(map.calibration().pairs[1].right_ahead, 0);
}

// Until version 5 there was one number a pair, its disparity offset.
TEST_F(MapFileTest, DisparityOffsetsOfVersion5AreRead) {
  AisleMap one(aisle_, {Pose{}});
  std::string older = of_version_7(format_map(one.map, one.rig));
  BinaryWriter none(6), offsets(5);
  none(std::vector<double>{});  // an empty list of anything
  offsets(std::vector<double>{0, 0.25});
  older.erase(older.size() - 8 - kVelocity, kVelocity);
  const std::size_t at = 20 + rig_bytes(one.rig, 5).size() + sizeof(double);
  older.replace(at, none.take().size(), offsets.take());
  const Map map = parse_map(with_contents(older, 5), one.rig, "older.map");
  ASSERT_EQ(map.calibration().pairs.size(), 2u);
  EXPECT_EQ(map.calibration().pairs[1].disparity_offset, 0.25);
  EXPECT_EQ(map.calibration().pairs[1].T_nominal_camera.translation, Eigen::Vector3d(0, 0, 0));
}

// Versions 3 and 4 lack the lens models of the rig, with which the content begins. Version 3 also
// lacks the flag behind each keyframe that says whether it has an inertial state; of a map of one
// keyframe that is the content's last byte before the velocity.
TEST_F(MapFileTest, MapsOfVersion3AreRead) {
  AisleMap one(aisle_, {Pose{}});
  std::string older = of_version_7(format_map(one.map, one.rig));
  const std::size_t flag = older.size() - 9 - kVelocity;
  ASSERT_EQ(older[flag], 0);
  older.erase(flag, 1 + kVelocity);
  older.replace(20, rig_bytes(one.rig, 5).size(), rig_bytes(one.rig, 3));
  const Map map = parse_map(with_contents(older, 3), one.rig, "older.map");
  ASSERT_EQ(map.keyframes().size(), 1u);
  EXPECT_FALSE(map.keyframe(0).inertial);
  EXPECT_EQ(map.landmarks().size(), one.map.landmarks().size());
}

TEST_F(MapFileTest, InertialStatesAreKept) {
  made_.map.keyframe(1).inertial = InertialState{{1, 2, 3}, {0.01, 0.02, 0.03}, {0.1, 0.2, 0.3}};
  const std::string bytes = format_map(made_.map, made_.rig);
  const Map map = parse(bytes);
  EXPECT_FALSE(map.keyframe(0).inertial);
  ASSERT_TRUE(map.keyframe(1).inertial);
  EXPECT_EQ(map.keyframe(1).inertial->velocity, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(map.keyframe(1).inertial->gyroscope_bias, Eigen::Vector3d(0.01, 0.02, 0.03));
  EXPECT_EQ(map.keyframe(1).inertial->accelerometer_bias, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(format_map(map, made_.rig), bytes);
}

TEST_F(MapFileTest, AnotherRigIsSaidSo) {
  const Rig rover = load_rig(VINEBENCH_SOURCE_DIR "/models/csl-rover/rig.yaml");
  const auto error_with = [&](const Rig& rig, const std::vector<std::string>& cameras) {
    try {
      parse_map(bytes_, EstimatorRig(make_stereo_rig(rig, cameras), OrbConfig{}), "row.map");
      return std::string();
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(error_with(rover, {}), "");
  EXPECT_THAT(error_with(rover, {"front"}), HasSubstr("another rig: it uses 2 stereo pairs"));
  Rig moved = rover;
  moved.cameras[4].T_body_cam.translation.x() += 0.01;
  EXPECT_THAT(error_with(moved, {}), HasSubstr("camera 'side' sits elsewhere"));
  Rig zoomed = rover;
  for (RigCamera& camera : zoomed.cameras) camera.model.fx *= 1.01;
  EXPECT_THAT(error_with(zoomed, {}), HasSubstr("camera 'front_left' has another lens"));
  OrbConfig fewer;
  fewer.levels = 6;
  EXPECT_THROW(parse_map(bytes_, EstimatorRig(make_stereo_rig(rover, {}), fewer), "row.map"),
               Error);
}

TEST_F(MapFileTest, FilesAreWrittenAndRead) {
  const test::TestFolder folder;
  const std::filesystem::path file = folder / "row.map";
  save_map(made_.map, made_.rig, file);
  EXPECT_EQ(read_file(file), bytes_);
  EXPECT_EQ(load_map(file, made_.rig).keyframes().size(), 2u);
  std::filesystem::remove(file);
  EXPECT_THROW(load_map(file, made_.rig), Error);
}

TEST_F(MapFileTest, APipeOrADeviceIsNoMap) {
  const test::TestFolder folder;
  for (const auto& file :
       {test::make_pipe(folder, "pipe.map"), test::link_to_device(folder, "zero.map")}) {
    EXPECT_THAT(test::error_of([&] { load_map(file, made_.rig); }),
                AllOf(HasSubstr(file.string()), HasSubstr("a pipe or a device")));
  }
}

}  // namespace
}  // namespace vinebench::slam

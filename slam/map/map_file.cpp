// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/map/map_file.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/files/files.h"
#include "core/util/library_errors.h"
#include "slam/map/binary_archive.h"
#include "slam/map/rig_fingerprint.h"

namespace vinebench::slam {
namespace {

constexpr std::string_view kMagic("vinemap\0", 8);
constexpr std::uint32_t kVersion = 9;
constexpr std::uint32_t kOldestVersion = 3;  // without inertial states
constexpr std::size_t kHeaderSize = 20;      // magic, version, size of the content
constexpr std::size_t kChecksumSize = 8;

/// A pixel may lie this far off its image, where refinement moved it.
constexpr double kImageMargin = 16;  // px

/// A map lies in the past of whoever loads it: the last keyframe's frame has this index and stamp.
constexpr std::int64_t kLastIndex = -1000;
constexpr Stamp kLastStamp = -kNanosecondsPerSecond;

struct StoredKeyframe {
  FrameFeatures frame;
  Pose T_map_body;
  Associations landmarks;
  std::vector<PatchList> patches;
  std::optional<OdometryLink> link;
  std::optional<InertialState> inertial;
};

/// RigCalibration::tag_times of a camera, by index into Rig::cameras.
struct TagTime {
  int camera = 0;
  double time = 0;
};

}  // namespace

template <class Archive>
void fields(Archive& archive, MapTag& tag) {
  bool registered = tag.registered();
  archive(tag.family, tag.id, tag.size, tag.T_map_tag, registered);
  if (!tag.survey) tag.fixed = registered;
}
template <class Archive>
void fields(Archive& archive, Landmark& l) {
  archive(l.position, l.descriptor, l.normal, l.max_distance, l.first_keyframe);
}
template <class Archive>
void fields(Archive& archive, Keypoint& k) {
  archive(k.x, k.y, k.angle, k.response, k.level);
}
template <class Archive>
void fields(Archive& archive, StereoMatch& m) {
  archive(m.x_right, m.depth, m.slant_x, m.slant_y);
}
template <class Archive>
void fields(Archive& archive, StereoView& view) {
  auto followed = static_cast<std::uint64_t>(view.followed);
  archive(view.features.keypoints, view.features.descriptors, view.stereo, view.placed, followed);
  view.followed = static_cast<std::size_t>(followed);
}
template <class Archive>
void fields(Archive& archive, TagSighting& tag) {
  archive(tag.camera, tag.family, tag.id, tag.corners, tag.T_cam_tag, tag.corner_sigma);
}
template <class Archive>
void fields(Archive& archive, PairCalibration& pair) {
  archive(pair.T_nominal_camera, pair.disparity_offset, pair.disparity_slope, pair.focal,
          pair.baseline, pair.time, pair.readout);
  if (archive.version() >= 7) archive(pair.principal_point, pair.right_turn, pair.right_ahead);
}
template <class Archive>
void fields(Archive& archive, TagTime& of) {
  archive(of.camera, of.time);
}
template <class Archive>
void fields(Archive& archive, Patch& patch) {
  archive(patch.grey);
}
template <class Archive>
void fields(Archive& archive, OdometryLink& link) {
  std::array<double, 36> covariance;
  Eigen::Map<Matrix6d> matrix(covariance.data());
  matrix = link.covariance;
  archive(link.from, link.T_from_to, covariance);
  link.covariance = matrix;
}
template <class Archive>
void fields(Archive& archive, PatchList& list) {
  std::vector<std::optional<Patch>> patches(list.size());
  for (std::size_t f = 0; f < patches.size(); ++f) {
    if (const Patch* patch = list.find(f)) patches[f] = *patch;
  }
  archive(patches);
  list = PatchList(patches.size());
  for (std::size_t f = 0; f < patches.size(); ++f) {
    if (patches[f]) list.add(f, *patches[f]);
  }
  list.close();
}
template <class Archive>
void fields(Archive& archive, InertialState& state) {
  archive(state.velocity, state.gyroscope_bias, state.accelerometer_bias);
}

template <class Archive>
void fields(Archive& archive, StoredKeyframe& k) {
  archive(k.frame.index, k.frame.stamp, k.frame.views, k.frame.tags, k.T_map_body, k.landmarks,
          k.patches, k.link);
  if (archive.version() >= 4) archive(k.inertial);
  if (archive.version() >= 6) archive(k.frame.velocity);
  if (archive.version() < 8) return;
  std::vector<double> late;
  for (const StereoView& view : k.frame.views) late.push_back(view.late);
  archive(late);
  late.resize(k.frame.views.size());
  for (std::size_t v = 0; v < late.size(); ++v) k.frame.views[v].late = late[v];
}

namespace {

std::uint64_t crc64(std::string_view bytes) {
  static const auto table = [] {
    std::array<std::uint64_t, 256> made{};
    for (std::uint64_t i = 0; i < made.size(); ++i) {
      std::uint64_t value = i;
      for (int bit = 0; bit < 8; ++bit) {
        value = (value >> 1) ^ ((value & 1) != 0 ? 0xC96C5795D7870F42ULL : 0);
      }
      made[i] = value;
    }
    return made;
  }();
  std::uint64_t crc = ~0ULL;
  for (const char byte : bytes) {
    crc = table[(crc ^ static_cast<unsigned char>(byte)) & 0xffU] ^ (crc >> 8);
  }
  return ~crc;
}

/// Landmarks without those that were removed, and where each went (-1 for none).
std::vector<Landmark> living_landmarks(const Map& map, std::vector<int>& moved_to) {
  std::vector<Landmark> living;
  moved_to.assign(map.landmarks().size(), -1);
  for (std::size_t i = 0; i < map.landmarks().size(); ++i) {
    const Landmark& landmark = map.landmarks()[i];
    if (landmark.removed || landmark.observations.empty()) continue;
    moved_to[i] = static_cast<int>(living.size());
    living.push_back(landmark);
  }
  return living;
}

StoredKeyframe stored(const Keyframe& keyframe, const FrameFeatures& last,
                      const std::vector<int>& moved_to) {
  StoredKeyframe stored;
  stored.frame.index = keyframe.frame->index - last.index + kLastIndex;
  stored.frame.stamp = keyframe.frame->stamp - last.stamp + kLastStamp;
  stored.frame.views = keyframe.frame->views;
  stored.frame.tags = keyframe.frame->tags;
  stored.frame.velocity = keyframe.frame->velocity;
  stored.T_map_body = keyframe.T_map_body;
  stored.landmarks = keyframe.landmarks;
  for (std::vector<int>& view : stored.landmarks) {
    for (int& id : view) id = id >= 0 ? moved_to[static_cast<std::size_t>(id)] : -1;
  }
  stored.patches = keyframe.patches;
  stored.link = keyframe.link;
  stored.inertial = keyframe.inertial;
  return stored;
}

/// Whether a view is what the estimator may rely on without looking.
bool is_sound(const StereoView& view, const PinholeCamera& lens, std::size_t levels) {
  const std::size_t n = view.features.keypoints.size();
  if (view.features.descriptors.size() != n || view.stereo.size() != n) return false;
  if ((!view.placed.empty() && view.placed.size() != n) || view.followed > n) return false;
  if (!std::isfinite(view.late)) return false;
  for (const Keypoint& k : view.features.keypoints) {
    const Eigen::Vector2d pixel(k.x, k.y);
    const bool level_known = k.level >= 0 && static_cast<std::size_t>(k.level) < levels;
    if (!level_known || !pixel.allFinite() || !lens.contains(pixel, -kImageMargin)) return false;
    if (!std::isfinite(k.angle) || !std::isfinite(k.response)) return false;
  }
  return std::all_of(view.stereo.begin(), view.stereo.end(), [](const StereoMatch& m) {
    return std::isfinite(m.x_right) && std::isfinite(m.depth) && std::isfinite(m.slant_x) &&
           std::isfinite(m.slant_y);
  });
}

/// Checks that `keyframe` fits the rig and the number of landmarks.
void check(const StoredKeyframe& keyframe, const EstimatorRig& rig, std::size_t landmarks,
           const BinaryReader& reader) {
  const std::vector<StereoView>& views = keyframe.frame.views;
  reader.expect(views.size() == rig.rig.pairs.size() && keyframe.landmarks.size() == views.size(),
                "a keyframe has not one view a stereo pair");
  const auto& patches = keyframe.patches;
  reader.expect(patches.empty() || patches.size() == views.size(), "patches of no view");
  for (std::size_t v = 0; v < views.size(); ++v) {
    reader.expect(is_sound(views[v], rig.rig.pairs[v].lens, rig.noise.level_scales.size()),
                  "a keyframe's features");
    const std::size_t n = views[v].features.size();
    reader.expect(patches.empty() || patches[v].size() == 0 || patches[v].size() == n,
                  "patches of no feature");
    reader.expect(keyframe.landmarks[v].size() == n, "ties of no feature");
    for (const int id : keyframe.landmarks[v]) {
      reader.expect(id >= -1 && id < static_cast<int>(landmarks), "a tie to no landmark");
    }
  }
  reader.expect(keyframe.frame.velocity.allFinite(), "a keyframe's velocity");
  reader.expect(is_in_range(keyframe.frame.stamp) && is_in_range(keyframe.frame.index),
                "a keyframe's instant");
  for (const TagSighting& tag : keyframe.frame.tags) {
    reader.expect(
        tag.camera >= 0 && static_cast<std::size_t>(tag.camera) < rig.tag_cameras.cameras.size(),
        "a tag seen by no camera");
    for (const Eigen::Vector2d& corner : tag.corners) {
      reader.expect(corner.allFinite(), "a tag's corners");
    }
    reader.expect(tag.corner_sigma >= 0 && std::isfinite(tag.corner_sigma), "a tag's corners");
  }
}

void add(StoredKeyframe keyframe, const EstimatorRig& rig, Map& map, const BinaryReader& reader) {
  for (std::size_t v = 0; v < keyframe.frame.views.size(); ++v) {
    StereoView& view = keyframe.frame.views[v];
    const PinholeCamera& lens = rig.rig.pairs[v].lens;
    const auto begin = view.features.keypoints.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(view.detected());
    view.grid = FeatureGrid({begin, end}, lens.width, lens.height);
  }
  const int id = map.add_keyframe(std::make_shared<FrameFeatures>(std::move(keyframe.frame)),
                                  keyframe.T_map_body, keyframe.landmarks);
  reader.expect(map.keyframe(id).landmarks == keyframe.landmarks,
                "two features of a view are one landmark");
  map.keyframe(id).patches = std::move(keyframe.patches);
  if (keyframe.link) {
    const Matrix6d& covariance = keyframe.link->covariance;
    reader.expect(keyframe.link->from >= 0 && keyframe.link->from < id && covariance.allFinite() &&
                      covariance.isApprox(covariance.transpose()) &&
                      covariance.llt().info() == Eigen::Success,
                  "a keyframe's link");
  }
  map.keyframe(id).link = keyframe.link;
  if (const auto& state = keyframe.inertial) {
    reader.expect(state->velocity.allFinite() && state->gyroscope_bias.allFinite() &&
                      state->accelerometer_bias.allFinite(),
                  "a keyframe's inertial state");
  }
  map.keyframe(id).inertial = keyframe.inertial;
}

/// Before version 6 there were disparity offsets alone.
std::vector<PairCalibration> read_pairs(BinaryReader& reader) {
  std::vector<PairCalibration> pairs;
  if (reader.version() >= 6) {
    reader(pairs);
    return pairs;
  }
  std::vector<double> offsets;
  reader(offsets);
  for (const double offset : offsets) pairs.push_back({{}, offset});
  return pairs;
}

/// Of the cameras in use now: when the map was made, others may have been. Before version 9 there
/// were none.
std::vector<double> read_tag_times(BinaryReader& reader, const EstimatorRig& rig) {
  std::vector<TagTime> read;
  if (reader.version() >= 9) reader(read);
  std::vector<double> times;
  for (const int camera : rig.rig.tag_cameras) {
    const auto found = std::ranges::find(read, camera, &TagTime::camera);
    times.push_back(found == read.end() ? 0 : found->time);
  }
  return times;
}

void check(const RigCalibration& calibration, const StereoRig& rig, const BinaryReader& reader) {
  reader.expect(calibration.empty() || calibration.pairs.size() == rig.pairs.size(),
                "calibrations of no pair");
  for (const PairCalibration& pair : calibration.pairs) {
    const bool finite = std::isfinite(pair.disparity_offset) &&
                        std::isfinite(pair.disparity_slope) && std::isfinite(pair.time) &&
                        std::isfinite(pair.readout) && pair.principal_point.allFinite() &&
                        pair.right_turn.allFinite() && std::isfinite(pair.right_ahead);
    reader.expect(
        finite && pair.focal > -1 && pair.focal < 1 && pair.baseline > -1 && pair.baseline < 1,
        "a pair's calibration");
  }
  for (const double time : calibration.tag_times) {
    reader.expect(std::isfinite(time), "a camera's time");
  }
}

Map read_content(BinaryReader& reader, const EstimatorRig& rig, const std::string& where) {
  RigFingerprint print;
  reader(print);
  const std::string differs = difference(print, rig_fingerprint(rig));
  if (!differs.empty()) fail("{}: this map was made with another rig: {}", where, differs);
  double level_scale = 0;
  std::vector<MapTag> tags;
  std::vector<Landmark> landmarks;
  std::vector<StoredKeyframe> keyframes;
  reader(level_scale);
  RigCalibration calibration;
  calibration.pairs = read_pairs(reader);
  reader(tags, landmarks, keyframes);
  calibration.tag_times = read_tag_times(reader, rig);
  reader.expect(reader.at_end(), "it goes on after its end");
  reader.expect(std::isfinite(level_scale) && level_scale > 1, "the pyramid's scale");
  check(calibration, rig.rig, reader);
  Map map(level_scale);
  map.calibration() = std::move(calibration);
  for (const MapTag& tag : tags)
    reader.expect(std::isfinite(tag.size) && tag.size > 0, "a tag's size");
  map.tags() = std::move(tags);
  for (Landmark& landmark : landmarks) {
    reader.expect(landmark.position.allFinite() && landmark.normal.allFinite() &&
                      std::isfinite(landmark.max_distance) && landmark.first_keyframe >= 0 &&
                      static_cast<std::size_t>(landmark.first_keyframe) < keyframes.size(),
                  "a landmark");
    reader.expect(
        &landmark == landmarks.data() || landmark.first_keyframe >= (&landmark - 1)->first_keyframe,
        "the order of landmarks");
    landmark.id = static_cast<int>(&landmark - landmarks.data());
  }
  map.landmarks() = std::move(landmarks);
  for (StoredKeyframe& keyframe : keyframes) {
    check(keyframe, rig, map.landmarks().size(), reader);
    add(std::move(keyframe), rig, map, reader);
  }
  for (const Landmark& landmark : map.landmarks()) {
    reader.expect(!landmark.observations.empty(), "a landmark that nobody saw");
  }
  return map;
}

std::vector<TagTime> tag_times(const RigCalibration& calibration, const EstimatorRig& rig) {
  std::vector<TagTime> times;
  for (std::size_t t = 0; t < calibration.tag_times.size(); ++t) {
    times.push_back({rig.rig.tag_cameras[t], calibration.tag_times[t]});
  }
  return times;
}

}  // namespace

std::string format_map(const Map& map, const EstimatorRig& rig) {
  std::vector<int> moved_to;
  const std::vector<Landmark> landmarks = living_landmarks(map, moved_to);
  BinaryWriter content(kVersion);
  content(rig_fingerprint(rig), map.level_scale(), map.calibration().pairs, map.tags(), landmarks,
          static_cast<std::uint32_t>(map.keyframes().size()));
  for (const Keyframe& keyframe : map.keyframes()) {
    content(stored(keyframe, *map.keyframes().back().frame, moved_to));
  }
  content(tag_times(map.calibration(), rig));
  BinaryWriter header;
  header(kVersion, static_cast<std::uint64_t>(content.bytes().size()));
  std::string bytes = std::string(kMagic) + header.take() + content.take();
  BinaryWriter checksum;
  checksum(crc64(bytes));
  return bytes + checksum.take();
}

Map parse_map(std::string_view bytes, const EstimatorRig& rig, const std::string& where) {
  if (bytes.substr(0, kMagic.size()) != kMagic) fail("{}: not a map of Vinebench", where);
  if (bytes.size() < kHeaderSize + kChecksumSize)
    fail("{}: cut off: {} bytes", where, bytes.size());
  std::uint32_t version = 0;
  std::uint64_t size = 0;
  BinaryReader header(bytes.substr(kMagic.size()), where);
  header(version, size);
  if (version < kOldestVersion || version > kVersion) {
    fail("{}: a map of version {}, expected version {} to {}", where, version, kOldestVersion,
         kVersion);
  }
  const std::size_t found = bytes.size() - kHeaderSize - kChecksumSize;
  if (size > found) fail("{}: cut off: {} bytes of content, expected {}", where, found, size);
  if (size < found) fail("{}: damaged: it goes on after its end", where);
  const std::size_t sealed = bytes.size() - kChecksumSize;
  std::uint64_t checksum = 0;
  BinaryReader(bytes.substr(sealed), where)(checksum);
  if (checksum != crc64(bytes.substr(0, sealed))) {
    fail("{}: damaged: its checksum is wrong", where);
  }
  BinaryReader content(bytes.substr(kHeaderSize, size), where, version);
  return read_content(content, rig, where);
}

void save_map(const Map& map, const EstimatorRig& rig, const std::filesystem::path& file) {
  write_file_atomically(file, format_map(map, rig));
}

Map load_map(const std::filesystem::path& file, const EstimatorRig& rig) {
  return with_errors_of(file.string(), [&] {
    return parse_map(read_file(file, FileKind::kMap), rig, file.string());
  });
}

}  // namespace vinebench::slam

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/dataset_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>

#include "core/config/yaml.h"
#include "core/files/files.h"
#include "core/files/output_file.h"
#include "core/util/error.h"
#include "harness/datasets/files/file_manifest.h"
#include "harness/datasets/files/text_table.h"
#include "harness/datasets/format/calibration_file.h"
#include "harness/datasets/format/dataset_card.h"
#include "harness/datasets/formats.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFramesCompared = 6;  // whose label images are held against each other

/// What moves in the world of a sequence.
struct Movement {
  bool wind = false;
  bool occluders = false;
};

/// Undefined where the node has no keys.
YAML::Node value_at(const YAML::Node& node, const char* key) {
  return node.IsDefined() && node.IsMap() ? node[key] : YAML::Node(YAML::NodeType::Undefined);
}

Movement movement_of(const fs::path& scenario) {
  const YAML::Node world = value_at(load_yaml_tree(scenario), "world");
  if (!world.IsDefined() || !world.IsMap()) {
    fail("{}: world: expected a map of keys", scenario.string());
  }
  Movement movement;
  const YAML::Node speed = value_at(value_at(world, "wind"), "speed");
  movement.wind = speed.IsDefined() && speed.as<double>(0) != 0;
  const YAML::Node occluders = value_at(world, "occluders");
  if (!occluders.IsDefined() || !occluders.IsSequence()) return movement;
  for (const auto& occluder : occluders) {
    movement.occluders = movement.occluders || value_at(occluder, "path").IsDefined();
  }
  return movement;
}

/// One sequence, or the folder of several.
class Check {
 public:
  Check(const fs::path& root, const std::string& sequence, DatasetReport& report)
      : folder_(root / sequence),
        prefix_(sequence.empty() ? "" : sequence + "/"),
        report_(report) {}

  void run() {
    card_ = read_card(folder_);
    check_files();
    if (!card_.sequences.empty()) return;
    ++report_.sequences;
    sequence_.folder = folder_;
    sequence_.complete = card_.complete;
    if (has_begun()) check_sequence();
    if (card_.complete) return;
    note_interruption(
        fmt::format("{} of {} frames", sequence_.frames.size(), card_.planned_frames));
  }

  /// Of the folder of several sequences.
  void note_complete_sequences(std::size_t complete) {
    if (card_.complete) return;
    note_interruption(fmt::format("{} of {} sequences, {} frames", complete, card_.sequences.size(),
                                  report_.frames));
  }

  const DatasetCard& card() const { return card_; }

 private:
  void note_interruption(const std::string& extent) {
    if (prefix_.empty()) report_.interrupted = extent;
    report_.notes.push_back(
        fmt::format("{}recording was interrupted: {}; the existing part was checked",
                    prefix_.empty() ? "" : prefix_ + ": ", extent));
  }

  /// frames.csv is the last file that a recording creates before its first frame.
  bool has_begun() const {
    std::error_code ignored;
    return card_.complete || fs::is_regular_file(folder_ / kRecordedFrames, ignored);
  }

  void check_sequence() {
    check_frames();
    sequence_.rig = read_calibration(folder_ / "calibration.yaml");
    const Movement movement = movement_of(folder_ / "scenario.resolved.yaml");
    sequence_.windy = movement.wind;
    sequence_.busy = movement.occluders;
    check_formats();
  }

  void fault(const std::string& file, const std::string& problem) {
    report_.faults.push_back({prefix_ + file, problem});
  }

  void check_files() {
    const fs::path list = folder_ / FileManifest::kName;
    if (card_.complete && xxh128(read_file(list, FileKind::kTable)) != card_.files_xxh128) {
      fault(FileManifest::kName, "does not match its hash in dataset.yaml");
    }
    std::error_code ignored;
    if (!card_.complete && !fs::exists(list, ignored)) return;
    std::set<std::string> listed{DatasetCard::kName, FileManifest::kName};
    for (const ListedFile& file : read_manifest(list)) {
      if (!listed.insert(file.name).second) fault(file.name, "is listed twice");
      ++report_.files;
      if (!fs::is_regular_file(folder_ / file.name, ignored)) {
        fault(file.name, "is missing");
      } else if (xxh128_of_file(folder_ / file.name) != file.hash) {
        fault(file.name, "is damaged: its hash differs from the list");
      }
    }
    if (!card_.complete || !card_.sequences.empty())
      return;  // incomplete lists are not in the manifest
    for (const std::string& name : files_below(folder_)) {
      if (!listed.contains(name) && !name.ends_with(kPartialEnding)) {
        fault(name, "is not in the list of files");
      }
    }
  }

  void check_frames() {
    for (const TableRow& row : sequence_.read(kRecordedFrames)) {
      row.expect_columns(10, "number, frame, timestamp [ns], position, quaternion");
      RecordedPose frame{row.nanoseconds(2), {}};
      frame.T_world_body.translation = {row.number(3), row.number(4), row.number(5)};
      frame.T_world_body.rotation =
          Eigen::Quaterniond(row.number(9), row.number(6), row.number(7), row.number(8));
      if (row.number(0) != static_cast<double>(sequence_.frames.size())) {
        fault(kRecordedFrames, fmt::format("expected number {} here", sequence_.frames.size()));
      }
      if (!sequence_.frames.empty() && frame.stamp <= sequence_.frames.back().stamp) {
        fault(kRecordedFrames,
              fmt::format("frame {}: its stamp does not ascend", sequence_.frames.size()));
      }
      if (std::abs(frame.T_world_body.rotation.norm() - 1) > 1e-9) {
        fault(kRecordedFrames, fmt::format("frame {}: its quaternion is not of unit length",
                                           sequence_.frames.size()));
      }
      sequence_.frames.push_back(frame);
    }
    report_.frames += static_cast<std::int64_t>(sequence_.frames.size());
    if (card_.complete && static_cast<std::int64_t>(sequence_.frames.size()) != card_.frames) {
      fault(kRecordedFrames, fmt::format("has {} frames, dataset.yaml says {}",
                                         sequence_.frames.size(), card_.frames));
    }
  }

  /// The checks of every format: its lists, and label images of some frames.
  void check_formats() {
    std::vector<DatasetFault> faults;
    std::vector<const DatasetFormat*> formats;
    for (const DatasetFormat& format : dataset_formats()) {
      if (!sequence_.has(format.name)) continue;
      formats.push_back(&format);
      if (format.check) format.check(sequence_, faults);
    }
    const std::size_t step = (sequence_.frames.size() + kFramesCompared - 1) / kFramesCompared;
    for (std::size_t frame = 0; frame < sequence_.frames.size(); frame += step) {
      for (std::size_t camera = 0; camera < sequence_.rig.cameras.size(); ++camera) {
        LabelImages images(sequence_, frame, camera, faults);
        for (const DatasetFormat* format : formats) {
          if (format->check_image) format->check_image(images);
        }
        report_.label_images += images.images();
      }
    }
    for (const DatasetFault& found : faults) fault(found.file, found.problem);
  }

  fs::path folder_;
  std::string prefix_;
  DatasetReport& report_;
  DatasetCard card_;
  RecordedSequence sequence_;
};

}  // namespace

DatasetReport check_dataset(const fs::path& folder) {
  if (has_partial_card_alone(folder)) {
    fail("{}: was interrupted before its first file was complete; --resume of record goes on",
         folder.string());
  }
  if (!has_card(folder)) {
    fail("{}: is no data set of ours: expected a folder with {}", folder.string(),
         DatasetCard::kName);
  }
  DatasetReport report;
  Check whole(folder, "", report);
  whole.run();
  std::size_t complete = 0;
  for (const std::string& name : whole.card().sequences) {
    if (!whole.card().complete && !has_card(folder / name)) continue;  // has not begun
    Check sequence(folder, name, report);
    sequence.run();
    complete += sequence.card().complete ? 1 : 0;
  }
  if (!whole.card().sequences.empty()) whole.note_complete_sequences(complete);
  return report;
}

}  // namespace vinebench::harness

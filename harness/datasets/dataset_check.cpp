// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/dataset_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>

#include "core/trajectory.h"
#include "core/util/error.h"
#include "core/util/files.h"
#include "harness/datasets/files/file_manifest.h"
#include "harness/datasets/files/text_table.h"
#include "harness/datasets/format/dataset_card.h"
#include "harness/datasets/labels/label_check.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPartial = ".partial";

/// One sequence, or the folder of several.
class Check {
 public:
  Check(const fs::path& root, const std::string& sequence, DatasetReport& report)
      : folder_(root / sequence),
        prefix_(sequence.empty() ? "" : sequence + "/"),
        report_(report) {}

  void run() {
    card_ = read_card(folder_);
    if (!card_.complete) {
      report_.notes.push_back(
          fmt::format("{}recording was interrupted; what there is of it was checked",
                      prefix_.empty() ? "" : prefix_ + ": "));
    }
    check_files();
    if (!card_.sequences.empty()) return;
    ++report_.sequences;
    check_frames();
    check_lists();
    const LabelCheck labels = check_labels(folder_, frames_);
    report_.label_images += labels.images;
    for (const DatasetFault& found : labels.faults) fault(found.file, found.problem);
  }

  const DatasetCard& card() const { return card_; }

 private:
  void fault(const std::string& file, const std::string& problem) {
    report_.faults.push_back({prefix_ + file, problem});
  }

  void check_files() {
    const fs::path list = folder_ / FileManifest::kName;
    if (card_.complete && xxh128(read_file(list)) != card_.files_xxh128) {
      fault(FileManifest::kName, "is not the list that dataset.yaml has the hash of");
    }
    std::set<std::string> listed{DatasetCard::kName, FileManifest::kName};
    for (const ListedFile& file : read_manifest(list)) {
      if (!listed.insert(file.name).second) fault(file.name, "is listed twice");
      ++report_.files;
      std::error_code ignored;
      if (!fs::is_regular_file(folder_ / file.name, ignored)) {
        fault(file.name, "is missing");
      } else if (xxh128_of_file(folder_ / file.name) != file.hash) {
        fault(file.name, "is damaged: its hash is not that of the list");
      }
    }
    if (!card_.complete || !card_.sequences.empty()) return;  // lists are named when they are whole
    for (const std::string& name : files_below(folder_)) {
      if (!listed.contains(name) && !name.ends_with(kPartial)) {
        fault(name, "is not in the list of files");
      }
    }
  }

  void check_frames() {
    for (const TableRow& row : read_table(folder_ / "frames.csv")) {
      row.expect_columns(10, "number, frame, timestamp [ns], position, quaternion");
      RecordedPose frame{row.nanoseconds(2), {}};
      frame.T_world_body.translation = {row.number(3), row.number(4), row.number(5)};
      frame.T_world_body.rotation =
          Eigen::Quaterniond(row.number(9), row.number(6), row.number(7), row.number(8));
      if (row.number(0) != static_cast<double>(frames_.size())) {
        fault("frames.csv", fmt::format("expected number {} in its place", frames_.size()));
      }
      if (!frames_.empty() && frame.stamp <= frames_.back().stamp) {
        fault("frames.csv", fmt::format("frame {}: its stamp does not ascend", frames_.size()));
      }
      if (std::abs(frame.T_world_body.rotation.norm() - 1) > 1e-9) {
        fault("frames.csv", fmt::format("frame {}: its quaternion is no unit one", frames_.size()));
      }
      frames_.push_back(frame);
    }
    report_.frames += static_cast<std::int64_t>(frames_.size());
    if (card_.complete && static_cast<std::int64_t>(frames_.size()) != card_.frames) {
      fault("frames.csv",
            fmt::format("has {} frames, dataset.yaml says {}", frames_.size(), card_.frames));
    }
  }

  bool exists(const std::string& name) const {
    std::error_code ignored;
    return fs::exists(folder_ / name, ignored);
  }

  /// Of a list of one line a frame; an interrupted recording may be a frame ahead in some.
  void expect_rows(const std::string& name, std::size_t rows) {
    const std::size_t frames = frames_.size();
    if (rows == frames || (!card_.complete && rows >= frames && rows <= frames + 1)) return;
    fault(name, fmt::format("has {} lines, expected one for each of {} frames", rows, frames));
  }

  void check_lists() {
    if (exists("euroc")) check_euroc();
    if (exists("kitti")) {
      for (const char* name : {"kitti/times.txt", "kitti/poses.txt"}) {
        expect_rows(name, read_table(folder_ / name).size());
      }
    }
    if (!exists("tum")) return;
    for (const std::string& name : files_below(folder_ / "tum")) {
      expect_rows("tum/" + name, read_tum(folder_ / "tum" / name).size());
    }
  }

  void check_euroc() {
    expect_rows("euroc/frames.csv", read_table(folder_ / "euroc/frames.csv").size());
    std::set<Stamp> stamps;
    for (const RecordedPose& frame : frames_) stamps.insert(frame.stamp);
    for (int i = 0; exists(fmt::format("euroc/mav0/cam{}", i)); ++i) {
      const std::string camera = fmt::format("euroc/mav0/cam{}", i);
      for (const TableRow& row : read_table(folder_ / camera / "data.csv")) {
        row.expect_columns(2, "timestamp [ns], filename");
        if (card_.complete && !stamps.contains(row.nanoseconds(0))) {
          fault(camera + "/data.csv", fmt::format("{}: no frame has this stamp", row.fields[0]));
        }
        if (!exists(camera + "/data/" + row.fields[1])) {
          fault(camera + "/data.csv", fmt::format("{}: there is no such image", row.fields[1]));
        }
      }
    }
    const std::string truth = "euroc/mav0/state_groundtruth_estimate0/data.csv";
    const std::size_t rows = read_table(folder_ / truth).size();
    if (card_.complete) expect_rows(truth, rows);
    for (const TableRow& row : read_table(folder_ / truth)) row.expect_columns(17, "EuRoC's");
  }

  fs::path folder_;
  std::string prefix_;
  DatasetReport& report_;
  DatasetCard card_;
  std::vector<RecordedPose> frames_;
};

}  // namespace

DatasetReport check_dataset(const fs::path& folder) {
  if (!has_card(folder)) {
    fail("{}: is no data set of ours: expected a folder with {}", folder.string(),
         DatasetCard::kName);
  }
  DatasetReport report;
  Check whole(folder, "", report);
  whole.run();
  for (const std::string& sequence : whole.card().sequences) Check(folder, sequence, report).run();
  return report;
}

}  // namespace vinebench::harness

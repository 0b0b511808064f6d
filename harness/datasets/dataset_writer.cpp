// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/dataset_writer.h"

#include <fmt/format.h>

#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/datasets/files/append_file.h"
#include "harness/datasets/files/dataset_folder.h"
#include "harness/datasets/format/calibration_file.h"
#include "harness/datasets/formats.h"
#include "vinebench/version.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

/// frames.csv. It is written last, so a frame in it is complete in all formats.
class FrameList : public FormatWriter {
 public:
  explicit FrameList(const fs::path& file) : list_(file) {
    list_.append(
        "#number,frame,timestamp [ns],p_x [m],p_y [m],p_z [m],q_x [],q_y [],q_z [],q_w []\n");
  }
  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>&) override { return {}; }
  void commit(const DatasetFrame& frame) override {
    const Eigen::Vector3d& p = frame.truth.T_world_body.translation;
    const Eigen::Quaterniond& q = frame.truth.T_world_body.rotation;
    list_.append(fmt::format("{},{},{},{},{},{},{},{},{},{}\n", frame.number, frame.frame.index,
                             frame.frame.stamp, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()));
  }

 private:
  AppendFile list_;
};

std::vector<std::size_t> chosen_cameras(const CapturePlan& plan, const Rig& rig) {
  std::vector<std::size_t> cameras;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    if (plan.has_camera(i)) cameras.push_back(i);
  }
  return cameras;
}

}  // namespace

DatasetCard initial_card(const RecordingNotes& notes, const RecordOptions& options, const Rig& rig,
                         std::int64_t planned) {
  DatasetCard card;
  card.name = notes.scenario;
  card.made_by = fmt::format("Vinebench {}", kVersion);
  card.scenario = notes.scenario;
  card.world = notes.world;
  card.seed = notes.seed;
  card.planned_frames = planned;
  card.formats = options.formats;
  for (const std::size_t camera : chosen_cameras(plan_of(options, rig), rig)) {
    card.cameras.push_back(rig.cameras[camera].name);
  }
  card.settings_xxh128 = settings_hash(notes, options);
  return card;
}

void clear_recording(const fs::path& folder) {
  for (const char* list : {FileManifest::kName, kRecordedFrames}) {
    std::error_code ignored;
    fs::remove(folder / list, ignored);
  }
  clear_folder(folder, DatasetCard::kName);
}

std::string settings_hash(const RecordingNotes& notes, const RecordOptions& options) {
  return xxh128(notes.settings + options.text() + kVersion);
}

DatasetWriter::DatasetWriter(const fs::path& folder, const RecordingNotes& notes,
                             const SimulatedSource& source, const RecordOptions& options,
                             std::int64_t planned)
    : folder_(folder),
      options_(options),
      plan_(plan_of(options, source.rig())),
      cameras_(chosen_cameras(plan_, source.rig())),
      card_(initial_card(notes, options, source.rig(), planned)) {
  RecordingNotes chosen = with_cameras(notes, options.cameras);
  chosen.first_reading = source.first_reading();
  claim_folder(folder);
  try {
    begin(chosen, source.scene());
  } catch (const Error&) {  // a format that is incompatible with the rig: the folder is unchanged
    clear_recording(folder);
    throw;
  }
}

void DatasetWriter::begin(const RecordingNotes& notes, const SceneIndex& scene) {
  write_card(folder_, card_);  // first, so that any interruption leaves a recording to resume
  write_file_atomically(folder_ / "scenario.resolved.yaml", notes.settings);
  Rig rig = notes.rig.make();
  rig.cameras = notes.true_cameras;
  write_file_atomically(folder_ / "calibration.yaml", format_calibration(rig));
  manifest_ = std::make_unique<FileManifest>(folder_);
  encoder_ = std::make_unique<DatasetEncoder>(make_writers(notes, scene), options_.threads, folder_,
                                              manifest_.get());
}

DatasetEncoder::Writers DatasetWriter::make_writers(const RecordingNotes& notes,
                                                    const SceneIndex& scene) const {
  DatasetEncoder::Writers writers;
  for (const bool looks_back : {false, true}) {
    for (const std::string& name : options_.formats) {
      const DatasetFormat& format = format_named(name);
      if (format.looks_back != looks_back) continue;
      auto writer = format.write({folder_ / name, notes, scene, options_});
      if (writer != nullptr) writers.push_back(std::move(writer));
    }
  }
  writers.push_back(std::make_unique<FrameList>(folder_ / kRecordedFrames));
  return writers;
}

DatasetFrame DatasetWriter::frame_of(const Sample& sample) const {
  Sample chosen = sample;
  chosen.frame.images.clear();
  chosen.frame.image_stamps.clear();
  chosen.truth.views.clear();
  for (const std::size_t camera : cameras_) {
    chosen.frame.images.push_back(sample.frame.images.at(camera));
    if (!sample.frame.image_stamps.empty()) {
      chosen.frame.image_stamps.push_back(sample.frame.image_stamps.at(camera));
    }
    if (!sample.truth.views.empty()) chosen.truth.views.push_back(sample.truth.views.at(camera));
  }
  return own_frame(chosen, frames_);
}

void DatasetWriter::on_tick(const Sample& sample, const Estimate&) {
  if (!plan_.has_frame(sample.frame.index)) return;
  frames_hash_.on_tick(sample, {});
  encoder_->submit(frame_of(sample));
  ++frames_;
}

void DatasetWriter::on_finish(const SlamSummary&) {
  encoder_->finish();
  manifest_->add_rest({DatasetCard::kName});
  card_.frames = frames_;
  card_.complete = frames_ == card_.planned_frames;
  card_.frames_xxh128 = frames_hash_.digits();
  card_.files = manifest_->files();
  card_.files_xxh128 = xxh128(read_file(folder_ / FileManifest::kName));
  write_card(folder_, card_);
}

}  // namespace vinebench::harness

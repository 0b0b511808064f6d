// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/record.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "harness/datasets/dataset_check.h"
#include "harness/datasets/files/file_manifest.h"
#include "harness/datasets/format/dataset_card.h"
#include "harness/datasets/open_recording.h"
#include "tests/support/small_scenario.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;

constexpr std::int64_t kFrames = 6;

class RecordTest : public test::SmallScenario {
 protected:
  /// In a walled court, where images do not matter.
  void draw_without_plants() { request_.overrides.emplace_back("renderer.engine", "fake"); }
  std::string manifest() const { return read_file(request_.out / "files.xxh128"); }
  std::vector<std::string> faults() const {
    std::vector<std::string> texts;
    for (const DatasetFault& fault : check_dataset(request_.out).faults) {
      texts.push_back(fault.file + ": " + fault.problem);
    }
    return texts;
  }
};

TEST_F(RecordTest, TheSameBytesForAnyNumberOfThreads) {
  const std::vector<std::string> all = all_formats();
  EXPECT_EQ(record(all).frames, kFrames);
  const std::string first = manifest();
  EXPECT_THAT(faults(), testing::IsEmpty());
  request_.out = folder_ / "again";
  request_.options.threads = 1;
  record(all);
  EXPECT_EQ(manifest(), first);
  const DatasetCard card = read_card(request_.out);
  EXPECT_TRUE(card.complete);
  EXPECT_EQ(card.frames, kFrames);
  EXPECT_EQ(card.cameras, (std::vector<std::string>{"left", "right", "side"}));
}

TEST_F(RecordTest, AnImageOfTwoFormatsIsOneFileOnTheDisk) {
  draw_without_plants();
  const RecordOutcome outcome = record({"rgb", "coco"});
  const auto image = request_.out / "rgb" / "left" / "000000.png";
  const auto other = request_.out / "coco" / "images" / "left_000000.png";
  EXPECT_TRUE(std::filesystem::equivalent(image, other));
  const auto names = files_below(request_.out);
  std::uint64_t named = 0;
  for (const std::string& name : names) named += std::filesystem::file_size(request_.out / name);
  std::uint64_t images = 0;
  for (const std::string& name : names) {
    if (name.starts_with("rgb/")) images += std::filesystem::file_size(request_.out / name);
  }
  EXPECT_EQ(named - images, outcome.bytes);
  EXPECT_THAT(faults(), testing::IsEmpty());
}

TEST_F(RecordTest, AnInterruptedRecordingIsReadableAndGoesOn) {
  const RecordOutcome stopped = record({"euroc", "coco", "depth", "semantic"}, 3);
  EXPECT_TRUE(stopped.interrupted);
  EXPECT_EQ(stopped.frames, 3);
  EXPECT_FALSE(read_card(request_.out).complete);
  EXPECT_THAT(faults(), testing::IsEmpty());
  EXPECT_EQ(check_dataset(request_.out).notes.size(), 1u);
  EXPECT_EQ(open_recording(request_.out).frames.size(), 3u);

  EXPECT_THAT(error_of([&] { record({"euroc"}); }), HasSubstr("is not empty"));
  request_.resume = true;
  EXPECT_THAT(error_of([&] { record({"euroc"}); }), HasSubstr("with other settings"));
  EXPECT_EQ(open_recording(request_.out).frames.size(), 3u);  // unchanged
  EXPECT_EQ(record({"euroc", "coco", "depth", "semantic"}).frames, kFrames);
  const std::string resumed = manifest();
  EXPECT_EQ(record({"euroc", "coco", "depth", "semantic"}).skipped, 1);
  request_.resume = false;
  request_.out = folder_ / "at once";
  record({"euroc", "coco", "depth", "semantic"});
  EXPECT_EQ(manifest(), resumed);
}

TEST_F(RecordTest, AQualityIsAmongTheResolvedKeys) {
  draw_without_plants();
  request_.overrides.emplace_back("renderer.lod_scale", "2");
  request_.quality = sim::RenderQuality::kFine;
  record({"rgb", "semantic"});
  const std::string resolved = read_file(request_.out / "scenario.resolved.yaml");
  EXPECT_THAT(resolved, HasSubstr("supersampling: 2"));
  EXPECT_THAT(resolved, HasSubstr("lod_scale: 2"));  // --set is stronger
  EXPECT_THAT(faults(), testing::IsEmpty());
}

// The files are made in this order; the recording ends before each of them.
TEST_F(RecordTest, ARecordingThatEndedBeforeItsFirstFrameGoesOn) {
  draw_without_plants();
  record({"euroc"});
  const std::string whole = manifest();
  const std::vector<std::string> made{"scenario.resolved.yaml", "calibration.yaml", "files.xxh128",
                                      "euroc", "frames.csv"};
  request_.out = folder_ / "begun";
  record({"euroc"}, 0);
  std::ofstream(request_.out / "files.xxh128");  // empty, as before the first frame
  for (std::size_t there = 0; there <= made.size(); ++there) {
    request_.out = folder_ / std::to_string(there);
    std::filesystem::copy(folder_ / "begun", request_.out,
                          std::filesystem::copy_options::recursive);
    for (std::size_t i = there; i < made.size(); ++i) {
      std::filesystem::remove_all(request_.out / made[i]);
    }
    EXPECT_THAT(faults(), testing::IsEmpty()) << there;
    EXPECT_EQ(check_dataset(request_.out).interrupted, "0 of 6 frames") << there;
    request_.resume = true;
    EXPECT_EQ(record({"euroc"}).frames, kFrames) << there;
    EXPECT_EQ(manifest(), whole) << there;
  }
}

TEST_F(RecordTest, ARecordingThatEndedBeforeItsCardWasCompleteGoesOn) {
  draw_without_plants();
  std::filesystem::create_directories(request_.out);
  folder_.write("data/dataset.yaml.partial", "name:");
  EXPECT_THAT(error_of([&] { check_dataset(request_.out); }), HasSubstr("was interrupted before"));
  EXPECT_THAT(error_of([&] { record({"euroc"}); }), HasSubstr("is not empty"));
  request_.resume = true;
  EXPECT_EQ(record({"euroc"}).frames, kFrames);
  EXPECT_THAT(faults(), testing::IsEmpty());
}

// A recording that was resumed and ended while the earlier one was removed.
TEST_F(RecordTest, WhatIsHalfRemovedGoesOn) {
  draw_without_plants();
  record({"euroc"}, 3);
  std::filesystem::remove(request_.out / "files.xxh128");
  std::filesystem::remove(request_.out / "frames.csv");
  std::filesystem::remove_all(request_.out / "euroc/mav0/cam0");
  EXPECT_THAT(faults(), testing::IsEmpty());
  request_.resume = true;
  EXPECT_EQ(record({"euroc"}).frames, kFrames);
  EXPECT_THAT(faults(), testing::IsEmpty());
}

TEST_F(RecordTest, AnInterruptedSetSaysWhatThereIs) {
  const auto root_files = [&] {
    return read_file(request_.out / "files.xxh128") + read_file(request_.out / "dataset.yaml");
  };
  draw_without_plants();
  request_.seeds = {4, 6};
  record({"coco"});
  const std::string whole = root_files();
  request_.out = folder_ / "stopped";
  EXPECT_TRUE(record({"coco"}, kFrames + 3).interrupted);
  EXPECT_EQ(check_dataset(request_.out).interrupted, "1 of 3 sequences, 8 frames");
  EXPECT_THAT(faults(), testing::IsEmpty());
  // As after an abrupt end: the initial card, and no list.
  DatasetCard card = read_card(request_.out);
  EXPECT_EQ(card.sequences.size(), 3u);
  card.frames = card.planned_frames = card.files = 0;
  card.files_xxh128 = "";
  write_card(request_.out, card);
  std::filesystem::remove(request_.out / "files.xxh128");
  EXPECT_EQ(check_dataset(request_.out).interrupted, "1 of 3 sequences, 8 frames");
  EXPECT_THAT(faults(), testing::IsEmpty());
  // Killed while the card was written.
  folder_.write("stopped/dataset.yaml.0123456789abcdef.partial", "name:");
  folder_.write("stopped/notes.partial", "a user's own");
  request_.resume = true;
  EXPECT_EQ(record({"coco"}).skipped, 1);
  EXPECT_FALSE(std::filesystem::exists(request_.out / "dataset.yaml.0123456789abcdef.partial"));
  EXPECT_TRUE(std::filesystem::exists(request_.out / "notes.partial"));
  EXPECT_EQ(root_files(), whole);
  EXPECT_EQ(check_dataset(request_.out).interrupted, "");
}

TEST_F(RecordTest, ResumingAsSomethingElseChangesNothing) {
  draw_without_plants();
  request_.resume = true;
  record({"rgb"});
  const auto unchanged = [&](const std::string& message) {
    const std::string before = read_file(request_.out / "dataset.yaml") + manifest();
    EXPECT_THAT(error_of([&] { record({"rgb"}); }), HasSubstr(message));
    EXPECT_EQ(read_file(request_.out / "dataset.yaml") + manifest(), before);
  };
  request_.seeds = {1, 2};
  unchanged("is one sequence; expected no --seeds");
  request_.out = folder_ / "set";
  record({"rgb"});
  request_.seeds = {1, 1};
  unchanged("has 2 sequences; expected --seeds with at least these");
  request_.seeds = {2, 3};
  unchanged("from another seed on");
  request_.seeds.reset();
  unchanged("has several sequences; expected the same --seeds");
}

TEST_F(RecordTest, BytesAreThoseOfAllFiles) {
  draw_without_plants();
  const RecordOutcome outcome = record({"coco"});
  std::uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(request_.out)) {
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  EXPECT_EQ(outcome.bytes, bytes);
}

TEST_F(RecordTest, WhatAnAbruptEndLeavesIsReadable) {
  record({"euroc", "depth"}, 3);
  // As after a power failure: the initial dataset.yaml, half a line, half an image.
  DatasetCard card = read_card(request_.out);
  card.frames = 0;
  card.files_xxh128 = "";
  write_card(request_.out, card);
  std::ofstream(request_.out / "files.xxh128", std::ios::app) << "0123abc";
  folder_.write("data/depth/left/000003.png.partial", "half");
  EXPECT_THAT(faults(), testing::IsEmpty());
  EXPECT_EQ(open_recording(request_.out).frames.size(), 3u);
}

TEST_F(RecordTest, DamageIsFound) {
  record({"euroc", "tum", "depth", "semantic", "disparity"});
  EXPECT_THAT(faults(), testing::IsEmpty());
  EXPECT_EQ(check_dataset(request_.out).label_images, kFrames * (3 + 3 + 1));
  const std::string good = read_file(request_.out / "depth/left/000002.png");
  folder_.write("data/depth/left/000002.png", read_file(request_.out / "depth/left/000004.png"));
  EXPECT_THAT(faults(), testing::Contains(HasSubstr("depth/left/000002.png: is damaged")));
  EXPECT_THAT(faults(), testing::Contains(HasSubstr("disparity/left/000002.png: is not focal")));
  folder_.write("data/depth/left/000002.png", good.substr(0, good.size() / 2));
  EXPECT_THAT(faults(), testing::Contains(HasSubstr("000002.png: is damaged")));
  folder_.write("data/depth/left/000002.png", good);
  folder_.write("data/stray.txt", "");
  EXPECT_THAT(faults(), testing::ElementsAre("stray.txt: is not in the list of files"));
  std::filesystem::remove(request_.out / "stray.txt");
  std::filesystem::remove(request_.out / "euroc/mav0/cam1/data/0000000000000000000.png");
  EXPECT_THAT(faults(), testing::UnorderedElementsAre(
                            HasSubstr("cam1/data/0000000000000000000.png: is missing"),
                            HasSubstr("cam1/data.csv: 0000000000000000000.png: image is missing")));
  EXPECT_THAT(error_of([&] { check_dataset(folder_.path()); }),
              HasSubstr("is no data set of ours"));
}

TEST_F(RecordTest, ADamagedScenarioIsAnErrorWithItsFile) {
  record({"tum"});
  const auto problem = [&](const std::string& text) {
    const auto file = folder_.write("data/scenario.resolved.yaml", text);
    const std::string error = error_of([&] { check_dataset(request_.out); });
    EXPECT_THAT(error, HasSubstr(file.string())) << text;
    return error;
  };
  EXPECT_THAT(problem("world: [1\n"), HasSubstr("is not valid YAML"));
  EXPECT_THAT(problem("world: 5\n"), HasSubstr("world: expected a map"));
  EXPECT_THAT(problem("7\n"), HasSubstr("world: expected a map"));
  folder_.write("data/scenario.resolved.yaml", "world: {wind: 5, occluders: [1, {path: []}]}\n");
  EXPECT_THAT(faults(), testing::ElementsAre(HasSubstr("scenario.resolved.yaml: is damaged")));
  std::filesystem::create_symlink("loop", request_.out / "loop");
  EXPECT_THAT(faults(), testing::SizeIs(1));
}

TEST_F(RecordTest, SeedsAreSequencesWithDrawsOfTheirOwn) {
  request_.seeds = {4, 5};
  request_.options.cameras = {"left"};
  request_.randomisation =
      folder_.write("draws.yaml", "draws: [{key: world.sun.elevation_deg, uniform: [15, 70]}]");
  const RecordOutcome outcome = record({"coco"});
  EXPECT_EQ(outcome.sequences, 2);
  EXPECT_EQ(outcome.frames, 2 * kFrames);
  EXPECT_THAT(faults(), testing::IsEmpty());
  EXPECT_EQ(check_dataset(request_.out).sequences, 2);
  const std::string all = read_file(request_.out / "instances.json");
  EXPECT_THAT(all, HasSubstr("\"file_name\":\"seed_000004/coco/images/left_000000.png\""));
  EXPECT_THAT(all, HasSubstr("\"file_name\":\"seed_000005/coco/images/left_000005.png\""));
  const auto sun = [&](const std::string& sequence) {
    return load_scenario(request_.out / sequence / "scenario.resolved.yaml")
        .simulation.world.sun.elevation_deg;
  };
  EXPECT_NE(sun("seed_000004"), sun("seed_000005"));
}

TEST_F(RecordTest, FramesAndCamerasAreThoseAskedFor) {
  request_.options.first = 1;
  request_.options.last = 4;
  request_.options.every = 2;
  request_.options.cameras = {"side"};
  EXPECT_EQ(record({"rgb", "depth"}).frames, 2);
  const std::string sparse = read_file(request_.out / "rgb/side/000001.png");
  EXPECT_FALSE(std::filesystem::exists(request_.out / "rgb/left"));
  EXPECT_THAT(faults(), testing::IsEmpty());
  request_.options = {};
  request_.out = folder_ / "all";
  record({"rgb"});
  EXPECT_EQ(read_file(request_.out / "rgb/side/000003.png"), sparse);
}

TEST_F(RecordTest, AFolderInUseIsAnErrorAndUnchanged) {
  request_.resume = true;
  for (const bool several : {false, true}) {
    if (several) request_.seeds = {1, 2};
    const FolderLock other(request_.out);
    EXPECT_THAT(error_of([&] { record({"rgb"}); }),
                HasSubstr("recording " + request_.out.string() + ": another process is writing"));
    EXPECT_TRUE(std::filesystem::is_empty(request_.out));
  }
}

// It would be taken for an interrupted sequence, and its content removed.
TEST_F(RecordTest, ALinkInASequencesPlaceIsNotFollowed) {
  record({"rgb"}, 3);
  std::filesystem::create_directories(folder_ / "all");
  std::filesystem::create_directory_symlink(request_.out, folder_ / "all/seed_000001");
  const std::string before = manifest();
  request_.out = folder_ / "all";
  request_.seeds = {1, 1};
  request_.resume = true;
  EXPECT_THAT(error_of([&] { record({"rgb"}); }), HasSubstr("seed_000001: is a link"));
  EXPECT_EQ(read_file(folder_ / "data/files.xxh128"), before);
}

TEST_F(RecordTest, BadRequestsAreOneError) {
  request_.options.cameras = {"lefft"};
  EXPECT_THAT(error_of([&] { record({"rgb"}); }), HasSubstr("no camera named 'lefft'"));
  request_.options.cameras = {"left"};
  EXPECT_THAT(error_of([&] {
                record({"rgb", "kitti"});
              }),
              HasSubstr("kitti: expected a stereo pair"));
  EXPECT_TRUE(std::filesystem::is_empty(request_.out));
  request_.options.cameras = {};
  request_.out = folder_ / "late";
  request_.options.first = 1000;
  EXPECT_THAT(error_of([&] { record({"rgb"}); }), HasSubstr("--frames"));
  EXPECT_THAT(error_of([] { parse_formats({"eroc"}); }),
              HasSubstr("expected some of euroc, kitti"));
  EXPECT_THAT(error_of([] { parse_categories({"grape"}); }), HasSubstr("expected some of bunch"));
  for (const char* bad : {"5..3", "a..b", "1..", "-1..3", "..", "1.5"}) {
    EXPECT_THAT(error_of([&] { parse_span(bad, "--seeds"); }), HasSubstr("expected A..B")) << bad;
  }
  EXPECT_EQ(parse_span("3..12", "--seeds"), (std::pair<std::int64_t, std::int64_t>{3, 12}));
  EXPECT_EQ(parse_span("7", "--seeds"), (std::pair<std::int64_t, std::int64_t>{7, 7}));
}

}  // namespace
}  // namespace vinebench::harness

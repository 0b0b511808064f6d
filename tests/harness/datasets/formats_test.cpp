// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/formats.h"

#include <gmock/gmock.h>

#include <set>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(FormatsTest, EveryDescriptorSaysWhatItMust) {
  std::set<std::string> names;
  for (const DatasetFormat& format : dataset_formats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_FALSE(format.description.empty()) << format.name;
    EXPECT_EQ(format.description.find('\n'), std::string::npos) << format.name;
    EXPECT_TRUE(format.write) << format.name;
    const FormatReader& reader = format.reader;
    EXPECT_EQ(static_cast<bool>(reader.read), static_cast<bool>(reader.recognises)) << format.name;
    EXPECT_EQ(static_cast<bool>(reader.read), !reader.layout.empty()) << format.name;
    EXPECT_EQ(static_cast<bool>(format.joined.join), !format.joined.files.empty()) << format.name;
    EXPECT_EQ(&format_named(format.name), &format);
  }
}

TEST(FormatsTest, NamesAreParsedIntoTheListsOrder) {
  EXPECT_THAT(parse_formats({"coco", "euroc", "coco", "flo"}), ElementsAre("euroc", "flo", "coco"));
  EXPECT_THAT(error_of([] {
                parse_formats({"euroc", "eroc"});
              }),
              HasSubstr("--format: unknown format 'eroc', expected some of euroc, kitti"));
  EXPECT_THAT(error_of([] { parse_formats({}); }), HasSubstr("expected some of euroc, kitti"));
  EXPECT_EQ(error_of([] { format_named("eroc"); }), "unknown format 'eroc'");
}

TEST(FormatsTest, ThePlanHasTheTruthOfAllFormats) {
  Rig rig;
  rig.cameras.resize(2);
  rig.cameras[0].name = "left";
  rig.cameras[1].name = "right";
  RecordOptions options;
  options.formats = {"euroc", "depth"};
  options.cameras = {"right"};
  options.first = 3;
  options.every = 2;
  CapturePlan plan = plan_of(options, rig);
  EXPECT_TRUE(plan.depth);
  EXPECT_FALSE(plan.labels || plan.normals || plan.motion || plan.instances);
  EXPECT_THAT(plan.cameras, ElementsAre(false, true));
  EXPECT_TRUE(plan.has_frame(5));
  EXPECT_FALSE(plan.has_frame(4));
  options.formats = {"flo", "instances"};  // flow is made of all but instances
  plan = plan_of(options, rig);
  EXPECT_TRUE(plan.depth && plan.labels && plan.normals && plan.motion && plan.instances);
  options.cameras = {"rear"};
  EXPECT_THAT(error_of([&] { plan_of(options, rig); }), HasSubstr("no camera named 'rear'"));
}

TEST(FormatsTest, FlowsWriterMakesFlosFilesToo) {
  const test::TestFolder folder;
  const RecordingNotes notes;
  const SceneIndex scene;
  RecordOptions options;
  options.formats = {"flow", "flo"};
  const WriterInputs inputs{folder / "flo", notes, scene, options};
  EXPECT_EQ(format_named("flo").write(inputs), nullptr);
  options.formats = {"flo"};
  EXPECT_NE(format_named("flo").write(inputs), nullptr);
}

}  // namespace
}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>

#include "sim/config_files.h"
#include "sim/render/factory/make_render_engine.h"
#include "sim/scene/scene_naming.h"
#include "sim/world/world.h"
#include "tests/support/foreign_plant.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

class ForeignVinesTest : public testing::Test {
 protected:
  /// One plant of that file, in the middle of a row along x, and what its world says more.
  Scene scene(const std::filesystem::path& file, const std::string& import) const {
    const auto world = folder_.write(
        "world.yaml", fmt::format("ground_size: 8\nrows: [{{start: [-0.5, 2], end: [0.5, 2]}}]\n"
                                  "trellis: {{wires: [], post_height: 0.3}}\n"
                                  "vines: {{meshes: [{}]{}}}\n",
                                  file.filename().string(), import));
    return build_scene(load_world(world), 1, folder_ / "cache");
  }
  /// Pixels of each label, seen from 2 m before the plant at half of its height.
  static std::map<Label, int> pixels(const Scene& scene) {
    RenderRequest request;
    request.labels = true;
    const auto engine = make_render_engine(scene, RendererConfig{});
    const cv::Mat labels =
        engine->render(test::small_camera(), test::look_at({0, 0, 0.8}, {0, 2, 0.8}), request)
            .labels;
    std::map<Label, int> count;
    for (int y = 0; y < labels.rows; ++y) {
      for (int x = 0; x < labels.cols; ++x) ++count[static_cast<Label>(labels.at<uchar>(y, x))];
    }
    return count;
  }

  test::TestFolder folder_;
};

// At 2 m a metre is 131.6 px: the trunk covers 0.1 m x 1 m, 1733 px, the foliage 0.8 m x 0.6 m,
// 8317 px, and a plant is drawn up to 6 % larger (12 % of its area); half a pixel along its edges.
TEST_F(ForeignVinesTest, PartsKeepTheirLabelsInTheImage) {
  for (const auto& file : {write_glb_plant(folder_), write_obj_plant(folder_)}) {
    const Scene parts = scene(file, ", mesh_import: {labels: {Bark: trunk, Foliage: leaf}}");
    std::map<Label, int> found = pixels(parts);
    EXPECT_NEAR(found[Label::kTrunk], 1733 * 1.06, 1733 * 0.06 + 145) << file;
    EXPECT_NEAR(found[Label::kLeaf], 8317 * 1.06, 8317 * 0.06 + 185) << file;
    found = pixels(scene(file, ""));
    EXPECT_EQ(found.count(Label::kTrunk), 0u);
    EXPECT_GT(found[Label::kLeaf], 9900);
  }
}

TEST_F(ForeignVinesTest, APlantIsAVineWhateverTheLabelsOfItsParts) {
  const Scene posts = scene(write_glb_plant(folder_), ", mesh_import: {default_label: post}");
  EXPECT_EQ(instance_name(posts, 256).thing, Thing::kVine);
}

}  // namespace
}  // namespace vinebench::sim

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <set>

#include "sim/assets/asset_file.h"
#include "sim/plants/grapevine.h"
#include "sim/vineyard/props.h"
#include "sim/world/occluder_pose.h"
#include "sim/world/tag_family.h"
#include "sim/world/world.h"
#include "sim/world/world_layout.h"
#include "tests/support/shared_plants.h"
#include "tests/support/tag_reading.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using testing::HasSubstr;

WorldConfig small_world() {
  WorldConfig world;
  world.ground_size = 10;
  world.rows.push_back({{0, -0.4}, {3, -0.4}});
  world.rows.push_back({{1, 1}, {1, 3}});
  world.vines.templates = 2;
  world.tags.resize(1);
  world.tags[0].id = 7;
  world.tags[0].position = {0.06, -0.36, 0.5};
  world.tags[0].facing_deg = 90;
  world.occluders.resize(1);
  world.occluders[0].size = {0.5, 1.25, 0.8};
  world.occluders[0].position = {5, 0.3};
  world.occluders[0].yaw_deg = 30;
  return world;
}

/// Instances of models that have a part with that label.
std::vector<Instance> instances_of(const Scene& scene, Label label) {
  std::vector<Instance> found;
  for (const Instance& instance : scene.instances) {
    const Model& model = scene.models.at(static_cast<std::size_t>(instance.model));
    for (const Primitive& primitive : model.levels.at(0).primitives) {
      if (scene.materials.at(static_cast<std::size_t>(primitive.material)).label == label) {
        found.push_back(instance);
        break;
      }
    }
  }
  return found;
}

class SceneTest : public testing::Test {
 protected:
  test::TestFolder folder_;
};

TEST_F(SceneTest, VinesAndPostsStandWhereTheWorldHasThem) {
  const WorldConfig world = small_world();
  const Scene scene = build_scene(world, 1, test::shared_plants(), false);
  const std::vector<Eigen::Vector2d> vines = lay_out(world).vine_feet(),
                                     posts = lay_out(world).post_feet();
  const std::vector<Instance> plants = instances_of(scene, Label::kBunch);
  ASSERT_EQ(plants.size(), vines.size());
  for (std::size_t i = 0; i < vines.size(); ++i) {
    const Pose& pose = plants[i].T_world_model;
    EXPECT_EQ(plants[i].id, static_cast<int>(i));
    EXPECT_LT((pose.translation - Eigen::Vector3d(vines[i].x(), vines[i].y(), 0)).norm(), 1e-12);
    // The row's direction or its opposite: x for the first three, y for the others.
    const Eigen::Vector3d along = pose.rotation * Eigen::Vector3d::UnitX();
    EXPECT_NEAR(std::abs(i < 3 ? along.x() : along.y()), 1, 1e-9);
    EXPECT_GE(plants[i].scale, 1.0f);
    EXPECT_LE(plants[i].scale, static_cast<float>(kLargestPlantScale));
  }
  const std::vector<Instance> stakes = instances_of(scene, Label::kPost);
  ASSERT_EQ(stakes.size(), posts.size());
  for (std::size_t i = 0; i < posts.size(); ++i) {
    EXPECT_LT((stakes[i].T_world_model.translation.head<2>() - posts[i]).norm(), 1e-12);
  }
}

TEST_F(SceneTest, TheTagsPrintLiesInItsPlaneWithItsBlackSquareToSize) {
  const WorldConfig world = small_world();
  const Scene scene = build_scene(world, 1, test::shared_plants(), false);
  const std::vector<Instance> tags = instances_of(scene, Label::kTag);
  ASSERT_EQ(tags.size(), 1u);
  const Primitive& print =
      scene.models.at(static_cast<std::size_t>(tags[0].model)).levels.at(0).primitives.at(0);
  ASSERT_EQ(print.vertices.size(), 4u);
  // tag36h11: 8 modules across the black square, one of white round it and one of board: 12.
  const double half = 0.161 / 2 * 12 / 8;
  const Pose T_world_tag = tag_pose(lay_out(world).tags[0]);
  for (const Vertex& v : print.vertices) {
    const Eigen::Vector3d p_world = tags[0].T_world_model * v.position.cast<double>();
    // u increases to the right and v down the print, like x and y of the tag.
    const Eigen::Vector3d expected =
        T_world_tag * Eigen::Vector3d((2 * v.uv.x() - 1) * half, (2 * v.uv.y() - 1) * half, 0);
    EXPECT_LT((p_world - expected).norm(), 1e-7);
    EXPECT_NEAR(p_world.y(), -0.36, 1e-7);
  }
  const Eigen::Vector3f normal = print.vertices[0].normal;
  EXPECT_GT((tags[0].T_world_model.rotation * normal.cast<double>()).y(), 0.999);
}

TEST_F(SceneTest, TheBoxStandsAtItsPose) {
  const WorldConfig world = small_world();
  const Scene scene = build_scene(world, 1, test::shared_plants(), false);
  const std::vector<Instance> boxes = instances_of(scene, Label::kBox);
  ASSERT_EQ(boxes.size(), 1u);
  const Pose foot = occluder_pose(world.occluders[0], lay_out(world).terrain);
  Eigen::AlignedBox3d own;
  for (const Primitive& primitive :
       scene.models.at(static_cast<std::size_t>(boxes[0].model)).levels.at(0).primitives) {
    for (const Vertex& v : primitive.vertices) {
      own.extend(foot.inverse() * (boxes[0].T_world_model * v.position.cast<double>()));
    }
  }
  EXPECT_LT((own.max() - Eigen::Vector3d(0.25, 0.625, 0.8)).norm(), 1e-6);
  EXPECT_LT((own.min() - Eigen::Vector3d(-0.25, -0.625, 0)).norm(), 1e-6);
}

TEST_F(SceneTest, WiresRunAlongTheRowsAtTheirHeights) {
  const WorldConfig world = small_world();
  const Scene scene = build_scene(world, 1, test::shared_plants(), false);
  // Four wires over the spans between 3 posts of the first row (0, 2, 3) and 2 of the second.
  ASSERT_EQ(scene.wires.size(), 4u * 3u);
  for (const Wire& wire : scene.wires) {
    EXPECT_EQ(wire.from.z(), wire.to.z());
    EXPECT_TRUE(std::ranges::any_of(world.trellis.wires, [&](double height) {
      return std::abs(height - wire.from.z()) < 1e-6;
    }));
  }
}

TEST_F(SceneTest, TheSunStandsWhereTheWorldSays) {
  WorldConfig world = small_world();
  world.sun.azimuth_deg = 90;  // east
  world.sun.elevation_deg = 30;
  const Scene scene = build_scene(world, 1, test::shared_plants(), false);
  const Eigen::Vector3f expected(std::sqrt(0.75f), 0, 0.5f);
  EXPECT_LT((scene.light.towards_sun - expected).norm(), 1e-6f);
}

TEST_F(SceneTest, SomePlacesAreEmptyOrHaveAYoungVine) {
  WorldConfig world = small_world();
  world.rows = {{{0, 0}, {100, 0}}};
  world.ground_size = 4;  // no grass is needed
  world.vines.missing = 0.2;
  world.vines.young = 0.3;
  const Scene scene = build_scene(world, 1, test::shared_plants(), false);
  // Adult vines have bunches, young ones do not; all have a trunk.
  const std::size_t grown = instances_of(scene, Label::kBunch).size();
  const std::vector<Instance> all = instances_of(scene, Label::kTrunk);
  // Of 100 places; the standard deviation of a share of 0.2 to 0.5 is at most 5.
  EXPECT_NEAR(static_cast<double>(all.size()), 80, 15);
  EXPECT_NEAR(static_cast<double>(grown), 50, 15);
  std::set<int> ids;
  for (const Instance& plant : all) {
    ids.insert(plant.id);
    EXPECT_NEAR(plant.T_world_model.translation.x(), plant.id + 0.5, 1e-9) << "the place's number";
  }
  EXPECT_EQ(ids.size(), all.size());
}

TEST_F(SceneTest, WoodLedToOneSidePointsTheSameWayAllAlongTheRow) {
  WorldConfig world = small_world();
  world.vines.training = Training::kSingleGuyot;
  for (const Instance& plant :
       instances_of(build_scene(world, 1, test::shared_plants(), false), Label::kBunch)) {
    const Eigen::Vector3d along = plant.T_world_model.rotation * Eigen::Vector3d::UnitX();
    EXPECT_NEAR(plant.id < 3 ? along.x() : along.y(), 1, 1e-9);
  }
}

std::string glb_of_model(const Scene& scene, std::size_t index) {
  const Asset asset{{}, scene.materials, scene.models.at(index)};  // images are compared separately
  return to_glb(asset);
}

void expect_same(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.models.size(), b.models.size());
  ASSERT_EQ(a.textures.size(), b.textures.size());
  ASSERT_EQ(a.materials.size(), b.materials.size());
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.textures.size(); ++i) {
    EXPECT_EQ(a.textures[i].name, b.textures[i].name);
    EXPECT_EQ(cv::norm(a.textures[i].rgba, b.textures[i].rgba, cv::NORM_INF), 0);
  }
  for (std::size_t i = 0; i < a.models.size(); ++i) {
    EXPECT_TRUE(glb_of_model(a, i) == glb_of_model(b, i)) << a.models[i].name;
  }
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].model, b.instances[i].model);
    EXPECT_EQ(a.instances[i].T_world_model.matrix(), b.instances[i].T_world_model.matrix());
    EXPECT_EQ(a.instances[i].scale, b.instances[i].scale);
  }
}

std::vector<std::filesystem::path> plants_in(const std::filesystem::path& cache) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(cache)) {
    if (entry.path().extension() == ".glb") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

TEST_F(SceneTest, TheSecondBuildReadsTheKeptPlantsAndIsTheSame) {
  const WorldConfig world = small_world();
  const Scene first = build_scene(world, 1, folder_ / "cache");
  const std::vector<std::filesystem::path> plants = plants_in(folder_ / "cache");
  ASSERT_EQ(plants.size(), 2u);
  expect_same(first, build_scene(world, 1, folder_ / "cache"));
  // If the files were not read, replacing the first plant's file would have no effect.
  write_cached({folder_ / "cache"}, plants[0].filename(), read_file(plants[1]));
  const Scene doubled = build_scene(world, 1, folder_ / "cache");
  EXPECT_EQ(glb_of_model(doubled, 0), glb_of_model(doubled, 1));
  EXPECT_NE(glb_of_model(first, 0), glb_of_model(first, 1));
}

TEST_F(SceneTest, AnotherSeedOrShapeIsKeptBesideTheFirst) {
  WorldConfig world = small_world();
  build_scene(world, 1, folder_ / "cache");
  build_scene(world, 2, folder_ / "cache");
  EXPECT_EQ(plants_in(folder_ / "cache").size(), 4u);
  world.vines.canopy_top = 1.4;
  build_scene(world, 2, folder_ / "cache");
  EXPECT_EQ(plants_in(folder_ / "cache").size(), 6u);
}

TEST_F(SceneTest, ADamagedPlantIsGrownAnew) {
  const WorldConfig world = small_world();
  const Scene first = build_scene(world, 1, folder_ / "cache");
  const std::filesystem::path plant = plants_in(folder_ / "cache").at(0);
  const std::string whole = read_file(plant);
  write_file_atomically(plant, whole.substr(0, whole.size() / 2));
  expect_same(first, build_scene(world, 1, folder_ / "cache"));
  EXPECT_TRUE(read_file(plant) == whole);
}

TEST_F(SceneTest, IsTheSameWithoutACache) {
  const Scene first = build_scene(small_world(), 1, test::shared_plants());
  CacheFolder none{folder_.write("file", "not a folder")};
  std::string notice;
  none.notice = [&](const std::string& text) { notice = text; };
  expect_same(first, build_scene(small_world(), 1, none));
  EXPECT_THAT(notice, HasSubstr(none.folder.string()));
}

TEST_F(SceneTest, UnpaintedItHasTheSameThingsInTheSamePlaces) {
  const Scene painted = build_scene(small_world(), 1, test::shared_plants());
  const Scene listed = build_scene(small_world(), 1, test::shared_plants(), false);
  ASSERT_EQ(listed.instances.size(), painted.instances.size());
  for (std::size_t i = 0; i < painted.instances.size(); ++i) {
    const Instance &a = listed.instances[i], &b = painted.instances[i];
    EXPECT_EQ(a.model, b.model);
    EXPECT_EQ(a.T_world_model.matrix(), b.T_world_model.matrix());
  }
  // By name: a fallen leaf's painted texture is a plant's own, its grey texel is not.
  const auto names = [](const Scene& scene) {
    std::set<std::string> all;
    for (const Texture& texture : scene.textures) all.insert(texture.name);
    return all;
  };
  EXPECT_EQ(names(listed), names(painted));
  const auto texels = [](const Scene& scene) {
    double sum = 0;
    for (const Texture& texture : scene.textures) sum += static_cast<double>(texture.rgba.total());
    return sum;
  };
  // The ground alone has 2048 x 2048 of them.
  EXPECT_GT(texels(painted) - texels(listed), 2048.0 * 2048);
}

TEST_F(SceneTest, AWorldsOwnMeshesStandInPlaceOfGrownPlants) {
  WorldConfig world = small_world();
  const std::string obj = "v 0 0 0\nv 0.5 0 0\nv 0 0 1.5\nf 1 2 3\n";
  const std::string stl =
      "solid vine\nfacet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 0.25 0 0\n"
      "vertex 0 0 1.25\nendloop\nendfacet\nendsolid vine\n";
  world.vines.meshes = {folder_.write("a.obj", obj), folder_.write("b.stl", stl)};
  // No plant is generated: the cache is not used.
  const Scene scene = build_scene(world, 1, folder_ / "cache");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cache"));
  EXPECT_EQ(scene.models.at(0).bounds.max(), Eigen::Vector3f(0.5f, 0, 1.5f));
  EXPECT_EQ(scene.models.at(1).bounds.max(), Eigen::Vector3f(0.25f, 0, 1.25f));
  std::array<int, 2> stands{};
  const std::vector<Eigen::Vector2d> vines = lay_out(world).vine_feet();
  for (std::size_t i = 0; i < vines.size(); ++i) {
    const Instance& plant = scene.instances.at(i);
    ASSERT_LT(plant.model, 2);
    ++stands.at(static_cast<std::size_t>(plant.model));
    EXPECT_LT((plant.T_world_model.translation.head<2>() - vines[i]).norm(), 1e-12);
  }
  EXPECT_EQ(stands[0] + stands[1], static_cast<int>(vines.size()));
}

TEST_F(SceneTest, AMeshThatCannotBeLoadedIsNamed) {
  WorldConfig world = small_world();
  world.vines.meshes = {folder_ / "gone.obj"};
  EXPECT_THAT(error_of([&] { build_scene(world, 1, folder_ / "cache"); }), HasSubstr("gone.obj"));
}

class TagTextureTest : public testing::TestWithParam<const char*> {};

TEST_P(TagTextureTest, ReadsAsItsIdWithItsSquareWhereTheBoardScaleHasIt) {
  const TagFamily family(GetParam());
  for (const int id : {0, 5, family.size() - 1}) {
    const Texture texture = tag_texture(GetParam(), id);
    EXPECT_FALSE(texture.repeat);
    cv::Mat grey, framed;
    cv::cvtColor(texture.rgba, grey, cv::COLOR_RGBA2GRAY);
    constexpr int kFrame = 40;  // px of wall round the board
    cv::copyMakeBorder(grey, framed, kFrame, kFrame, kFrame, kFrame, cv::BORDER_CONSTANT, 120);
    const std::vector<test::ReadTag> tags = test::read_tags(framed, family);
    ASSERT_EQ(tags.size(), 1u);
    EXPECT_EQ(tags[0].id, id);
    EXPECT_EQ(tags[0].wrong_bits, 0);
    // The square's corners, in the middle of the board; texel borders lie half a pixel before the
    // texel's centre.
    const double middle = kFrame + grey.cols / 2.0 - 0.5;
    const auto corners = test::tag_corners(grey.cols / tag_board_scale(GetParam()));
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector2d expected = corners[i].head<2>().array() + middle;
      EXPECT_LT((tags[0].corners[i] - expected).norm(), 0.5) << id << " corner " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, TagTextureTest,
                         testing::Values("tag36h11", "tag25h9", "tagStandard41h12"));

TEST(TagPrintTest, ItsBlackSquareHasItsShareOfTheTexture) {
  // 8 of 12 modules; inside it, a ring of one module of black round 6 x 6 of data.
  const Texture texture = tag_texture("tag36h11", 0);
  const int module = texture.rgba.cols / 12;
  ASSERT_EQ(texture.rgba.cols, 12 * module);
  const auto at = [&](double x, double y) {
    return texture.rgba.at<cv::Vec4b>(static_cast<int>(y * module),
                                      static_cast<int>(x * module))[0];
  };
  for (double along = 2.1; along < 10; along += 0.2) {
    EXPECT_LT(at(along, 2.02), 40);
    EXPECT_LT(at(2.02, along), 40);
    EXPECT_LT(at(along, 9.98), 40);
    EXPECT_GT(at(along, 1.98), 200);
    EXPECT_GT(at(10.02, along), 200);
  }
}

}  // namespace
}  // namespace vinebench::sim

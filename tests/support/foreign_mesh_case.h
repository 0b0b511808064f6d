// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/assets/foreign/foreign_mesh.h"
#include "tests/support/foreign_plant.h"
#include "tests/support/warnings.h"

namespace vinebench::sim {

/// Meshes of other tools, loaded from a folder of the test's own.
class ForeignMeshTest : public testing::Test {
 protected:
  Asset load(const std::filesystem::path& file, const MeshImport& import = {},
             std::optional<Label> label = std::nullopt) const {
    return load_foreign_meshes({file}, import, label, "vines.mesh_import").at(0);
  }
  /// The one warning of a file, which names it; empty without one.
  std::string warning_of(const std::filesystem::path& file) const {
    const test::Warnings warnings;
    load(file);
    if (warnings.all.empty()) return "";
    EXPECT_EQ(warnings.all.size(), 1u);
    EXPECT_THAT(warnings.all[0], testing::StartsWith(file.string() + ": "));
    return warnings.all[0];
  }
  /// Every format with names, the same plant each.
  std::vector<std::filesystem::path> named_plants() const {
    return {write_obj_plant(folder_), write_dae_plant(folder_), write_gltf_plant(folder_),
            write_glb_plant(folder_)};
  }
  static const std::vector<Primitive>& primitives(const Asset& asset) {
    return asset.model.levels.at(0).primitives;
  }
  static const Material& material(const Asset& asset, const Primitive& primitive) {
    return asset.materials.at(static_cast<std::size_t>(primitive.material));
  }
  /// The label at each height of the plant's two parts: below 1 m and above.
  static std::pair<std::set<Label>, std::set<Label>> labels(const Asset& asset) {
    std::pair<std::set<Label>, std::set<Label>> found;
    for (const Primitive& primitive : primitives(asset)) {
      for (const Vertex& vertex : primitive.vertices) {
        const Label label = material(asset, primitive).label;
        if (vertex.position.z() < 0.5f) found.first.insert(label);
        if (vertex.position.z() > 1.5f) found.second.insert(label);
      }
    }
    return found;
  }
  static std::size_t vertices(const Asset& asset) {
    std::size_t count = 0;
    for (const Primitive& primitive : primitives(asset)) count += primitive.vertices.size();
    return count;
  }
  static void expect_box(const Asset& asset, const Eigen::Vector3f& min,
                         const Eigen::Vector3f& max) {
    EXPECT_LT((asset.model.bounds.min() - min).norm(), 1e-5f) << asset.model.bounds.min();
    EXPECT_LT((asset.model.bounds.max() - max).norm(), 1e-5f) << asset.model.bounds.max();
  }

  test::TestFolder folder_;
};

}  // namespace vinebench::sim

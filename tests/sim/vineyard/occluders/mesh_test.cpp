// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/vineyard/occluders/occluder_shape.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A wedge of 1 x 1 x 1 m with its corner at (5, 6, 7); its slope, x + z = 13, faces +x and up.
constexpr const char* kWedge =
    "v 5 6 7\nv 6 6 7\nv 6 7 7\nv 5 7 7\nv 5 6 8\nv 5 7 8\n"
    "f 2 3 6 5\nf 1 5 6 4\nf 1 2 5\nf 4 6 3\nf 4 3 2 1\n";

class MeshOccluderTest : public testing::Test {
 protected:
  Occluder occluder(const std::string& obj, const Eigen::Vector3d& size) const {
    Occluder occluder;
    occluder.shape = Occluder::Shape::kMesh;
    occluder.mesh = folder_.write("thing.obj", obj);
    occluder.size = size;
    return occluder;
  }
  test::TestFolder folder_;
};

TEST_F(MeshOccluderTest, FillsItsSizeAboveTheMiddleOfItsFoot) {
  OccluderModel model = mesh_model(occluder(kWedge, {2, 0.5, 3}), 1);
  model.asset.update_bounds();
  const Eigen::AlignedBox3f& bounds = model.asset.model.bounds;
  EXPECT_LT((bounds.min() - Eigen::Vector3f(-1, -0.25f, 0)).norm(), 1e-6f);
  EXPECT_LT((bounds.max() - Eigen::Vector3f(1, 0.25f, 3)).norm(), 1e-6f);
  EXPECT_EQ(model.origin, 0);
  EXPECT_EQ(model.scale, 1);
}

// Twice as long, the slope is x / 2 + z = constant: its normal is (1, 0, 2) / sqrt(5).
TEST_F(MeshOccluderTest, NormalsStaySquareToTheScaledFaces) {
  const OccluderModel model = mesh_model(occluder(kWedge, {2, 1, 1}), 1);
  const Eigen::Vector3f expected = Eigen::Vector3f(1, 0, 2).normalized();
  int on_slope = 0;
  for (const Primitive& primitive : model.asset.model.levels.at(0).primitives) {
    for (const Vertex& vertex : primitive.vertices) {
      EXPECT_NEAR(vertex.normal.norm(), 1, 1e-5);
      if (vertex.normal.x() < 0.1f || vertex.normal.z() < 0.1f) continue;
      EXPECT_LT((vertex.normal - expected).norm(), 1e-5f) << vertex.normal.transpose();
      ++on_slope;
    }
  }
  EXPECT_GE(on_slope, 4);
}

TEST_F(MeshOccluderTest, HasTheLabelOfItsClass) {
  Occluder person = occluder(kWedge, {1, 1, 1});
  for (const Material& material : mesh_model(person, 1).asset.materials) {
    EXPECT_EQ(material.label, Label::kOccluder);
  }
  person.kind = OccluderClass::kPerson;
  const OccluderModel model = mesh_model(person, 1);
  ASSERT_FALSE(model.asset.materials.empty());
  for (const Material& material : model.asset.materials) EXPECT_EQ(material.label, Label::kPerson);
}

TEST_F(MeshOccluderTest, IsTurnedBeforeItIsScaledToItsSize) {
  Occluder turned = occluder(kWedge, {2, 1, 3});
  turned.mesh_import = MeshImport{};
  turned.mesh_import->yaw_deg = 90;  // the slope, which faced +x and up, now faces +y and up
  OccluderModel model = mesh_model(turned, 1);
  model.asset.update_bounds();
  EXPECT_LT((model.asset.model.bounds.sizes() - Eigen::Vector3f(2, 1, 3)).norm(), 1e-5f);
  int on_slope = 0;
  for (const Vertex& vertex : model.asset.model.levels.at(0).primitives.at(0).vertices) {
    on_slope += vertex.normal.y() > 0.1f && vertex.normal.z() > 0.1f;
    EXPECT_FALSE(vertex.normal.x() > 0.1f && vertex.normal.z() > 0.1f);
  }
  EXPECT_GE(on_slope, 4);
}

TEST_F(MeshOccluderTest, PartsHaveTheirLabelsAndTheWholeIsOfItsClass) {
  Occluder barrow = occluder(std::string("usemtl Steel\n") + kWedge, {1, 1, 1});
  barrow.kind = OccluderClass::kCarton;
  barrow.mesh_import = MeshImport{};
  barrow.mesh_import->labels = {{"Steel", Label::kPost}};
  const OccluderModel model = mesh_model(barrow, 1);
  for (const Material& material : model.asset.materials) EXPECT_EQ(material.label, Label::kPost);
  EXPECT_EQ(model.asset.model.thing, Thing::kBox);
  barrow.mesh_import->labels = {{"Stel", Label::kPost}};
  EXPECT_THAT(test::error_of([&] { mesh_model(barrow, 1); }),
              AllOf(HasSubstr("occluder 'carton': mesh_import.labels.Stel"),
                    HasSubstr("did you mean 'Steel'?")));
}

TEST_F(MeshOccluderTest, AFlatMeshIsAnErrorThatNamesItsFile) {
  const Occluder flat = occluder("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {1, 1, 1});
  EXPECT_THAT(test::error_of([&] { mesh_model(flat, 1); }),
              AllOf(HasSubstr("thing.obj"), HasSubstr("a length, a width and a height")));
}

}  // namespace
}  // namespace vinebench::sim

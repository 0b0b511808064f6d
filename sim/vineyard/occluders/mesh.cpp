// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/error.h"
#include "sim/assets/foreign/foreign_mesh.h"
#include "sim/scene/scene_naming.h"
#include "sim/vineyard/occluders/occluder_shape.h"

namespace vinebench::sim {
namespace {

/// Moves the mesh onto its foot and scales it to `size`, axis by axis.
void fit(Asset& asset, const Eigen::Vector3f& size) {
  const Eigen::AlignedBox3f box = asset.model.bounds;
  const Eigen::Vector3f scale = size.cwiseQuotient(box.sizes());
  const Eigen::Vector3f foot(box.center().x(), box.center().y(), box.min().z());
  for (LevelOfDetail& level : asset.model.levels) {
    for (Primitive& primitive : level.primitives) {
      for (Vertex& vertex : primitive.vertices) {
        vertex.position = (vertex.position - foot).cwiseProduct(scale);
        vertex.normal = vertex.normal.cwiseQuotient(scale).normalized();
      }
    }
  }
}

}  // namespace

OccluderModel mesh_model(const Occluder& occluder, std::uint64_t) {
  const Label label = label_of(class_of(occluder));
  const std::string key = fmt::format("occluder '{}': mesh_import", name_of(occluder));
  OccluderModel model{
      .asset = std::move(load_foreign_meshes(
          {*occluder.mesh}, occluder.mesh_import.value_or(MeshImport{}), label, key)[0])};
  model.asset.update_bounds();
  if (model.asset.model.bounds.isEmpty() || model.asset.model.bounds.sizes().minCoeff() <= 0) {
    fail("{}: expected a mesh with a length, a width and a height", occluder.mesh->string());
  }
  fit(model.asset, size_of(occluder).cast<float>());
  model.asset.model.thing = thing_of(label);  // whatever the labels of its parts
  return model;
}

}  // namespace vinebench::sim

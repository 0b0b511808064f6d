// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "core/config/config_field.h"
#include "core/truth/labels.h"
#include "sim/assets/imported_mesh.h"

namespace vinebench::sim {

/// How a mesh of another tool is placed and labelled. docs/foreign-meshes.md has examples.
struct MeshImport {
  double scale = 1;                       ///< m of the world in a unit of the file
  UpAxis up_axis = UpAxis::kFile;         ///< of the file's coordinates
  double yaw_deg = 0;                     ///< to the left, about the vertical
  std::map<std::string, Label> labels{};  ///< by the name of a material or part
  std::optional<Label> default_label{};   ///< of all that `labels` does not name
  template <class Archive>
  void serialize(Archive& archive) {
    archive("scale", scale, Range::between(1e-6, 1e6));
    archive("up_axis", up_axis);
    archive("yaw_deg", yaw_deg, Range::between(-360, 360));
    archive("labels", labels);
    archive("default_label", default_label);
    for (const auto& [name, label] : labels) {
      archive.require(label != Label::kSky, "labels", "expected a label other than sky");
    }
    archive.require(default_label != Label::kSky, "default_label",
                    "expected a label other than sky");
  }
};

}  // namespace vinebench::sim

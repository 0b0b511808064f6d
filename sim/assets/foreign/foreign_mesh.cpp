// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/foreign/foreign_mesh.h"

#include <algorithm>
#include <set>

#include "core/geometry/angle.h"
#include "core/util/error.h"
#include "core/util/suggestion.h"
#include "core/util/warning.h"
#include "sim/assets/asset_file.h"

namespace vinebench::sim {
namespace {

/// Rows are the file's axes that become x (right), y (away from the viewer) and z (up).
Eigen::Matrix3f z_up_from(UpAxis axis) {
  Eigen::Matrix3f turn = Eigen::Matrix3f::Identity();
  if (axis == UpAxis::kX) turn << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  if (axis == UpAxis::kY) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return turn;
}

/// From what the importer made of the file's axes to those that are wanted.
Eigen::Matrix3f turn_of(const ImportedMesh& mesh, const MeshImport& import) {
  const auto yaw = static_cast<float>(import.yaw_deg * kRadiansPerDegree);
  Eigen::Matrix3f turn = Eigen::AngleAxisf(yaw, Eigen::Vector3f::UnitZ()).toRotationMatrix();
  if (import.up_axis != UpAxis::kFile) {
    turn = (turn * z_up_from(import.up_axis) * z_up_from(mesh.up_axis).transpose()).eval();
  }
  return turn;
}

void place(ImportedMesh& mesh, const MeshImport& import, const std::string& file) {
  const Eigen::Matrix3f turn = turn_of(mesh, import);
  const auto scale = static_cast<float>(import.scale);
  if (scale == 1 && turn == Eigen::Matrix3f::Identity()) return;
  for (LevelOfDetail& level : mesh.asset.model.levels) {
    for (Primitive& primitive : level.primitives) {
      for (Vertex& vertex : primitive.vertices) {
        vertex.position = (scale * (turn * vertex.position)).eval();
        vertex.normal = (turn * vertex.normal).eval();
      }
    }
  }
  mesh.asset.update_bounds();
  const Eigen::AlignedBox3f& bounds = mesh.asset.model.bounds;
  if (bounds.isEmpty() ||
      bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).maxCoeff() <= kFarthestVertex) {
    return;
  }
  fail("{}: scaled by {} it reaches more than {} m from the origin", file, import.scale,
       kFarthestVertex);
}

/// Gives each primitive a material of its label.
class Labeller {
 public:
  Labeller(ImportedMesh& mesh, const MeshImport& import, std::optional<Label> label)
      : mesh_(mesh), import_(import), label_(label) {}

  void run() {
    std::size_t next = 0;
    for (LevelOfDetail& level : mesh_.asset.model.levels) {
      for (Primitive& primitive : level.primitives) {
        const int part = mesh_.part_of.at(next++);
        const Label label = label_of(primitive.material, part);
        if (label == Label::kBunch) number(primitive, part);
        primitive.material = material_of(primitive.material, label);
      }
    }
    mesh_.asset.materials = std::move(materials_);
  }

 private:
  Label label_of(int material, int part) const {
    const Material& of = mesh_.asset.materials.at(static_cast<std::size_t>(material));
    if (const auto found = import_.labels.find(of.name); found != import_.labels.end()) {
      return found->second;
    }
    while (part >= 0) {
      const ImportedMesh::Part& at = mesh_.parts.at(static_cast<std::size_t>(part));
      const auto found = import_.labels.find(at.name);
      if (found != import_.labels.end()) return found->second;
      part = at.around;
    }
    if (label_) return import_.default_label.value_or(*label_);
    return mesh_.labelled.contains(material) ? of.label : import_.default_label.value_or(of.label);
  }

  /// A bunch of our own plants is numbered in its file.
  void number(Primitive& primitive, int part) {
    constexpr std::size_t kMost = 255;
    const auto [known, fresh] = bunches_.try_emplace(part, bunches_.size() + 1);
    if (known->second > kMost) {
      mesh_.notes.add(fmt::format("more than {} bunches: the others have no number", kMost));
      return;
    }
    for (Vertex& vertex : primitive.vertices) {
      if (vertex.part == 0) vertex.part = static_cast<std::uint8_t>(known->second);
    }
  }

  int material_of(int material, Label label) {
    const auto [known, fresh] = known_.try_emplace({material, label}, materials_.size());
    if (fresh) {
      materials_.push_back(mesh_.asset.materials.at(static_cast<std::size_t>(material)));
      materials_.back().label = label;
    }
    return static_cast<int>(known->second);
  }

  ImportedMesh& mesh_;
  const MeshImport& import_;
  std::optional<Label> label_;
  std::map<int, std::size_t> bunches_;  ///< number of each part
  std::map<std::pair<int, Label>, std::size_t> known_;
  std::vector<Material> materials_;
};

/// Joins the primitives of each material: a plant may have thousands of parts.
void join(LevelOfDetail& level) {
  std::vector<Primitive> joined;
  std::map<int, std::size_t> known;
  for (Primitive& primitive : level.primitives) {
    const auto [place, fresh] = known.try_emplace(primitive.material, joined.size());
    if (fresh) {
      joined.push_back(std::move(primitive));
      continue;
    }
    Primitive& to = joined[place->second];
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    to.vertices.insert(to.vertices.end(), primitive.vertices.begin(), primitive.vertices.end());
    for (const std::uint32_t index : primitive.indices) to.indices.push_back(first + index);
    primitive = {};
  }
  level.primitives = std::move(joined);
}

/// What the labels of an import may name.
std::set<std::string> names_of(const ImportedMesh& mesh) {
  std::set<std::string> names;
  for (const Material& material : mesh.asset.materials) names.insert(material.name);
  for (const ImportedMesh::Part& part : mesh.parts) names.insert(part.name);
  names.erase("");
  return names;
}

std::string listed(const std::set<std::string>& names) {
  constexpr std::size_t kMost = 20;
  std::string text;
  std::size_t count = 0;
  for (const std::string& name : names) {
    if (++count > kMost) return text + fmt::format(" and {} more", names.size() - kMost);
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

void check_names(const MeshImport& import, const std::set<std::string>& names,
                 const std::vector<std::filesystem::path>& files, const std::string& key) {
  for (const auto& [name, label] : import.labels) {
    if (names.contains(name)) continue;
    fail("{}.labels.{}: {}{} has no material or part of that name{}; expected one of: {}", key,
         name, files.front().string(),
         files.size() > 1 ? fmt::format(" (and {} more)", files.size() - 1) : "",
         did_you_mean(name, {names.begin(), names.end()}), listed(names));
  }
}

/// Empty where all of the file is drawn.
std::string warning_of(const ImportedMesh& mesh, const std::string& file) {
  constexpr std::size_t kMost = 12;
  const std::vector<std::string>& notes = mesh.notes.all();
  std::string text;
  for (std::size_t i = 0; i < notes.size() && i < kMost; ++i) {
    text += (i > 0 ? "; " : "") + notes[i];
  }
  if (notes.size() > kMost) text += fmt::format("; and {} more", notes.size() - kMost);
  return text.empty() ? "" : file + ": " + text;
}

}  // namespace

std::vector<Asset> load_foreign_meshes(const std::vector<std::filesystem::path>& files,
                                       const MeshImport& import, std::optional<Label> label,
                                       const std::string& key) {
  std::vector<Asset> assets;
  std::set<std::string> names;
  std::vector<std::string> warnings;
  for (const std::filesystem::path& file : files) {
    ImportedMesh mesh = load_mesh(file, Strictness::kLenient);
    names.merge(names_of(mesh));
    place(mesh, import, file.string());
    Labeller(mesh, import, label).run();
    for (LevelOfDetail& level : mesh.asset.model.levels) join(level);
    warnings.push_back(warning_of(mesh, file.string()));
    assets.push_back(std::move(mesh.asset));
  }
  check_names(import, names, files, key);
  for (const std::string& warning : warnings) {
    if (!warning.empty()) warn(warning);
  }
  return assets;
}

}  // namespace vinebench::sim

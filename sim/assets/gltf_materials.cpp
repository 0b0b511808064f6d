// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/gltf_materials.h"

#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "sim/assets/gltf_accessor.h"

namespace vinebench::sim {
namespace {

using tinygltf::Value;

/// What the numbers stood for that files held before they held names.
constexpr std::array<const char*, 13> kNumberedLabels{"sky",  "ground", "grass", "trunk", "cane",
                                                      "leaf", "bunch",  "post",  "wire",  "tag",
                                                      "box",  "rover",  "person"};

class GltfMaterials {
 public:
  GltfMaterials(const tinygltf::Model& model, const std::string& file, DecodedImages& images,
                ImportedMesh& mesh)
      : model_(model),
        file_(file),
        images_(images),
        mesh_(mesh),
        textures_(model.textures.size(), -1) {}

  void read(Strictness strictness) {
    for (std::size_t i = 0; i < textures_.size() && strictness == Strictness::kStrict; ++i) {
      textures_[i] = mesh_.asset.add(texture_of(model_.textures[i]));
    }
    for (const tinygltf::Material& material : model_.materials) add(material);
  }

 private:
  /// The asset's texture of that number in the file; read when it is first asked for, so that
  /// images that are not drawn take no memory. -1, and a note, if it cannot be read.
  int texture(int index, const std::string& material) {
    gltf_item(model_.textures, index, "texture", file_);
    int& known = textures_[static_cast<std::size_t>(index)];
    if (known >= 0) return known;
    std::string& problem = problems_[index];
    try {
      if (problem.empty()) {
        return known =
                   mesh_.asset.add(texture_of(model_.textures[static_cast<std::size_t>(index)]));
      }
    } catch (const Error& error) {
      const std::string text = error.what();
      problem = text.substr(text.starts_with(file_) ? file_.size() + 2 : 0);
    }
    mesh_.notes.add(
        fmt::format("material '{}' is drawn in its colour alone: {}", material, problem));
    return -1;
  }

  Texture texture_of(const tinygltf::Texture& from) {
    if (from.source < 0 && !from.extensions.empty()) {
      fail("{}: expected an image (PNG, JPEG, TIFF), found only one by {}", file_,
           from.extensions.begin()->first);
    }
    const tinygltf::Image& image = gltf_item(model_.images, from.source, "image", file_);
    Texture texture;
    texture.name = image.name.empty() ? image.uri : image.name;
    const std::string where = fmt::format("{}: image \"{}\"", file_, texture.name);
    if (image.bufferView >= 0) {
      texture.rgba = images_.decode(gltf_view(model_, image.bufferView, file_), where);
    } else if (image.image.empty()) {
      fail("{}: the file {} cannot be read", where, image.uri);
    } else {
      const auto* bytes = reinterpret_cast<const char*>(image.image.data());
      texture.rgba = images_.decode({bytes, image.image.size()}, where);
    }
    if (from.sampler >= 0) {
      const tinygltf::Sampler& sampler = gltf_item(model_.samplers, from.sampler, "sampler", file_);
      texture.repeat = sampler.wrapS != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    }
    return texture;
  }

  void add(const tinygltf::Material& from) {
    const tinygltf::PbrMetallicRoughness& look = from.pbrMetallicRoughness;
    Material material = make_material(from.name, Label::kLeaf, -1);
    if (look.baseColorTexture.index >= 0) {
      material.texture = texture(look.baseColorTexture.index, from.name);
    }
    for (int i = 0; i < 3 && look.baseColorFactor.size() >= 3; ++i) {
      material.colour[i] = static_cast<float>(look.baseColorFactor[static_cast<std::size_t>(i)]);
    }
    material.cutout = from.alphaMode != "OPAQUE";
    material.double_sided = from.doubleSided;
    if (from.extras.Has(kLabel)) {
      material.label = label(from.extras.Get(kLabel));
      mesh_.labelled.insert(static_cast<int>(mesh_.asset.materials.size()));
    }
    if (from.extras.Has(kTranslucency)) {
      material.translucency = static_cast<float>(
          gltf_number(from.extras.Get(kTranslucency), kTranslucency, 0, 1, file_));
    }
    mesh_.asset.add(std::move(material));
    note_looks(from);
  }

  /// What is not drawn of a material.
  void note_looks(const tinygltf::Material& from) {
    const auto note = [&](bool found, const char* what) {
      if (found) mesh_.notes.add(fmt::format("material '{}': {}", from.name, what));
    };
    const tinygltf::PbrMetallicRoughness& look = from.pbrMetallicRoughness;
    note(from.normalTexture.index >= 0, "its image of normals is left out");
    note(from.emissiveTexture.index >= 0, "its image of emission is left out");
    note(from.occlusionTexture.index >= 0, "its image of occlusion is left out");
    note(look.metallicRoughnessTexture.index >= 0, "its image of roughness is left out");
    note(look.baseColorTexture.extensions.contains("KHR_texture_transform"),
         "the transform of its image is left out");
    note(from.alphaMode == "BLEND", "it is cut out at half its opacity, not blended");
  }

  Label label(const Value& value) const {
    if (!value.IsString()) {
      const double last = static_cast<double>(kNumberedLabels.size()) - 1;
      return *label_named(
          kNumberedLabels.at(static_cast<std::size_t>(gltf_number(value, kLabel, 0, last, file_))));
    }
    const std::string& name = value.Get<std::string>();
    const std::optional<Label> named = label_named(name);
    if (!named) {
      fail("{}: {}: expected a label's name, such as \"leaf\", found \"{}\"", file_, kLabel, name);
    }
    return *named;
  }

  const tinygltf::Model& model_;
  const std::string& file_;
  DecodedImages& images_;
  ImportedMesh& mesh_;
  std::vector<int> textures_;            ///< the asset's, by their number in the file; else -1
  std::map<int, std::string> problems_;  ///< why one cannot be read
};

}  // namespace

double gltf_number(const tinygltf::Value& value, const char* what, double least, double most,
                   const std::string& file) {
  const double found = value.IsNumber() ? value.GetNumberAsDouble() : std::nan("");
  if (!(found >= least && found <= most)) {
    fail("{}: {}: expected a number from {} to {}, found {}", file, what, least, most,
         value.IsNumber() ? fmt::format("{}", found) : "none");
  }
  return found;
}

void read_gltf_materials(const tinygltf::Model& model, const std::string& file,
                         Strictness strictness, DecodedImages& images, ImportedMesh& mesh) {
  GltfMaterials(model, file, images, mesh).read(strictness);
}

}  // namespace vinebench::sim

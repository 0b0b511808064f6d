// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>

#include "tests/support/test_folder.h"

namespace vinebench::test {

/// An upright rectangle about the z axis that faces -y, m.
struct PlantPart {
  const char* name;
  const char* material;
  float half, bottom, top;

  /// Counter-clockwise from the front.
  std::array<Eigen::Vector3f, 4> corners() const {
    return {{{-half, 0, bottom}, {half, 0, bottom}, {half, 0, top}, {-half, 0, top}}};
  }
};

/// What the functions below write in each format: a plant of another tool, 1.6 m high.
inline constexpr std::array<PlantPart, 2> kPlantParts{
    {{"Trunk", "Bark", 0.05f, 0, 1}, {"Foliage", "Green", 0.4f, 1, 1.6f}}};

/// z up, as its tools rarely write it; objects and materials have names.
inline std::filesystem::path write_obj_plant(const TestFolder& folder) {
  folder.write("plant.mtl", "newmtl Bark\nKd 0.4 0.3 0.2\nnewmtl Green\nKd 0.2 0.5 0.1\n");
  std::string text = "mtllib plant.mtl\n";
  int first = 1;
  for (const PlantPart& part : kPlantParts) {
    text += fmt::format("o {}\nusemtl {}\n", part.name, part.material);
    for (const Eigen::Vector3f& v : part.corners()) {
      text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
    }
    text += fmt::format("vn 0 -1 0\nf {0}//{4} {1}//{4} {2}//{4} {3}//{4}\n", first, first + 1,
                        first + 2, first + 3, (first + 3) / 4);
    first += 4;
  }
  return folder.write("plant.obj", text);
}

inline std::string dae_geometry(const PlantPart& part) {
  std::string numbers;
  for (const Eigen::Vector3f& v : part.corners()) {
    numbers += fmt::format("{} {} {} ", v.x(), v.y(), v.z());
  }
  return fmt::format(
      R"(<geometry id="{0}-mesh" name="{0}"><mesh><source id="{0}-p">
<float_array id="{0}-pa" count="12">{1}</float_array><technique_common>
<accessor source="#{0}-pa" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<source id="{0}-n"><float_array id="{0}-na" count="3">0 -1 0</float_array><technique_common>
<accessor source="#{0}-na" count="1" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="{0}-v"><input semantic="POSITION" source="#{0}-p"/></vertices>
<triangles material="{2}-material" count="2"><input semantic="VERTEX" source="#{0}-v" offset="0"/>
<input semantic="NORMAL" source="#{0}-n" offset="1"/><p>0 0 1 0 2 0 0 0 2 0 3 0</p></triangles>
</mesh></geometry>)",
      part.name, numbers, part.material);
}

/// z up and metres, as it says itself.
inline std::filesystem::path write_dae_plant(const TestFolder& folder) {
  std::string effects, materials, geometries, nodes;
  for (const PlantPart& part : kPlantParts) {
    effects += fmt::format(
        R"(<effect id="{0}-effect"><profile_COMMON><technique sid="common"><lambert><diffuse>
<color>0.4 0.3 0.2 1</color></diffuse></lambert></technique></profile_COMMON></effect>)",
        part.material);
    materials += fmt::format(
        R"(<material id="{0}-material" name="{0}"><instance_effect url="#{0}-effect"/></material>)",
        part.material);
    geometries += dae_geometry(part);
    nodes += fmt::format(
        R"(<node id="{0}-id" name="{0}" type="NODE"><instance_geometry url="#{0}-mesh" name="{0}">
<bind_material><technique_common><instance_material symbol="{1}-material" target="#{1}-material"/>
</technique_common></bind_material></instance_geometry></node>)",
        part.name, part.material);
  }
  return folder.write(
      "plant.dae",
      R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset><library_effects>)" +
          effects + "</library_effects><library_materials>" + materials +
          "</library_materials><library_geometries>" + geometries +
          "</library_geometries><library_visual_scenes><visual_scene id=\"s\">" + nodes +
          R"(</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)");
}

/// Places and normals of both parts, y up.
inline std::string gltf_bytes() {
  std::string bytes;
  const auto append = [&](const Eigen::Vector3f& v) {
    const Eigen::Vector3f turned(v.x(), v.z(), -v.y());
    bytes.append(reinterpret_cast<const char*>(turned.data()), 12);
  };
  for (const PlantPart& part : kPlantParts) {
    for (const Eigen::Vector3f& v : part.corners()) append(v);
    for (int i = 0; i < 4; ++i) append(-Eigen::Vector3f::UnitY());
  }
  for (const std::uint8_t index : {0, 1, 2, 0, 2, 3}) bytes += static_cast<char>(index);
  return bytes + std::string(2, '\0');
}

/// `attributes` goes to the primitives, `more` to the top of the file.
inline std::string gltf_text(const std::string& uri, const std::string& attributes = "",
                             const std::string& more = "") {
  std::string nodes, meshes, materials, views, accessors;
  for (std::size_t i = 0; i < kPlantParts.size(); ++i) {
    const PlantPart& part = kPlantParts[i];
    const char* comma = i > 0 ? "," : "";
    nodes += fmt::format(R"({}{{"name":"{}","mesh":{}}})", comma, part.name, i);
    meshes += fmt::format(
        R"({}{{"name":"{}-mesh","primitives":[{{"attributes":{{"POSITION":{},"NORMAL":{}{}}},)"
        R"("indices":4,"material":{}}}]}})",
        comma, part.name, 2 * i, 2 * i + 1, attributes, i);
    materials += fmt::format(R"({}{{"name":"{}"}})", comma, part.material);
    for (int k = 0; k < 2; ++k) {
      accessors += fmt::format(
          R"({{"bufferView":0,"byteOffset":{},"componentType":5126,"count":4,"type":"VEC3"}},)",
          96 * i + 48 * static_cast<std::size_t>(k));
    }
  }
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[)" + nodes +
         R"(],"meshes":[)" + meshes + R"(],"materials":[)" + materials + R"(],"accessors":[)" +
         accessors + R"({"bufferView":1,"componentType":5121,"count":6,"type":"SCALAR"}],)" +
         R"("bufferViews":[{"buffer":0,"byteLength":192},)" +
         R"({"buffer":0,"byteOffset":192,"byteLength":6}],"buffers":[{"byteLength":200)" + uri +
         "}]" + more + "}";
}

inline std::filesystem::path write_gltf_plant(const TestFolder& folder,
                                              const std::string& attributes = "",
                                              const std::string& more = "") {
  folder.write("plant.bin", gltf_bytes());
  return folder.write("plant.gltf", gltf_text(R"(,"uri":"plant.bin")", attributes, more));
}

inline std::filesystem::path write_glb_plant(const TestFolder& folder) {
  std::string json = gltf_text("");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string data = gltf_bytes();
  std::string bytes = "glTF";
  const auto append = [&](std::size_t number) {
    const auto word = static_cast<std::uint32_t>(number);
    bytes.append(reinterpret_cast<const char*>(&word), 4);
  };
  append(2);
  append(12 + 8 + json.size() + 8 + data.size());
  append(json.size());
  bytes += "JSON" + json;
  append(data.size());
  bytes += std::string("BIN\0", 4) + data;
  return folder.write("plant.glb", bytes);
}

/// Binary, z up, without names.
inline std::filesystem::path write_stl_plant(const TestFolder& folder) {
  std::string bytes(80, ' ');
  const std::uint32_t count = 2 * kPlantParts.size();
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (const PlantPart& part : kPlantParts) {
    const auto corners = part.corners();
    for (const std::array<std::size_t, 3>& triangle :
         {std::array<std::size_t, 3>{0, 1, 2}, std::array<std::size_t, 3>{0, 2, 3}}) {
      const Eigen::Vector3f normal = -Eigen::Vector3f::UnitY();
      bytes.append(reinterpret_cast<const char*>(normal.data()), 12);
      for (const std::size_t i : triangle) {
        bytes.append(reinterpret_cast<const char*>(corners[i].data()), 12);
      }
      bytes.append(2, '\0');
    }
  }
  return folder.write("plant.stl", bytes);
}

}  // namespace vinebench::test

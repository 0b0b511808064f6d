// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/tag_list.h"

#include <cmath>

#include "core/config/yaml.h"
#include "core/config/yaml_writer.h"
#include "core/geometry/angle.h"

namespace vinebench::harness {
namespace {

struct TagListConfig {
  struct Tag {
    std::string family = "tag36h11";
    int id = 0;
    double size = 0.161;                                 ///< m
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
    Eigen::Vector4d rotation{0, 0, 0, 1};                ///< x, y, z, w
    double survey_position = 0;                          ///< m
    double survey_rotation_deg = 0;
    template <class Archive>
    void serialize(Archive& archive) {
      archive("family", family);
      archive("id", id, Range::non_negative());
      archive("size", size, Range::positive());
      archive("position", position);
      archive("rotation", rotation);
      archive("survey_position", survey_position, Range::between(0, 10));
      archive("survey_rotation_deg", survey_rotation_deg, Range::between(0, 90));
      archive.require(std::abs(rotation.norm() - 1) < 1e-6, "rotation",
                      "expected a unit quaternion (x, y, z, w)");
    }
  };
  std::vector<Tag> tags;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("tags", tags);
  }
};

}  // namespace

std::string format_tags(const std::vector<RegisteredTag>& tags) {
  TagListConfig list;
  for (const RegisteredTag& tag : tags) {
    list.tags.push_back({tag.family, tag.id, tag.size, tag.T_world_tag.translation,
                         tag.T_world_tag.rotation.coeffs(), tag.survey.position,
                         tag.survey.rotation / kRadiansPerDegree});
  }
  return format_yaml(list);
}

std::vector<RegisteredTag> read_tags(const std::filesystem::path& file) {
  std::vector<RegisteredTag> tags;
  for (const auto& tag : YamlDocument::load(file).read<TagListConfig>().tags) {
    tags.push_back({tag.family,
                    tag.id,
                    tag.size,
                    Pose{Eigen::Quaterniond(tag.rotation), tag.position},
                    {tag.survey_position, tag.survey_rotation_deg * kRadiansPerDegree}});
  }
  return tags;
}

}  // namespace vinebench::harness

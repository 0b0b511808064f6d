// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/instances/instances_writer.h"

#include <fmt/format.h>

#include "harness/datasets/files/png_writer.h"
#include "harness/datasets/format/image_writer.h"
#include "harness/datasets/labels/instance_ids.h"
#include "harness/datasets/labels/truth_colours.h"

namespace vinebench::harness {

namespace fs = std::filesystem;

InstanceWriter::InstanceWriter(const fs::path& folder, const RecordingNotes& notes,
                               const SceneIndex& scene)
    : folder_(folder),
      cameras_(make_camera_folders(folder, notes)),
      scene_(scene),
      table_(folder / "instances.csv") {
  table_.append("#id,thing,number of its kind,bunch,model,red,green,blue\n");
}

void InstanceWriter::name_new_ones(const cv::Mat& instances) {
  std::int32_t last = 0;
  for (int y = 0; y < instances.rows; ++y) {
    const auto* number = instances.ptr<std::int32_t>(y);
    for (int x = 0; x < instances.cols; ++x) {
      if (number[x] == last) continue;
      last = number[x];
      if (ids_.contains(last)) continue;
      const std::int32_t id = ids_[last] = last == 0 ? 0 : instance_id(scene_, last);
      if (id == 0) continue;
      const InstanceName name = scene_.name(last);
      const cv::Vec3b colour = instance_colour(last);
      table_.append(fmt::format("{},{},{},{},{},{},{},{}\n", id, name_of(name.thing), name.id,
                                name.part, name.model, colour[0], colour[1], colour[2]));
    }
  }
}

std::vector<FileTask> InstanceWriter::files(const std::shared_ptr<const DatasetFrame>& frame) {
  std::vector<FileTask> tasks;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!delivered(*frame, i)) continue;
    name_new_ones(truth_of(*frame, i).instances);
    tasks.push_back({fmt::format("instances {}", i),
                     folder_ / cameras_[i] / numbered(frame->number, "png"), [this, frame, i] {
                       return encode_png(
                           id_colours(instance_ids(scene_, truth_of(*frame, i).instances)));
                     }});
  }
  return tasks;
}

}  // namespace vinebench::harness

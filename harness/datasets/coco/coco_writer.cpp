// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/coco/coco_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/files/files.h"
#include "harness/datasets/coco/coco_file.h"
#include "harness/datasets/files/json_file.h"
#include "harness/datasets/labels/instance_ids.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::int64_t kCameras = 16;              // at most, for ids
constexpr std::int64_t kThingsPerImage = 100'000;  // likewise

/// Not individually countable: COCO's crowds.
bool is_crowd(Category category) {
  return category == Category::kLeaf || category == Category::kCane;
}

Json box(const Runs& mask, int height) {
  const cv::Rect box = box_of(mask, height);
  return Json::array({box.x, box.y, box.width, box.height});
}

Json rounded(const std::optional<double>& share) {
  return share ? Json(std::round(*share * 1e4) / 1e4) : Json(nullptr);
}

Json annotation(const ThingLabel& thing, const cv::Size& size, const SceneIndex& scene) {
  const InstanceName name = scene.name(thing.number);
  const auto pixels = static_cast<std::int64_t>(size.area());
  Json json{{"category_id", category_id(thing.category)},
            {"bbox", box(thing.mask, size.height)},
            {"area", area_of(thing.mask)},
            {"iscrowd", is_crowd(thing.category) ? 1 : 0},
            {"segmentation",
             {{"size", {size.height, size.width}}, {"counts", compress(thing.mask, pixels)}}}};
  if (thing.visibility) json["visibility"] = rounded(thing.visibility);
  if (thing.truncation) json["truncation"] = rounded(thing.truncation);
  json["instance"] = instance_id(scene, thing.number);
  if (name.thing == Thing::kVine) json["plant"] = name.id;
  if (name.part > 0) json["bunch"] = name.part;
  return json;
}

Json segment(std::int32_t id, Category category, const Runs& mask, int height) {
  return {{"id", id},
          {"category_id", category_id(category)},
          {"bbox", box(mask, height)},
          {"area", area_of(mask)},
          {"iscrowd", is_crowd(category) ? 1 : 0}};
}

}  // namespace

std::int64_t coco_image_id(const CocoOptions& options, std::int64_t frame, std::size_t camera) {
  return options.first_image_id + frame * kCameras + static_cast<std::int64_t>(camera);
}

CocoWriter::CocoWriter(const fs::path& folder, const RecordingNotes& notes, const SceneIndex& scene,
                       const CocoOptions& options)
    : folder_(make_folder(folder)),
      scene_(scene),
      options_(options),
      images_(folder / "images.jsonl"),
      annotations_(folder / "annotations.jsonl"),
      panoptic_(folder / "panoptic.jsonl") {
  for (const RigConfig::Camera& camera : notes.rig.cameras) cameras_.push_back(camera.name);
  make_folder(folder / kCocoImages);
  make_folder(folder / "panoptic");
}

std::string CocoWriter::name_of_image(const DatasetFrame& frame, std::size_t camera,
                                      const std::string& ending) const {
  return cameras_[camera] + "_" + numbered(frame.number, ending);
}

std::vector<FileTask> CocoWriter::files(const std::shared_ptr<const DatasetFrame>& frame) {
  const std::string ending = yaml_names(options_.kind).at(static_cast<std::size_t>(options_.kind));
  std::vector<FileTask> tasks;
  pending_.assign(cameras_.size(), {});
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (frame->frame.images[i].empty()) continue;
    tasks.push_back({fmt::format("rgb {} {}", ending, i),
                     folder_ / kCocoImages / name_of_image(*frame, i, ending), [this, frame, i] {
                       return encode_image(frame->frame.images[i], options_.kind);
                     }});
    tasks.push_back({fmt::format("panoptic {}", i),
                     folder_ / "panoptic" / name_of_image(*frame, i, "png"), [this, frame, i] {
                       const ImageLabels labels = label_things(frame->truth.views[i], scene_);
                       pending_[i] = describe(*frame, i, labels);
                       return encode_png(id_colours(labels.segments));
                     }});
  }
  return tasks;
}

CocoWriter::Lines CocoWriter::describe(const DatasetFrame& frame, std::size_t camera,
                                       const ImageLabels& labels) const {
  const std::string ending = yaml_names(options_.kind).at(static_cast<std::size_t>(options_.kind));
  const std::int64_t image = coco_image_id(options_, frame.number, camera);
  const cv::Size size = labels.segments.size();
  Lines lines;
  lines.image = json_text(Json{{"id", image},
                               {"file_name", name_of_image(frame, camera, ending)},
                               {"width", size.width},
                               {"height", size.height},
                               {"license", 1},
                               {"camera", cameras_[camera]},
                               {"frame", frame.number},
                               {"stamp_ns", frame.frame.stamp}}) +
                "\n";
  std::int64_t count = 0;
  Json segments = Json::array();
  for (const ThingLabel& thing : labels.things) {
    if (thing.segment != 0) {
      segments.push_back(segment(thing.segment, thing.category, thing.mask, size.height));
    }
    if (!options_.categories.empty() && !options_.categories.contains(thing.category)) continue;
    if (area_of(thing.mask) < options_.least_area) continue;
    Json json{{"id", image * kThingsPerImage + count++}, {"image_id", image}};
    json.update(annotation(thing, size, scene_));
    lines.annotations += json_text(json) + "\n";
  }
  for (const StuffLabel& stuff : labels.stuff) {
    segments.push_back(segment(stuff.segment, stuff.category, stuff.mask, size.height));
  }
  lines.panoptic = json_text(Json{{"image_id", image},
                                  {"file_name", name_of_image(frame, camera, "png")},
                                  {"segments_info", segments}}) +
                   "\n";
  return lines;
}

void CocoWriter::commit(const DatasetFrame&) {
  for (const Lines& lines : pending_) {
    annotations_.append(lines.annotations);
    panoptic_.append(lines.panoptic);
    images_.append(lines.image);
  }
}

void CocoWriter::finish() {
  write_coco_from_lists(folder_, options_.categories);
  std::error_code ignored;
  for (const char* list : {"images.jsonl", "annotations.jsonl", "panoptic.jsonl"}) {
    fs::remove(folder_ / list, ignored);
  }
}

}  // namespace vinebench::harness

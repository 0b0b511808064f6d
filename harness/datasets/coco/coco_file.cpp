// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/coco/coco_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/files/input_file.h"
#include "core/files/output_file.h"
#include "core/util/error.h"
#include "harness/datasets/files/json_file.h"
#include "vinebench/version.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFileName = "\"file_name\":\"";

/// Calls for every item of a list, a line without its end.
using Take = std::function<void(const std::string&)>;
using Items = std::function<void(const Take&)>;

Items lines_of(const fs::path& file) {
  return [file](const Take& take) {
    InputStream in(file, FileKind::kPart);
    for (std::string line; std::getline(in, line) && !in.eof();) take(line);
  };
}

/// The items of one list of a file written by write_coco().
void take_list(const fs::path& file, const std::string& list, const Take& take) {
  InputStream in(file, FileKind::kPart);
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (!inside) {
      inside = line == fmt::format("\"{}\": [", list);
    } else if (line.starts_with("]")) {
      return;
    } else {
      if (line.ends_with(",")) line.pop_back();
      take(line);
    }
  }
  fail("{}: expected a list '{}' with one item on each line", file.string(), list);
}

/// The items of all parts, with image names in the folder `below` of each part; parts of version
/// 0.2.0 and earlier name it already.
Items lists_of(const fs::path& folder, const std::vector<std::string>& parts,
               const std::string& file, const std::string& list, const std::string& below) {
  return [=](const Take& take) {
    for (const std::string& part : parts) {
      take_list(folder / part / file, list, [&](const std::string& item) {
        std::string moved = item;
        const std::size_t at = moved.find(kFileName);
        if (at != std::string::npos) {
          const std::size_t name = at + std::strlen(kFileName);
          const bool has_folder = moved.compare(name, below.size(), below) == 0;
          moved.insert(name, part + "/" + (has_folder ? "" : below));
        }
        take(moved);
      });
    }
  };
}

/// A list of the file.
void write_list(OutputFile& out, const std::string& name, const Items& items) {
  out.write(fmt::format("\"{}\": [", name));
  const char* before = "\n";
  items([&](const std::string& line) {
    out.write(before);
    out.write(line);
    before = ",\n";
  });
  out.write("\n]");
}

void write_coco(const fs::path& file, const Json& categories, const Items& images,
                const Items& annotations) {
  OutputFile out(file);
  const Json info{{"description", "Simulated vineyard, Vinebench"}, {"version", kVersion}};
  const Json licence{{"id", 1},
                     {"name", "CC0 1.0"},
                     {"url", "https://creativecommons.org/publicdomain/zero/1.0/"}};
  out.write(fmt::format("{{\"info\": {},\n\"licenses\": [{}],\n\"categories\": {},\n",
                        json_text(info), json_text(licence), json_text(categories)));
  write_list(out, "images", images);
  out.write(",\n");
  write_list(out, "annotations", annotations);
  out.write("}\n");
  out.finish();
}

Json category_json(Category category) {
  for (std::size_t label = 0; label < kLabels; ++label) {
    if (category_of(static_cast<Label>(label)) != category) continue;
    const cv::Vec3b colour = label_colour(static_cast<std::uint8_t>(label));
    return {{"id", category_id(category)},
            {"name", category_name(category)},
            {"supercategory", is_thing(category) ? "thing" : "stuff"},
            {"isthing", is_thing(category) ? 1 : 0},
            {"color", {colour[0], colour[1], colour[2]}}};
  }
  return {{"id", category_id(category)},  // a plant is made of several labels
          {"name", category_name(category)},
          {"supercategory", "thing"},
          {"isthing", 1},
          {"color", {60, 160, 60}}};
}

/// Categories of instances.json: all things, or the selected ones; of panoptic.json: all categories
/// of pixels.
Json category_list(bool panoptic, const std::set<Category>& chosen) {
  Json list = Json::array();
  for (std::size_t i = 0; i < kCategories; ++i) {
    const auto category = static_cast<Category>(i);
    const bool counts = panoptic
                            ? category != Category::kPlant
                            : is_thing(category) && (chosen.empty() || chosen.contains(category));
    if (counts) list.push_back(category_json(category));
  }
  return list;
}

}  // namespace

void write_coco_from_lists(const fs::path& folder, const std::set<Category>& categories) {
  const Items images = lines_of(folder / "images.jsonl");
  write_coco(folder / "instances.json", category_list(false, categories), images,
             lines_of(folder / "annotations.jsonl"));
  write_coco(folder / "panoptic.json", category_list(true, {}), images,
             lines_of(folder / "panoptic.jsonl"));
}

void merge_coco(const fs::path& folder, const std::vector<std::string>& parts,
                const std::set<Category>& categories) {
  const std::string images = std::string(kCocoImages) + "/";
  write_coco(folder / "instances.json", category_list(false, categories),
             lists_of(folder, parts, "instances.json", "images", images),
             lists_of(folder, parts, "instances.json", "annotations", ""));
  write_coco(folder / "panoptic.json", category_list(true, {}),
             lists_of(folder, parts, "panoptic.json", "images", images),
             lists_of(folder, parts, "panoptic.json", "annotations", "panoptic/"));
}

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "harness/datasets/ros/ros_writer.h"
#include "harness/datasets/ros2/cdr/ros2_messages.h"
#include "harness/datasets/ros2/cdr/ros2_output.h"
#include "python/frames.h"
#include "python/scenarios.h"
#include "python/systems.h"

namespace vinebench::python {
namespace {

using Overrides = std::map<std::string, py::object>;
using FilePath = std::filesystem::path;
using Messages = std::vector<harness::Ros2Message>;
using harness::RosWriter;
namespace ros2 = harness::ros2;

/// Keeps messages that would stand in a bag.
class Collector : public harness::Ros2Output {
 public:
  explicit Collector(Messages& messages) : messages_(messages) {}
  void end_chunk() override {}
  void close() override {}

 private:
  void put(harness::Ros2Message message) override { messages_.push_back(std::move(message)); }

  Messages& messages_;
};

/// (topic, time in ns, bytes in CDR)
py::list tuples_of(const Messages& messages) {
  py::list list;
  for (const harness::Ros2Message& message : messages) {
    list.append(py::make_tuple(message.topic, message.time, py::bytes(message.bytes)));
  }
  return list;
}

/// The messages of a scenario's frames, those of its bag of ROS 2.
class RosMessages {
 public:
  RosMessages(const harness::RecordingNotes& notes, bool colour,
              std::optional<harness::ImageKind> kind)
      : rig_(notes.rig.make()),
        kind_(kind),
        writer_(std::make_unique<Collector>(messages_), notes, colour, kind) {}

  const Rig& rig() const { return rig_; }

  /// Topic, type, whether latched; the truth's last.
  py::list topics() const {
    py::list list;
    const auto add = [&](const std::string& topic, const char* type, bool latched = false) {
      list.append(py::make_tuple(topic, type, latched));
    };
    add("/clock", ros2::kClock);
    add("/tf_static", ros2::kTransforms, true);
    add("/imu", ros2::kImu);
    add("/joint_states", ros2::kJointState);
    for (const harness::RosCamera& camera : harness::ros_cameras(rig_)) {
      add(camera.images + (kind_ ? "/compressed" : ""),
          kind_ ? ros2::kCompressedImage : ros2::kImage);
      add(camera.info, ros2::kCameraInfo);
    }
    if (!rig_.tag_cameras.empty()) add("/tags", ros2::kTransforms);
    add("/ground_truth", ros2::kOdometry);
    add("/tf", ros2::kTransforms);
    return list;
  }

  py::list of_frame(const py::object& given) {
    harness::DatasetFrame frame;
    frame.frame = frame_for(rig_, given);
    frame.truth.known = false;
    return commit(std::move(frame));
  }

  py::list of_truth(Stamp stamp, const py::object& pose) {
    harness::DatasetFrame frame;
    frame.frame.stamp = stamp;
    frame.frame.images.resize(rig_.cameras.size());
    frame.truth.T_world_body = pose_of(pose, "T_world_body");
    return commit(std::move(frame));
  }

 private:
  py::list commit(harness::DatasetFrame made) {
    const auto frame = std::make_shared<const harness::DatasetFrame>(std::move(made));
    {
      const py::gil_scoped_release others_may_run;
      messages_.clear();
      for (const harness::FileTask& task : writer_.files(frame)) task.take(task.bytes());
      writer_.commit(*frame);
    }
    return tuples_of(messages_);
  }

  Rig rig_;
  std::optional<harness::ImageKind> kind_;
  Messages messages_;
  RosWriter writer_;
};

std::optional<harness::ImageKind> kind_of(const std::string& name) {
  if (name == "raw") return std::nullopt;
  const std::vector<std::string> names = yaml_names(harness::ImageKind{});
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) throw py::value_error("images: expected raw, png or jpg");
  return static_cast<harness::ImageKind>(found - names.begin());
}

std::unique_ptr<RosMessages> messages_of(const FilePath& scenario, std::optional<std::int64_t> seed,
                                         const Overrides& set,
                                         const std::optional<FilePath>& randomise, bool colour,
                                         const std::string& images, bool tags) {
  const harness::FramesRequest request = frames_request(scenario, seed, set, randomise, {}, {}, 1);
  const std::optional<harness::ImageKind> kind = kind_of(images);
  const py::gil_scoped_release others_may_run;
  harness::RecordingNotes notes = harness::notes_of(harness::scenario_of(request));
  if (!tags) notes.rig.tag_cameras.clear();
  return std::make_unique<RosMessages>(notes, colour, kind);
}

}  // namespace

void define_ros_messages(py::module_& module) {
  py::class_<RosMessages>(module, "RosMessages",
                          "The messages of ROS 2 of a scenario's frames, as in its bag.")
      .def(py::init(&messages_of), py::arg("scenario"), py::kw_only(), py::arg("seed"),
           py::arg("set"), py::arg("randomise"), py::arg("colour"), py::arg("images"),
           py::arg("tags"))
      .def_property_readonly("rig", &RosMessages::rig)
      .def_property_readonly("topics", &RosMessages::topics)
      .def_property_readonly_static("start", [](const py::object&) { return harness::kRosStart; })
      .def("of_frame", &RosMessages::of_frame, py::arg("frame"))
      .def("of_truth", &RosMessages::of_truth, py::arg("stamp"), py::arg("T_world_body"));
}

}  // namespace vinebench::python

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
//
// `import vinebench`: the frames of a scenario as NumPy arrays. docs/python.md is for its users.
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/time.h"
#include "core/util/error.h"
#include "core/util/warning.h"
#include "harness/datasets/labels/label_table.h"
#include "harness/datasets/labels/mask_rle.h"
#include "harness/jobs/frame_stream.h"
#include "vinebench/version.h"

namespace py = pybind11;

namespace vinebench {
namespace {

py::dtype dtype_of(const cv::Mat& mat) {
  switch (mat.depth()) {
    case CV_8U:
      return py::dtype::of<std::uint8_t>();
    case CV_32S:
      return py::dtype::of<std::int32_t>();
    case CV_32F:
      return py::dtype::of<float>();
    default:
      fail("an image of OpenCV type {} has no array", mat.type());
  }
}

/// (h, w) or (h, w, channels), without a copy: the array keeps the image's memory alive.
py::array to_array(const cv::Mat& mat) {
  const auto item = static_cast<py::ssize_t>(mat.elemSize1());
  std::vector<py::ssize_t> shape{mat.rows, mat.cols};
  std::vector<py::ssize_t> strides{static_cast<py::ssize_t>(mat.step[0]), item * mat.channels()};
  if (mat.channels() > 1) {
    shape.push_back(mat.channels());
    strides.push_back(item);
  }
  auto kept = std::make_unique<cv::Mat>(mat);
  const py::capsule owner(kept.get(), [](void* held) { delete static_cast<cv::Mat*>(held); });
  const void* pixels = kept.release()->data;
  return {dtype_of(mat), std::move(shape), std::move(strides), pixels, owner};
}

/// A frame and the stream that it belongs to.
struct Scenario {
  std::shared_ptr<harness::FrameStream> stream;
};

struct PyFrame {
  std::shared_ptr<harness::FrameStream> stream;
  std::shared_ptr<const harness::DatasetFrame> frame;

  std::size_t camera(const std::string& name) const {
    const int index = stream->rig().find_camera(name);
    if (index < 0) fail("rig '{}' has no camera named '{}'", stream->rig().name, name);
    return static_cast<std::size_t>(index);
  }
};

/// One array for each camera that delivered an image, by name.
template <class ImageOf>
py::dict by_camera(const PyFrame& self, const ImageOf& image_of) {
  py::dict arrays;
  const std::vector<RigCamera>& cameras = self.stream->rig().cameras;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const cv::Mat* image = image_of(i);
    if (image != nullptr && !image->empty()) {
      arrays[py::str(cameras[i].name)] = to_array(*image);
    }
  }
  return arrays;
}

py::dict truth_arrays(const PyFrame& self, const cv::Mat RenderedImage::*part) {
  const std::vector<TruthView>& views = self.frame->truth.views;
  return by_camera(
      self, [&](std::size_t i) { return i < views.size() ? &(views[i].image.*part) : nullptr; });
}

/// (n, 7): s, rad/s x y z, m/s^2 x y z.
Eigen::MatrixXd inertial_readings(const PyFrame& self) {
  const std::vector<ImuSample>& imu = self.frame->frame.imu;
  Eigen::MatrixXd rows(imu.size(), 7);
  for (std::size_t i = 0; i < imu.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) << to_seconds(imu[i].stamp),
        imu[i].angular_velocity.transpose(), imu[i].specific_force.transpose();
  }
  return rows;
}

/// (n, 9): s, rad of the four wheels, rad/s of them.
Eigen::MatrixXd wheel_readings(const PyFrame& self) {
  const std::vector<WheelSample>& wheels = self.frame->frame.wheels;
  Eigen::MatrixXd rows(wheels.size(), 9);
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    rows(row, 0) = to_seconds(wheels[i].stamp);
    for (Eigen::Index w = 0; w < 4; ++w) {
      rows(row, 1 + w) = wheels[i].angle[static_cast<std::size_t>(w)];
      rows(row, 5 + w) = wheels[i].velocity[static_cast<std::size_t>(w)];
    }
  }
  return rows;
}

py::list things_of(const PyFrame& self, const std::string& name) {
  const std::size_t camera = self.camera(name);
  const harness::ImageLabels labels = self.stream->things(*self.frame, camera);
  const cv::Size size = labels.segments.size();
  py::list things;
  for (const harness::ThingLabel& thing : labels.things) {
    const cv::Rect box = harness::box_of(thing.mask, size.height);
    py::dict entry;
    entry["category"] = harness::category_name(thing.category);
    entry["number"] = thing.number;
    entry["box"] = py::make_tuple(box.x, box.y, box.width, box.height);
    entry["mask"] = to_array(harness::mask_of(thing.mask, size)).attr("astype")(py::dtype("bool"));
    entry["visibility"] = thing.visibility;
    entry["truncation"] = thing.truncation;
    things.append(entry);
  }
  return things;
}

py::tuple flow_to(const PyFrame& self, const PyFrame& next, const std::string& camera) {
  const FlowTruth truth = self.stream->flow(*self.frame, *next.frame, self.camera(camera));
  return py::make_tuple(to_array(truth.flow), to_array(truth.visible));
}

struct Arguments {
  std::filesystem::path scenario;
  std::optional<std::int64_t> seed;
  std::map<std::string, py::object> overrides;
  std::optional<std::filesystem::path> randomise;
  std::vector<std::string> cameras;
  std::vector<std::string> truth;
  std::optional<std::pair<std::int64_t, std::int64_t>> frames;
  std::int64_t every = 1;
  int threads = 2;
};

/// As a warning of Python.
void warn(const std::string& text) {
  const py::gil_scoped_acquire acquired;
  if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

Scenario open_scenario(const Arguments& arguments) {
  harness::StreamRequest request;
  request.scenario = arguments.scenario;
  request.seed = arguments.seed;
  for (const auto& [key, value] : arguments.overrides) {
    const bool truth_value = py::isinstance<py::bool_>(value);  // YAML writes them small
    request.overrides.emplace_back(
        key, truth_value ? (value.cast<bool>() ? "true" : "false") : std::string(py::str(value)));
  }
  if (arguments.randomise) request.randomisation = *arguments.randomise;
  request.cameras = arguments.cameras;
  request.truth = arguments.truth;
  if (arguments.frames) std::tie(request.first, request.last) = *arguments.frames;
  request.every = arguments.every;
  request.threads = arguments.threads;
  request.machine = harness::machine_of_environment();
  request.machine.plant_cache.notice = warn;
  const py::gil_scoped_release others_may_run;
  return {std::make_shared<harness::FrameStream>(request)};
}

PyFrame next_frame(const Scenario& self) {
  std::shared_ptr<const harness::DatasetFrame> frame;
  {
    const py::gil_scoped_release others_may_run;
    frame = self.stream->next();
  }
  if (frame == nullptr) throw py::stop_iteration();
  return {self.stream, std::move(frame)};
}

py::dict label_names() {
  py::dict names;
  for (std::size_t i = 0; i < kLabels; ++i) names[py::int_(i)] = name_of(static_cast<Label>(i));
  return names;
}

void define_camera(py::module_& module) {
  py::class_<RigCamera>(module, "Camera",
                        "A camera of the rig: an ideal pinhole, or one with a "
                        "lens of OpenCV's plumb_bob distortion.")
      .def_readonly("name", &RigCamera::name)
      .def_property_readonly("width", [](const RigCamera& c) { return c.model.width; })
      .def_property_readonly("height", [](const RigCamera& c) { return c.model.height; })
      .def_property_readonly(
          "K",
          [](const RigCamera& c) {
            Eigen::Matrix3d K;
            K << c.model.fx, 0, c.model.cx, 0, c.model.fy, c.model.cy, 0, 0, 1;
            return K;
          },
          "3 x 3, px")
      .def_property_readonly(
          "distortion", [](const RigCamera& c) { return c.model.distortion; }, "k1, k2, p1, p2")
      .def_property_readonly(
          "T_body_camera", [](const RigCamera& c) { return c.T_body_cam.matrix(); },
          "4 x 4, m: transforms points of the camera frame (x right, y down, z ahead) to "
          "the body frame (x forward, y left, z up)");
}

void define_frame(py::module_& module) {
  py::class_<PyFrame>(module, "Frame", "One instant: images and truth, each by camera name.")
      .def_property_readonly(
          "number", [](const PyFrame& f) { return f.frame->number; },
          "among the requested frames, from 0")
      .def_property_readonly(
          "index", [](const PyFrame& f) { return f.frame->frame.index; }, "in the run")
      .def_property_readonly(
          "stamp", [](const PyFrame& f) { return f.frame->frame.stamp; },
          "ns from the scenario's start, as stamped by the cameras")
      .def_property_readonly(
          "time", [](const PyFrame& f) { return to_seconds(f.frame->frame.stamp); },
          "the same in s")
      .def_property_readonly(
          "T_world_body", [](const PyFrame& f) { return f.frame->truth.T_world_body.matrix(); },
          "4 x 4, m: the true pose")
      .def_property_readonly(
          "images",
          [](const PyFrame& f) {
            return by_camera(f, [&](std::size_t i) { return &f.frame->frame.images[i]; });
          },
          "uint8, (h, w, 3) RGB, or (h, w) of a grey camera")
      .def_property_readonly(
          "depth", [](const PyFrame& f) { return truth_arrays(f, &RenderedImage::depth); },
          "float32 (h, w), m along the optical axis; 0 for sky")
      .def_property_readonly(
          "labels", [](const PyFrame& f) { return truth_arrays(f, &RenderedImage::labels); },
          "uint8 (h, w), indices into label_names")
      .def_property_readonly(
          "instances", [](const PyFrame& f) { return truth_arrays(f, &RenderedImage::instances); },
          "int32 (h, w): 256 times the object's number, plus a vine's bunch in the low byte")
      .def_property_readonly(
          "normals", [](const PyFrame& f) { return truth_arrays(f, &RenderedImage::normals); },
          "float32 (h, w, 3), unit, camera axes, towards the camera")
      .def_property_readonly("imu", &inertial_readings,
                             "(n, 7) since the previous frame: s, rad/s x y z, m/s^2 x y z")
      .def_property_readonly("wheels", &wheel_readings,
                             "(n, 9) since the previous frame: s, rad of front left, front right, "
                             "rear left, rear right, then rad/s of them")
      .def("things", &things_of, py::arg("camera"),
           "list of dicts: category, number, box (x, y, width, height), mask (bool), visibility "
           "and truncation (0 to 1, or None)")
      .def("flow_to", &flow_to, py::arg("next"), py::arg("camera"),
           "(float32 (h, w, 2) px, uint8 (h, w)): where each pixel's point is in the next frame, "
           "NaN where undefined, and 255 where it is visible there");
}

void define_scenario(py::module_& module) {
  py::class_<Scenario>(module, "Scenario",
                       "The frames of a simulated scenario, in order, computed "
                       "on demand. It can be iterated once.")
      .def(py::init([](const std::filesystem::path& scenario, std::optional<std::int64_t> seed,
                       const std::map<std::string, py::object>& set,
                       const std::optional<std::filesystem::path>& randomise,
                       const std::vector<std::string>& cameras,
                       const std::vector<std::string>& truth,
                       const std::optional<std::pair<std::int64_t, std::int64_t>>& frames,
                       std::int64_t every, int threads) {
             return open_scenario(
                 {scenario, seed, set, randomise, cameras, truth, frames, every, threads});
           }),
           py::arg("scenario"), py::kw_only(), py::arg("seed") = py::none(),
           py::arg("set") = py::dict(), py::arg("randomise") = py::none(),
           py::arg("cameras") = py::list(), py::arg("truth") = py::list(),
           py::arg("frames") = py::none(), py::arg("every") = 1, py::arg("threads") = 2)
      .def_property_readonly("name", [](const Scenario& s) { return s.stream->scenario().name; })
      .def_property_readonly("seed", [](const Scenario& s) { return s.stream->scenario().seed; })
      .def_property_readonly(
          "cameras", [](const Scenario& s) { return s.stream->rig().cameras; },
          "nominal, as given to a SLAM system")
      .def_property_readonly(
          "true_cameras", [](const Scenario& s) { return s.stream->true_rig().cameras; },
          "true, consistent with the truth images")
      .def("__len__", [](const Scenario& s) { return s.stream->size(); })
      .def("__iter__", [](const Scenario& s) { return s; })
      .def("__next__", &next_frame);
}

}  // namespace
}  // namespace vinebench

PYBIND11_MODULE(vinebench, module) {
  module.doc() = "Simulated drives through vineyards, frame by frame, with their truth.";
  module.attr("__version__") = vinebench::kVersion;
  module.attr("label_names") = vinebench::label_names();
  py::register_exception<vinebench::Error>(module, "Error", PyExc_RuntimeError);
  vinebench::set_warning_sink([](const std::string& text) {
    std::fprintf(stderr, "vinebench: warning: %s\n", text.c_str());
  });
  vinebench::define_camera(module);
  vinebench::define_frame(module);
  vinebench::define_scenario(module);
}

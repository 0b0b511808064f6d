// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "python/frames.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "core/util/error.h"
#include "harness/datasets/labels/label_table.h"
#include "harness/datasets/labels/mask_rle.h"

namespace vinebench::python {
namespace {

/// One array for each camera that delivered an image, by name.
template <class ImageOf>
py::dict by_camera(const std::vector<std::string>& names, const ImageOf& image_of) {
  py::dict arrays;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const cv::Mat* image = image_of(i);
    if (image != nullptr && !image->empty()) arrays[py::str(names[i])] = to_array(*image);
  }
  return arrays;
}

py::dict image_arrays(const std::vector<std::string>& names, const Frame& frame) {
  return by_camera(
      names, [&](std::size_t i) { return i < frame.images.size() ? &frame.images[i] : nullptr; });
}

py::dict truth_arrays(const TrueFrame& self, const cv::Mat RenderedImage::*part) {
  const std::vector<TruthView>& views = self.frame->truth.views;
  return by_camera(camera_names(self.source->rig()), [&](std::size_t i) {
    return i < views.size() ? &(views[i].image.*part) : nullptr;
  });
}

py::list things_of(const TrueFrame& self, const std::string& name) {
  const std::size_t camera = self.camera(name);
  harness::ImageLabels labels;
  {
    const py::gil_scoped_release others_may_run;
    labels = self.source->things(*self.frame, camera);
  }
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

py::tuple flow_to(const TrueFrame& self, const TrueFrame& next, const std::string& name) {
  const std::size_t camera = self.camera(name);
  FlowTruth truth;
  {
    const py::gil_scoped_release others_may_run;
    truth = self.source->flow(*self.frame, *next.frame, camera);
  }
  return py::make_tuple(to_array(truth.flow), to_array(truth.visible));
}

SensorFrame sensor_frame(Stamp stamp, const std::map<std::string, py::object>& images,
                         const py::object& imu, const py::object& wheels, std::int64_t index,
                         const std::map<std::string, Stamp>& image_stamps) {
  SensorFrame made;
  Frame frame;
  frame.index = index;
  frame.stamp = stamp;
  if (!is_in_range(stamp)) {
    throw py::value_error(fmt::format("stamp: expected ns within 146 years, found {}", stamp));
  }
  for (const auto& [name, image] : images) {
    made.cameras.push_back(name);
    frame.images.push_back(to_image(image, fmt::format("image of camera '{}'", name)));
  }
  for (const auto& [name, own] : image_stamps) {
    const auto camera = std::ranges::find(made.cameras, name);
    if (camera == made.cameras.end() || !is_in_range(own)) {
      throw py::value_error(
          fmt::format("image_stamps: '{}': expected ns of one of the images, found {}", name, own));
    }
    frame.image_stamps.resize(frame.images.size(), stamp);
    frame.image_stamps[static_cast<std::size_t>(camera - made.cameras.begin())] = own;
  }
  frame.imu = imu_of(to_rows(imu, 7, "imu"));
  frame.wheels = wheels_of(to_rows(wheels, 9, "wheels"));
  made.frame = std::make_shared<const Frame>(std::move(frame));
  return made;
}

void check_size(const RigCamera& camera, const cv::Mat& image) {
  const PinholeCamera& model = camera.model;
  if (image.empty() || (image.cols == model.width && image.rows == model.height)) return;
  throw py::value_error(fmt::format("image of camera '{}': expected {} x {} px, found {} x {}",
                                    camera.name, model.width, model.height, image.cols,
                                    image.rows));
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
          "lens",
          [](const RigCamera& c) {
            return yaml_names(c.model.lens)[static_cast<std::size_t>(c.model.lens)];
          },
          "'radial_tangential', 'equidistant' or 'double_sphere'.")
      .def_property_readonly(
          "distortion", [](const RigCamera& c) { return c.model.coefficients(); },
          "k1, k2, p1, p2 and, if it has one, k3; of a fisheye its lens' coefficients.")
      .def_property_readonly(
          "T_body_camera", [](const RigCamera& c) { return c.T_body_cam.matrix(); },
          "4 x 4, m: transforms points of the camera frame (x right, y down, z ahead) to "
          "the body frame (x forward, y left, z up)")
      .def("__repr__", [](const RigCamera& c) {
        return fmt::format("Camera('{}', {} x {} px)", c.name, c.model.width, c.model.height);
      });
}

void define_rig(py::module_& module) {
  py::class_<Rig>(module, "Rig", "Rigidly mounted cameras that are exposed at the same instant.")
      .def_static(
          "load",
          [](const std::filesystem::path& file) {
            const py::gil_scoped_release others_may_run;
            return load_rig(file);
          },
          py::arg("file"))
      .def_readonly("name", &Rig::name)
      .def_readonly("rate_hz", &Rig::rate_hz, "frames a second")
      .def_readonly("cameras", &Rig::cameras)
      .def_property_readonly(
          "stereo_pairs",
          [](const Rig& rig) {
            std::vector<std::pair<std::string, std::string>> pairs;
            for (const StereoPair& pair : rig.stereo_pairs) {
              pairs.emplace_back(rig.cameras.at(static_cast<std::size_t>(pair.left)).name,
                                 rig.cameras.at(static_cast<std::size_t>(pair.right)).name);
            }
            return pairs;
          },
          "names of the left and the right camera of each pair")
      .def_property_readonly(
          "tag_cameras",
          [](const Rig& rig) {
            std::vector<std::string> names;
            for (const int camera : rig.tag_cameras) {
              names.push_back(rig.cameras.at(static_cast<std::size_t>(camera)).name);
            }
            return names;
          },
          "names of the cameras in which AprilTags are detected")
      .def("__repr__", [](const Rig& rig) {
        return fmt::format("Rig('{}', {} cameras)", rig.name, rig.cameras.size());
      });
}

/// What frames with and without truth have in common.
template <class Class, class FrameOf>
void define_readings(Class& definition, const FrameOf& frame_of) {
  using Self = typename Class::type;
  definition
      .def_property_readonly(
          "index", [frame_of](const Self& f) { return frame_of(f).index; }, "in the run")
      .def_property_readonly(
          "stamp", [frame_of](const Self& f) { return frame_of(f).stamp; },
          "ns from the scenario's start, as stamped by the cameras")
      .def_property_readonly(
          "time", [frame_of](const Self& f) { return to_seconds(frame_of(f).stamp); },
          "the same in s")
      .def_property_readonly(
          "image_stamps",
          [frame_of](const Self& f) {
            const Frame& frame = frame_of(f);
            std::vector<Stamp> stamps;
            for (std::size_t i = 0; i < frame.images.size(); ++i) {
              stamps.push_back(frame.image_stamp(i));
            }
            return stamps;
          },
          "ns, of each camera's image: the frame's where they have no stamps of their own")
      .def_property_readonly(
          "imu", [frame_of](const Self& f) { return rows_of(frame_of(f).imu); },
          "(n, 7) since the previous frame: s, rad/s x y z, m/s^2 x y z")
      .def_property_readonly(
          "wheels", [frame_of](const Self& f) { return rows_of(frame_of(f).wheels); },
          "(n, 9) since the previous frame: s, rad of front left, front right, rear left, rear "
          "right, then rad/s of them");
}

void define_sensor_frame(py::module_& module) {
  py::class_<SensorFrame> sensors(module, "SensorFrame",
                                  "What a SLAM system is given of one instant: images, inertial "
                                  "and wheel readings, and no truth.");
  sensors
      .def(py::init(&sensor_frame), py::arg("stamp"), py::arg("images"), py::kw_only(),
           py::arg("imu") = py::none(), py::arg("wheels") = py::none(), py::arg("index") = 0,
           py::arg("image_stamps") = std::map<std::string, Stamp>(),
           "stamp in ns; images by camera name, uint8 (h, w) grey or (h, w, 3) RGB, None where a "
           "camera delivered none; imu (n, 7) and wheels (n, 9) since the previous frame. All is "
           "copied. image_stamps: ns by camera name, of images that were not taken at the stamp.")
      .def_property_readonly(
          "images", [](const SensorFrame& f) { return image_arrays(f.cameras, *f.frame); },
          "uint8 by camera name, (h, w, 3) RGB or (h, w) grey")
      .def("__repr__", [](const SensorFrame& f) {
        return fmt::format("SensorFrame({} s)", format_seconds(f.frame->stamp));
      });
  define_readings(sensors, [](const SensorFrame& f) -> const Frame& { return *f.frame; });
}

void define_true_frame(py::module_& module) {
  py::class_<TrueFrame> frame(module, "Frame",
                              "One instant: images and truth, each by camera "
                              "name.");
  frame
      .def_property_readonly(
          "number", [](const TrueFrame& f) { return f.frame->number; },
          "among the requested frames, from 0")
      .def_property_readonly(
          "T_world_body", [](const TrueFrame& f) { return f.frame->truth.T_world_body.matrix(); },
          "4 x 4, m: the true pose")
      .def_property_readonly(
          "images",
          [](const TrueFrame& f) {
            return image_arrays(camera_names(f.source->rig()), f.frame->frame);
          },
          "uint8, (h, w, 3) RGB, or (h, w) of a grey camera")
      .def_property_readonly(
          "depth", [](const TrueFrame& f) { return truth_arrays(f, &RenderedImage::depth); },
          "float32 (h, w), m along the optical axis; 0 for sky")
      .def_property_readonly(
          "labels", [](const TrueFrame& f) { return truth_arrays(f, &RenderedImage::labels); },
          "uint8 (h, w), indices into label_names")
      .def_property_readonly(
          "instances",
          [](const TrueFrame& f) { return truth_arrays(f, &RenderedImage::instances); },
          "int32 (h, w): 256 times the object's number, plus a vine's bunch in the low byte")
      .def_property_readonly(
          "normals", [](const TrueFrame& f) { return truth_arrays(f, &RenderedImage::normals); },
          "float32 (h, w, 3), unit, camera axes, towards the camera")
      .def_property_readonly("sensors", &TrueFrame::sensors,
                             "the same instant without truth, as a SLAM system is given it")
      .def("things", &things_of, py::arg("camera"),
           "list of dicts: category, number, box (x, y, width, height), mask (bool), visibility "
           "and truncation (0 to 1, or None)")
      .def("flow_to", &flow_to, py::arg("next"), py::arg("camera"),
           "(float32 (h, w, 2) px, uint8 (h, w)): where each pixel's point is in the next frame, "
           "NaN where undefined, and 255 where it is visible there")
      .def("__repr__", [](const TrueFrame& f) {
        return fmt::format("Frame({}, {} s)", f.frame->number,
                           format_seconds(f.frame->frame.stamp));
      });
  define_readings(frame, [](const TrueFrame& f) -> const Frame& { return f.frame->frame; });
}

}  // namespace

std::size_t TrueFrame::camera(const std::string& name) const {
  const Rig& rig = source->rig();
  const int index = rig.find_camera(name);
  if (index < 0) fail("rig '{}' has no camera named '{}'", rig.name, name);
  return static_cast<std::size_t>(index);
}

SensorFrame TrueFrame::sensors() const {
  return {camera_names(source->rig()), {frame, &frame->frame}};
}

std::vector<std::string> camera_names(const Rig& rig) {
  std::vector<std::string> names;
  for (const RigCamera& camera : rig.cameras) names.push_back(camera.name);
  return names;
}

Frame frame_for(const Rig& rig, const py::object& given) {
  if (!py::isinstance<SensorFrame>(given) && !py::isinstance<TrueFrame>(given)) {
    throw py::type_error(fmt::format("frame: expected a Frame or a SensorFrame, found {}",
                                     std::string(py::str(py::type::handle_of(given)))));
  }
  const SensorFrame sensors = py::isinstance<TrueFrame>(given) ? given.cast<TrueFrame>().sensors()
                                                               : given.cast<SensorFrame>();
  Frame frame = *sensors.frame;
  frame.images.assign(rig.cameras.size(), {});
  if (!frame.image_stamps.empty()) frame.image_stamps.assign(rig.cameras.size(), frame.stamp);
  for (std::size_t i = 0; i < sensors.cameras.size(); ++i) {
    const int camera = rig.find_camera(sensors.cameras[i]);
    if (camera < 0) {
      throw py::value_error(
          fmt::format("rig '{}' has no camera named '{}'", rig.name, sensors.cameras[i]));
    }
    const auto place = static_cast<std::size_t>(camera);
    frame.images[place] = sensors.frame->images.at(i);
    if (!frame.image_stamps.empty()) frame.image_stamps[place] = sensors.frame->image_stamps.at(i);
    check_size(rig.cameras[place], frame.images[place]);
  }
  return frame;
}

void define_frames(py::module_& module) {
  define_camera(module);
  define_rig(module);
  define_sensor_frame(module);
  define_true_frame(module);
}

}  // namespace vinebench::python

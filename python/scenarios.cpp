// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "python/scenarios.h"

#include <array>
#include <tuple>

#include "python/frames.h"
#include "python/requests.h"

namespace vinebench::python {
namespace {

using Overrides = std::map<std::string, py::object>;
using FilePath = std::filesystem::path;
using Triple = std::array<double, 3>;
using Interval = std::optional<std::pair<std::int64_t, std::int64_t>>;

Scenario open_scenario(const FilePath& scenario, std::optional<std::int64_t> seed,
                       const Overrides& set, const std::optional<FilePath>& randomise,
                       const std::vector<std::string>& cameras,
                       const std::vector<std::string>& truth, const Interval& frames,
                       std::int64_t every, int threads) {
  harness::StreamRequest request{
      frames_request(scenario, seed, set, randomise, cameras, truth, threads)};
  if (frames) std::tie(request.first, request.last) = *frames;
  request.every = every;
  const py::gil_scoped_release others_may_run;
  auto stream = std::make_shared<harness::FrameStream>(request);
  return {std::move(request), std::move(stream)};
}

TrueFrame next_frame(const Scenario& self) {
  std::shared_ptr<const harness::DatasetFrame> frame;
  {
    const py::gil_scoped_release others_may_run;
    frame = self.stream->next();
  }
  if (frame == nullptr) throw py::stop_iteration();
  return {self.stream, std::move(frame)};
}

Drive open_drive(const FilePath& scenario, std::optional<std::int64_t> seed, const Overrides& set,
                 const std::optional<FilePath>& randomise, const std::vector<std::string>& cameras,
                 const std::vector<std::string>& truth, int threads) {
  harness::FramesRequest request =
      frames_request(scenario, seed, set, randomise, cameras, truth, threads);
  const py::gil_scoped_release others_may_run;
  auto drive = std::make_shared<harness::CommandedDrive>(request);
  return {std::move(request), std::move(drive)};
}

Eigen::Vector3d to_vector(const Triple& numbers) {
  return Eigen::Vector3d::Map(numbers.data());
}

TrueFrame reset(const Drive& self, std::optional<std::int64_t> seed,
                const std::optional<Triple>& start) {
  const py::gil_scoped_release others_may_run;
  return {self.drive,
          self.drive->reset(seed, start ? std::optional(to_vector(*start)) : std::nullopt)};
}

std::optional<TrueFrame> step(const Drive& self, const Triple& twist) {
  const py::gil_scoped_release others_may_run;
  std::shared_ptr<const harness::DatasetFrame> frame = self.drive->step(to_vector(twist));
  if (frame == nullptr) return std::nullopt;
  return TrueFrame{self.drive, std::move(frame)};
}

Rows route_of(const Drive& self) {
  const std::vector<Eigen::Vector3d> points = self.drive->route();
  Rows rows(points.size(), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = points[i];
  }
  return rows;
}

}  // namespace

harness::FramesRequest frames_request(const FilePath& scenario, std::optional<std::int64_t> seed,
                                      const Overrides& set,
                                      const std::optional<FilePath>& randomise,
                                      const std::vector<std::string>& cameras,
                                      const std::vector<std::string>& truth, int threads) {
  harness::FramesRequest request;
  request.scenario = data_file(harness::DataKind::kScenario, scenario);
  request.overrides = overrides_of(set);
  if (randomise) {
    request.randomisation = data_file(harness::DataKind::kRandomisation, *randomise);
  }
  request.seed = seed;
  request.cameras = cameras;
  request.truth = truth;
  request.threads = threads;
  request.machine = machine();
  return request;
}

void define_scenario(py::module_& module) {
  py::class_<Scenario>(module, "Scenario",
                       "The frames of a simulated scenario, in order, computed "
                       "on demand. It can be iterated once.")
      .def(py::init(&open_scenario), py::arg("scenario"), py::kw_only(),
           py::arg("seed") = py::none(), py::arg("set") = py::dict(),
           py::arg("randomise") = py::none(), py::arg("cameras") = py::list(),
           py::arg("truth") = py::list(), py::arg("frames") = py::none(), py::arg("every") = 1,
           py::arg("threads") = 2)
      .def_property_readonly("name", [](const Scenario& s) { return s.stream->scenario().name; })
      .def_property_readonly("seed", [](const Scenario& s) { return s.stream->scenario().seed; })
      .def_property_readonly(
          "cameras", [](const Scenario& s) { return s.stream->rig().cameras; },
          "nominal, as given to a SLAM system")
      .def_property_readonly(
          "true_cameras", [](const Scenario& s) { return s.stream->true_rig().cameras; },
          "true, consistent with the truth images")
      .def_property_readonly(
          "rig", [](const Scenario& s) { return s.stream->rig(); },
          "nominal, as given to a SLAM system")
      .def("__len__", [](const Scenario& s) { return s.stream->size(); })
      .def("__iter__", [](const Scenario& s) { return s; })
      .def("__next__", &next_frame);
}

void define_drive(py::module_& module) {
  py::class_<Drive>(module, "Drive", "A scenario whose rover is driven by body twists.")
      .def(py::init(&open_drive), py::arg("scenario"), py::kw_only(), py::arg("seed") = py::none(),
           py::arg("set") = py::dict(), py::arg("randomise") = py::none(),
           py::arg("cameras") = py::list(), py::arg("truth") = py::list(), py::arg("threads") = 2)
      .def_property_readonly("name", [](const Drive& d) { return d.drive->scenario().name; })
      .def_property_readonly("seed", [](const Drive& d) { return d.drive->scenario().seed; })
      .def_property_readonly("rig", [](const Drive& d) { return d.drive->rig(); })
      .def_property_readonly("true_cameras",
                             [](const Drive& d) { return d.drive->true_rig().cameras; })
      .def_property_readonly("route", &route_of)
      .def_property_readonly("last_number", [](const Drive& d) { return d.drive->last_number(); })
      .def_property_readonly("collided", [](const Drive& d) { return d.drive->collided(); })
      .def("reset", &reset, py::arg("seed") = py::none(), py::arg("start") = py::none())
      .def("step", &step, py::arg("twist"));
}

}  // namespace vinebench::python

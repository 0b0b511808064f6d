// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/slam.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/config/yaml.h"
#include "core/files/files.h"
#include "core/files/output_folder.h"
#include "core/util/error.h"
#include "python/requests.h"
#include "python/scenarios.h"
#include "python/systems.h"

namespace vinebench::python {
namespace {

using Overrides = std::map<std::string, py::object>;

/// The built-in core with the threads that it works on.
class Slam {
 public:
  Slam(const slam::SlamConfig& config, Rig rig, std::vector<RegisteredTag> tags, int threads)
      : rig_(std::move(rig)),
        pool_(std::max(1, threads)),
        system_(slam::make_slam(config, rig_, std::move(tags), pool_)) {}

  const Rig& rig() const { return rig_; }

  py::dict process(const py::object& given) {
    expect_unfinished();
    const Frame frame = frame_for(rig_, given);
    if (last_ && frame.stamp <= *last_) {
      throw py::value_error(fmt::format("frame: expected a stamp after {} s, found {} s",
                                        format_seconds(*last_), format_seconds(frame.stamp)));
    }
    Estimate estimate;
    {
      const py::gil_scoped_release others_may_run;
      estimate = system_->process(frame);
    }
    last_ = frame.stamp;
    return dict_of(rig_, estimate);
  }

  py::dict finish() {
    expect_unfinished();
    finished_ = true;
    SlamSummary summary;
    {
      const py::gil_scoped_release others_may_run;
      summary = system_->finish();
    }
    return dict_of(summary);
  }

  slam::MappingSystem& system() { return *system_; }
  bool started() const { return last_.has_value(); }

 private:
  void expect_unfinished() const {
    if (finished_) fail("the SLAM system has finished: make another one");
  }

  Rig rig_;
  WorkerPool pool_;
  std::unique_ptr<slam::MappingSystem> system_;
  std::optional<Stamp> last_;
  bool finished_ = false;
};

/// Settings of the core from a dict of YAML values, strictly.
slam::SlamConfig config_of(const Overrides& settings) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "settings";
  write_file_atomically(file, "{}\n");
  YamlDocument document = YamlDocument::load(file);
  for (const auto& [key, value] : overrides_of(settings)) document.set(key, value);
  return document.read<slam::SlamConfig>();
}

std::unique_ptr<Slam> slam_of_rig(const Rig& rig, const Overrides& settings, int threads) {
  const slam::SlamConfig config = config_of(settings);
  const py::gil_scoped_release others_may_run;
  return std::make_unique<Slam>(config, rig, std::vector<RegisteredTag>(), threads);
}

/// Reads the scenario again, so that the settings are checked as if they stood in it.
std::unique_ptr<Slam> slam_of_request(harness::FramesRequest request, const Overrides& settings,
                                      int threads) {
  for (const auto& [key, value] : overrides_of(settings)) {
    request.overrides.emplace_back("slam." + key, value);
  }
  const py::gil_scoped_release others_may_run;
  const harness::ScenarioConfig scenario = scenario_of(request);
  if (!scenario.slam.is_core()) {
    fail("{}: slam: names another system, expected settings of the built-in core", scenario.name);
  }
  const harness::RecordingNotes notes = notes_of(scenario);
  return std::make_unique<Slam>(scenario.slam, notes.rig.make(), notes.tags, threads);
}

void load_map(Slam& self, const std::filesystem::path& file) {
  if (self.started()) fail("load_map: expected a call before the first frame");
  const py::gil_scoped_release others_may_run;
  self.system().load_map(file);
}

}  // namespace

void define_slam(py::module_& module) {
  py::class_<Slam>(module, "Slam", "The built-in SLAM core, frame by frame.")
      .def_static("of_rig", &slam_of_rig, py::arg("rig"), py::arg("settings"), py::arg("threads"))
      .def_static(
          "of_scenario",
          [](const Scenario& s, const Overrides& settings, int threads) {
            return slam_of_request(s.request, settings, threads);
          },
          py::arg("scenario"), py::arg("settings"), py::arg("threads"))
      .def_static(
          "of_drive",
          [](const Drive& d, const Overrides& settings, int threads) {
            return slam_of_request(d.request, settings, threads);
          },
          py::arg("drive"), py::arg("settings"), py::arg("threads"))
      .def_property_readonly("rig", &Slam::rig)
      .def("process", &Slam::process, py::arg("frame"))
      .def("finish", &Slam::finish)
      .def("load_map", &load_map, py::arg("file"))
      .def(
          "save_map",
          [](Slam& self, const std::filesystem::path& file) {
            const py::gil_scoped_release others_may_run;
            self.system().save_map(file);
          },
          py::arg("file"))
      .def(
          "save_cloud",
          [](Slam& self, const std::filesystem::path& file) {
            const py::gil_scoped_release others_may_run;
            self.system().save_cloud(file);
          },
          py::arg("file"));
}

}  // namespace vinebench::python

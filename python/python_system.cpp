// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "harness/run/system_failure.h"
#include "python/systems.h"

namespace vinebench::python {
namespace {

/// Calls Python; what it raises is the system's failure, but for ^C and the like.
template <class Call>
auto guarded(const Call& call) {
  const py::gil_scoped_acquire acquired;
  try {
    return call();
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_Exception)) throw;
    harness::fail_system("{}", std::string(py::str(error.value())));
  } catch (const py::cast_error& error) {
    harness::fail_system("{}", error.what());
  } catch (const py::builtin_exception& error) {
    harness::fail_system("{}", error.what());
  }
}

std::optional<LoopClosure> closure_of(const py::object& given) {
  if (given.is_none()) return std::nullopt;
  LoopClosure closure;
  closure.tag_id = given["tag_id"].cast<int>();
  closure.earlier = given["earlier"].cast<Stamp>();
  closure.later = given["later"].cast<Stamp>();
  closure.T_earlier_later = pose_of(given["T_earlier_later"], "loop_closure.T_earlier_later");
  closure.correction = given["correction"].cast<double>();
  return closure;
}

py::dict setup_of(const harness::SystemSetup& setup) {
  py::list tags;
  for (const RegisteredTag& tag : setup.tags) {
    py::dict entry;
    entry["family"] = tag.family;
    entry["id"] = tag.id;
    entry["size"] = tag.size;
    entry["T_world_tag"] = tag.T_world_tag.matrix();
    tags.append(entry);
  }
  py::dict given;
  given["rig"] = setup.rig;
  given["tags"] = tags;
  given["wheels"] = setup.wheels
                        ? py::object(py::make_tuple(setup.wheels->radius, setup.wheels->half_track,
                                                    setup.wheels->half_wheelbase))
                        : py::object(py::none());
  given["threads"] = setup.threads;
  return given;
}

class PythonSystem : public SlamSystem {
 public:
  PythonSystem(py::object adapter, Rig rig)
      : adapter_(std::move(adapter)), rig_(std::move(rig)), names_(camera_names(rig_)) {
    stage_ = adapter_.attr("name").cast<std::string>();
  }
  ~PythonSystem() override {
    const py::gil_scoped_acquire acquired;
    adapter_ = py::object();
  }
  PythonSystem(const PythonSystem&) = delete;
  PythonSystem& operator=(const PythonSystem&) = delete;

  Estimate process(const Frame& frame) override {
    const ScopedTimer timer(times_, stage_);
    return guarded([&] {
      const SensorFrame given{names_, std::make_shared<const Frame>(frame)};
      return estimate_of(frame.stamp, adapter_.attr("process")(given));
    });
  }

  SlamSummary finish() override {
    return guarded([&] {
      const py::object answer = adapter_.attr("finish")();
      SlamSummary summary;
      summary.trajectory =
          trajectory_of(to_rows(answer["trajectory"], 8, "finish: trajectory"), "trajectory");
      summary.keyframes =
          trajectory_of(to_rows(answer["keyframes"], 8, "finish: keyframes"), "keyframes");
      summary.landmarks = answer["landmarks"].cast<std::size_t>();
      if (!answer["T_world_map"].is_none()) {
        summary.T_world_map = pose_of(answer["T_world_map"], "finish: T_world_map");
      }
      return summary;
    });
  }

  const StageTimes& times() const override { return times_; }

 private:
  Estimate estimate_of(Stamp stamp, const py::object& answer) const {
    Estimate estimate;
    estimate.stamp = stamp;
    estimate.status = static_cast<TrackingStatus>(answer["status"].cast<int>());
    const py::object pose = answer["T_map_body"];
    if (!pose.is_none()) estimate.T_map_body = pose_of(pose, "process: T_map_body");
    const Rows covariance = to_rows(answer["covariance"], 6, "process: covariance");
    if (covariance.rows() == 6) estimate.covariance = covariance;
    const py::object counts = answer["cameras"];
    for (const std::string& name : names_) {
      CameraCounts& c = estimate.cameras.emplace_back();
      if (!counts.contains(name)) continue;
      std::tie(c.features, c.stereo, c.matches, c.inliers) =
          counts[py::str(name)].cast<std::tuple<int, int, int, int>>();
    }
    const py::object world = answer["T_world_map"];
    if (!world.is_none()) estimate.T_world_map = pose_of(world, "process: T_world_map");
    estimate.keyframe = answer["keyframe"].cast<bool>();
    estimate.loop_closure = closure_of(answer["loop_closure"]);
    return estimate;
  }

  py::object adapter_;
  Rig rig_;
  std::vector<std::string> names_;
  std::string stage_;
  StageTimes times_;
};

}  // namespace

std::unique_ptr<SlamSystem> make_python_system(const py::object& adapter,
                                               const harness::SystemSetup& setup) {
  return guarded([&] {
    adapter.attr("start")(setup_of(setup));
    return std::make_unique<PythonSystem>(adapter, setup.rig);
  });
}

}  // namespace vinebench::python

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/evaluation.h"

#include "core/geometry/angle.h"
#include "core/util/error.h"
#include "python/systems.h"

namespace vinebench::python {
namespace {

/// Rows, or the name of a TUM file.
Trajectory given_trajectory(const py::object& given, const std::string& what) {
  if (py::isinstance<py::array>(given)) return trajectory_of(to_rows(given, 8, what), what);
  const auto file = given.cast<std::filesystem::path>();
  const py::gil_scoped_release others_may_run;
  return read_tum(file);
}

py::tuple statistics(const harness::ErrorStatistics& errors) {
  return py::make_tuple(errors.rmse, errors.mean, errors.median, errors.max);
}

py::dict evaluate(const py::object& truth, const py::object& estimate) {
  const Trajectory true_poses = given_trajectory(truth, "truth");
  const Trajectory poses = given_trajectory(estimate, "estimate");
  std::optional<harness::Evaluation> evaluation;
  {
    const py::gil_scoped_release others_may_run;
    evaluation = harness::evaluate(true_poses, poses);
  }
  if (!evaluation) {
    fail("estimate: fewer than three of its {} poses are within 0.01 s of one of the truth",
         poses.size());
  }
  const auto degrees = [](double radians) { return radians / kRadiansPerDegree; };
  py::dict result;
  result["poses"] = evaluation->pairs;
  result["T_world_map"] = evaluation->T_world_map.matrix();
  result["ate"] = statistics(evaluation->ate);
  result["ate_origin"] = statistics(evaluation->origin);
  result["rpe_trans_percent"] = evaluation->rpe_trans_percent;
  result["heading_rmse_deg"] = degrees(evaluation->orientation.heading.rmse);
  result["heading_max_deg"] = degrees(evaluation->orientation.heading.max);
  result["tilt_rmse_deg"] = degrees(evaluation->orientation.tilt.rmse);
  result["tilt_max_deg"] = degrees(evaluation->orientation.tilt.max);
  result["worst_error_m"] = evaluation->worst.error;
  result["worst_time_s"] = to_seconds(evaluation->worst.stamp);
  return result;
}

}  // namespace

void define_evaluation(py::module_& module) {
  module.def("evaluate", &evaluate, py::arg("truth"), py::arg("estimate"));
  module.def(
      "read_tum", [](const std::filesystem::path& file) { return rows_of(read_tum(file)); },
      py::arg("file"));
  module.def(
      "write_tum",
      [](const std::filesystem::path& file, const py::object& trajectory) {
        write_tum(trajectory_of(to_rows(trajectory, 8, "trajectory"), "trajectory"), file);
      },
      py::arg("file"), py::arg("trajectory"));
}

}  // namespace vinebench::python

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
//
// `vinebench._core`, the compiled part of `import vinebench`. docs/python.md is for its users.
#include <cstdio>
#include <string>

#include "core/truth/labels.h"
#include "core/util/arithmetic.h"
#include "core/util/error.h"
#include "core/util/pin_arithmetic.h"
#include "core/util/warning.h"
#include "python/frames.h"
#include "python/requests.h"
#include "python/scenarios.h"
#include "python/systems.h"
#include "vinebench/version.h"

namespace vinebench::python {
namespace {

py::dict label_names() {
  py::dict names;
  for (std::size_t i = 0; i < kLabels; ++i) names[py::int_(i)] = name_of(static_cast<Label>(i));
  return names;
}

void define_data(py::module_& module) {
  module.def("scenario_names", [] { return data_names(harness::DataKind::kScenario); });
  module.def("scenario_file", [](const std::filesystem::path& text) {
    return data_file(harness::DataKind::kScenario, text);
  });
  module.def("rig_file", [](const std::filesystem::path& text) {
    return data_file(harness::DataKind::kRig, text);
  });
}

}  // namespace
}  // namespace vinebench::python

PYBIND11_MODULE(_core, module) {
  namespace py = pybind11;
  using namespace vinebench;
  module.doc() = "The compiled part of vinebench.";
  module.attr("__version__") = kVersion;
  module.attr("label_names") = python::label_names();
  auto error = py::register_exception<Error>(module, "Error", PyExc_RuntimeError);
  error.attr("__module__") = "vinebench";
  error.attr("__doc__") =
      "Bad input or a failing environment: what is wrong, where, and what was expected.";
  module.def("pin_arithmetic", [](bool libraries) {
    pin_arithmetic();
    if (libraries) declare_libraries_pinned();
  });
  module.def("arithmetic", &arithmetic_of_process);
  set_warning_sink([](const std::string& text) {
    std::fprintf(stderr, "vinebench: warning: %s\n", text.c_str());
  });
  python::define_frames(module);
  python::define_scenario(module);
  python::define_drive(module);
  python::define_slam(module);
  python::define_ros_messages(module);
  python::define_runs(module);
  python::define_evaluation(module);
  python::define_data(module);
}

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "python/requests.h"

#include <dlfcn.h>

#include "harness/systems/plugin_process.h"

namespace vinebench::python {
namespace {

namespace fs = std::filesystem;

/// Where the program is that this module came with: two folders up in a build tree, in the prefix's
/// bin where it is installed among the packages of lib/python3.N, in the package itself in a wheel.
std::vector<fs::path> programs() {
  Dl_info own{};
  if (dladdr(reinterpret_cast<const void*>(&programs), &own) == 0) return {};
  std::error_code error;
  const fs::path folder = fs::canonical(own.dli_fname, error).parent_path();
  return {folder / "bin/vinebench", folder / "../../vinebench",
          folder / "../../../../bin/vinebench"};
}

const harness::Catalogue& catalogue() {
  static const harness::Catalogue known = [] {
    std::vector<fs::path> folders{"."};
    for (const fs::path& program : programs()) {
      for (const fs::path& folder : harness::program_data_folders(program)) {
        folders.push_back(folder);
      }
    }
    return harness::Catalogue(folders);
  }();
  return known;
}

/// As a warning of Python.
void warn_in_python(const std::string& text) {
  const py::gil_scoped_acquire acquired;
  if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

/// JSON is YAML; a text is as it stands, so that "[1, 2]" and "null" mean what they do in a file.
std::string yaml_of(const py::object& value) {
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  const bool nested = py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value) ||
                      py::isinstance<py::dict>(value) || value.is_none();
  if (!nested) return py::str(value);
  return py::module_::import("json").attr("dumps")(value).cast<std::string>();
}

}  // namespace

std::vector<Override> overrides_of(const std::map<std::string, py::object>& set) {
  std::vector<Override> overrides;
  for (const auto& [key, value] : set) overrides.emplace_back(key, yaml_of(value));
  return overrides;
}

harness::Machine machine() {
  harness::Machine machine = harness::machine_of_environment();
  machine.plant_cache.notice = warn_in_python;
  for (const fs::path& program : programs()) {
    if (machine.plugin_host.empty()) machine.plugin_host = harness::find_plugin_host(program);
  }
  return machine;
}

fs::path data_file(harness::DataKind kind, const fs::path& text) {
  return catalogue().find(kind, text.string());
}

std::vector<std::string> data_names(harness::DataKind kind) {
  std::vector<std::string> names;
  for (const harness::DataEntry& entry : catalogue().list(kind)) names.push_back(entry.name);
  return names;
}

}  // namespace vinebench::python

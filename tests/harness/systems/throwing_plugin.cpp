// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
//
// A SLAM system that lets exceptions cross the interface, for plugin_slam_test: in create if it has
// settings, else in process.
#include <stdexcept>

#include "core/slam_plugin.h"

namespace {

void* create(const vinebench_setup* setup, vinebench_message) {
  static int system = 0;
  if (*setup->settings != '\0') throw std::invalid_argument("no such vocabulary");
  return &system;
}

int process(void*, const vinebench_frame*, vinebench_estimate*, vinebench_message) {
  throw std::runtime_error("matrix is singular");
}

int finish(void*, vinebench_summary*, vinebench_message) {
  throw 3;
}

void destroy(void*) {}

}  // namespace

extern "C" const vinebench_slam_functions* vinebench_slam() {
  static const vinebench_slam_functions functions = {
      VINEBENCH_SLAM_PLUGIN_VERSION, "throwing", create, process, finish, destroy};
  return &functions;
}

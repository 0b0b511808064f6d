// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
//
// The process of a plug-in. It links nothing of the bench, so that the plug-in's libraries may be
// of other versions than the bench's.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <string>

#include "harness/systems/host/plugin_host.h"

int main(int argc, char** argv) {
  if (argc != 2 || std::to_string(getppid()) != argv[1]) {
    fmt::print(stderr, "vinebench_plugin_host: is started by vinebench\n");
    return 2;
  }
  try {
    vinebench::harness::serve_plugin(vinebench::harness::kHostSocket,
                                     vinebench::harness::kHostMemory);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "vinebench_plugin_host: {}\n", error.what());
    return 1;
  }
}

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <signal.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace vinebench::test {

/// Whether it comes true in time.
template <class Condition>
bool comes(const Condition& condition, std::chrono::milliseconds longest) {
  const auto end = std::chrono::steady_clock::now() + longest;
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

/// Whether a process exists and has not ended; one that nobody has waited for yet ("Z") has.
inline bool is_running(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(in, text);
  const std::size_t name_end = text.rfind(')');
  return name_end != std::string::npos && text.compare(name_end, 3, ") Z") != 0;
}

/// The processes that a file lists, separated by blanks or lines.
inline std::vector<pid_t> processes_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<pid_t> processes;
  for (pid_t process = 0; in >> process;) processes.push_back(process);
  return processes;
}

/// Runs a function in a forked process, kills that with SIGKILL once the file lists `count`
/// processes, and returns them.
template <class Function>
std::vector<pid_t> kill_when_listed(const std::filesystem::path& file, std::size_t count,
                                    const Function& function) {
  const pid_t bench = fork();
  if (bench == 0) {
    function();
    _exit(0);
  }
  comes([&] { return processes_in(file).size() == count; }, std::chrono::seconds(20));
  kill(bench, SIGKILL);
  waitpid(bench, nullptr, 0);
  return processes_in(file);
}

/// Whether all of them have ended within two seconds.
inline bool end_soon(const std::vector<pid_t>& processes) {
  const auto ended = [&] {
    for (const pid_t process : processes) {
      if (is_running(process)) return false;
    }
    return true;
  };
  return comes(ended, std::chrono::seconds(2));
}

}  // namespace vinebench::test

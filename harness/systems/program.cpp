// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "core/util/error.h"
#include "core/util/files.h"
#include "core/util/input_file.h"
#include "core/util/output_file.h"

namespace vinebench::harness {
namespace {

constexpr std::chrono::milliseconds kLook{20};

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// This process' environment without the variables that are replaced.
std::vector<std::string> environment_of(const Program& program) {
  std::vector<std::string> entries;
  for (char** entry = environ; *entry != nullptr; ++entry) entries.emplace_back(*entry);
  for (const auto& [name, value] : program.environment) {
    const std::string assignment = name + "=";
    std::erase_if(entries, [&](const std::string& e) { return e.starts_with(assignment); });
    entries.push_back(assignment + value);
  }
  return entries;
}

/// Resources for spawning, released at the end.
class SpawnSettings {
 public:
  explicit SpawnSettings(const Program& program) : log_(create_file(program.log)) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, log_.number(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    posix_spawn_file_actions_addchdir_np(&actions_, program.folder.c_str());
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&attributes_, 0);
    sigset_t defaults;
    sigfillset(&defaults);
    posix_spawnattr_setsigdefault(&attributes_, &defaults);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  pid_t spawn(const Program& program) const {
    std::vector<std::string> words{program.file.string()};
    words.insert(words.end(), program.arguments.begin(), program.arguments.end());
    std::vector<std::string> entries = environment_of(program);
    pid_t process = 0;
    const int error = posix_spawn(&process, program.file.c_str(), &actions_, &attributes_,
                                  pointers_to(words).data(), pointers_to(entries).data());
    if (error != 0) fail("{}: cannot be started: {}", program.file.string(), std::strerror(error));
    return process;
  }

 private:
  Descriptor log_;
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

std::string last_line_of(const std::filesystem::path& log) {
  std::string last;
  try {
    InputStream in(log, FileKind::kPart);
    for (std::string line; std::getline(in, line);) {
      if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    }
  } catch (const Error&) {  // what the program failed of says more
    return fmt::format("; its messages are in {}", log.string());
  }
  return last.empty() ? "; it printed nothing"
                      : fmt::format("; its last line in {}: {}", log.string(), last);
}

void kill_group(pid_t process) {
  kill(-process, SIGKILL);
  while (waitpid(process, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace

bool run_program(const Program& program) {
  const auto start = std::chrono::steady_clock::now();
  const pid_t process = SpawnSettings(program).spawn(program);
  int status = 0;
  for (;;) {
    const pid_t ended = waitpid(process, &status, WNOHANG);
    if (ended == process) break;
    if (ended < 0 && errno != EINTR) fail("{}: {}", program.file.string(), std::strerror(errno));
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    const bool stopped = program.stopped && program.stopped();
    if (stopped || spent.count() > program.timeout) {
      kill_group(process);
      if (stopped) return false;
      fail("{}: took more than {} s{}", program.file.string(), program.timeout,
           last_line_of(program.log));
    }
    std::this_thread::sleep_for(kLook);
  }
  if (WIFSIGNALED(status)) {
    fail("{}: ended by signal {}{}", program.file.string(), WTERMSIG(status),
         last_line_of(program.log));
  }
  if (WEXITSTATUS(status) != 0) {
    fail("{}: exit code {}{}", program.file.string(), WEXITSTATUS(status),
         last_line_of(program.log));
  }
  return true;
}

}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/spawn.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "core/files/output_file.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr int kFirstDescriptor = 3;

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// This process' environment without the variables that are replaced.
std::vector<std::string> environment_of(const ProcessStart& start) {
  std::vector<std::string> entries;
  for (char** entry = environ; *entry != nullptr; ++entry) entries.emplace_back(*entry);
  for (const auto& [name, value] : start.environment) {
    const std::string assignment = name + "=";
    std::erase_if(entries, [&](const std::string& e) { return e.starts_with(assignment); });
    entries.push_back(assignment + value);
  }
  return entries;
}

/// Resources for spawning, released at the end.
class SpawnSettings {
 public:
  SpawnSettings(const ProcessStart& start, pid_t group) {
    posix_spawn_file_actions_init(&actions_);
    set_files(start);
    if (!start.folder.empty()) {
      posix_spawn_file_actions_addchdir_np(&actions_, start.folder.c_str());
    }
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setpgroup(&attributes_, group);
    sigset_t signals;
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    if (!start.blocks_signals) sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  pid_t spawn(const ProcessStart& start) const {
    std::vector<std::string> words{start.file.string()};
    words.insert(words.end(), start.arguments.begin(), start.arguments.end());
    std::vector<std::string> entries = environment_of(start);
    pid_t process = 0;
    const int error = posix_spawn(&process, start.file.c_str(), &actions_, &attributes_,
                                  pointers_to(words).data(), pointers_to(entries).data());
    if (error != 0) fail("{}: cannot be started: {}", start.file.string(), std::strerror(error));
    return process;
  }

 private:
  void set_files(const ProcessStart& start) {
    if (start.input >= 0) {
      posix_spawn_file_actions_adddup2(&actions_, start.input, STDIN_FILENO);
    } else {
      posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    }
    if (start.log.empty()) {
      posix_spawn_file_actions_adddup2(&actions_, STDERR_FILENO, STDOUT_FILENO);
    } else {
      log_ = create_file(start.log);
      posix_spawn_file_actions_adddup2(&actions_, log_.number(), STDOUT_FILENO);
      posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    }
    // First above all of them, so that none replaces another one that is still to come.
    const int count = static_cast<int>(start.descriptors.size());
    int above = kFirstDescriptor + count;
    for (const int descriptor : start.descriptors) above = std::max(above, descriptor + 1);
    for (int i = 0; i < count; ++i) {
      posix_spawn_file_actions_adddup2(&actions_, start.descriptors[static_cast<std::size_t>(i)],
                                       above + i);
    }
    for (int i = 0; i < count; ++i) {
      posix_spawn_file_actions_adddup2(&actions_, above + i, kFirstDescriptor + i);
    }
    posix_spawn_file_actions_addclosefrom_np(&actions_, kFirstDescriptor + count);
  }

  Descriptor log_;
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

pid_t spawn_process(const ProcessStart& start, pid_t group) {
  return SpawnSettings(start, group).spawn(start);
}

}  // namespace vinebench::harness

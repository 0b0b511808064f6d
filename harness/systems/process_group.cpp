// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/process_group.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

#include "core/files/input_file.h"
#include "core/files/output_file.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr std::chrono::milliseconds kLookForEnd{2};
constexpr std::chrono::milliseconds kLookAtMemory{100};
constexpr int kFirstDescriptor = 3;
constexpr int kDeepestScript = 4;  // a script's interpreter may be a script, as for the kernel

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
  explicit SpawnSettings(const ProcessStart& start) {
    posix_spawn_file_actions_init(&actions_);
    set_files(start);
    if (!start.folder.empty()) {
      posix_spawn_file_actions_addchdir_np(&actions_, start.folder.c_str());
    }
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setpgroup(&attributes_, 0);
    sigset_t signals;
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    sigemptyset(&signals);
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
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
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

/// What comes after the name in /proc/PID/stat, which may have blanks and brackets: state, parent,
/// group and so on. Empty where the process is gone.
std::vector<std::string> stat_fields(const std::filesystem::path& process) {
  std::ifstream in(process / "stat");
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return {};
  std::istringstream rest(text.substr(name_end + 1));
  return {std::istream_iterator<std::string>(rest), std::istream_iterator<std::string>()};
}

/// Sum of the resident memory of a group's processes, MiB.
double resident_mib(pid_t group) {
  constexpr std::size_t kGroupField = 2, kResidentField = 21;  // after the name; see proc(5)
  double pages = 0;
  std::error_code error;
  std::filesystem::directory_iterator entry("/proc", error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.empty() || name.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::vector<std::string> fields = stat_fields(entry->path());
    if (fields.size() <= kResidentField || fields[kGroupField] != std::to_string(group)) continue;
    pages += std::strtod(fields[kResidentField].c_str(), nullptr);
  }
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// The file that "#!" names in a script's first line.
std::filesystem::path interpreter_of(const std::string& line) {
  std::istringstream words(line.substr(2));
  std::string interpreter;
  words >> interpreter;
  return interpreter;
}

void check_program(const std::filesystem::path& file, const std::filesystem::path& script,
                   int depth) {
  const std::string name =
      script.empty() ? file.string()
                     : fmt::format("{}: its interpreter {}", script.string(), file.string());
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) fail("{}: cannot be started: no such file", name);
  if (!std::filesystem::is_regular_file(file, ignored)) {
    fail("{}: cannot be started: is no file", name);
  }
  if (access(file.c_str(), X_OK) != 0) {
    fail("{}: cannot be started: {}", name, std::strerror(errno));
  }
  if (access(file.c_str(), R_OK) != 0) return;  // a program may be executed though not read
  std::string line(256, '\0');                  // as much as the kernel reads
  line.resize(InputFile(file, FileKind::kOther).read(line.data(), line.size()));
  if (line.starts_with("\177ELF")) return;
  if (!line.starts_with("#!") || depth == kDeepestScript) {
    fail(
        "{}: cannot be started: expected a program, or a script whose first line is #! and an "
        "interpreter",
        name);
  }
  check_program(interpreter_of(line.substr(0, line.find('\n'))), script.empty() ? file : script,
                depth + 1);
}

}  // namespace

void check_executable(const std::filesystem::path& file) {
  check_program(file, {}, 0);
}

ProcessGroup::ProcessGroup(const ProcessStart& start)
    : process_(SpawnSettings(start).spawn(start)) {}

bool ProcessGroup::has_ended() {
  if (ended_) return true;
  siginfo_t end{};
  const int found = waitid(P_PID, static_cast<id_t>(process_), &end, WEXITED | WNOHANG | WNOWAIT);
  if (found == 0 && end.si_pid == process_) kill();
  if (found != 0 && errno == ECHILD) ended_ = true;  // SIGCHLD is ignored: nobody knows how
  return ended_;
}

bool ProcessGroup::wait(std::chrono::milliseconds longest) {
  const auto end = std::chrono::steady_clock::now() + longest;
  while (!has_ended()) {
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(kLookForEnd);
  }
  return true;
}

std::string ProcessGroup::how_it_ended() const {
  if (!WIFSIGNALED(status_)) return fmt::format("exit code {}", WEXITSTATUS(status_));
  const char* description = sigdescr_np(WTERMSIG(status_));
  return fmt::format("ended by signal {} ({})", WTERMSIG(status_),
                     description == nullptr ? "unknown" : description);
}

bool ProcessGroup::succeeded() const {
  return ended_ && WIFEXITED(status_) && WEXITSTATUS(status_) == 0;
}

bool ProcessGroup::exceeds_memory(double limit_mib) {
  const auto now = std::chrono::steady_clock::now();
  if (now - looked_ < kLookAtMemory) return false;
  looked_ = now;
  return resident_mib(process_) > limit_mib;
}

/// The group's number is its own until its first process has been waited for.
void ProcessGroup::kill() {
  if (ended_) return;
  ::kill(-process_, SIGKILL);
  while (!ended_) {
    ended_ = waitpid(process_, &status_, 0) == process_ || errno != EINTR;
  }
}

}  // namespace vinebench::harness

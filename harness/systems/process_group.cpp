// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/process_group.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

#include "core/files/input_file.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr std::chrono::milliseconds kLookForEnd{2};
constexpr std::chrono::milliseconds kLookAtMemory{100};
constexpr int kDeepestScript = 4;  // a script's interpreter may be a script, as for the kernel

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

/// Sum of the resident memory of a group's processes but its first one, the watcher, MiB.
double resident_mib(pid_t group) {
  constexpr std::size_t kGroupField = 2, kResidentField = 21;  // after the name; see proc(5)
  double pages = 0;
  std::error_code error;
  std::filesystem::directory_iterator entry("/proc", error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.empty() || name.find_first_not_of("0123456789") != std::string::npos) continue;
    if (name == std::to_string(group)) continue;
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
    : process_(spawn_process(start, watcher_.group())) {}

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
  return resident_mib(watcher_.group()) > limit_mib;
}

void ProcessGroup::kill() {
  if (ended_) return;
  watcher_.kill_group();
  while (!ended_) {
    ended_ = waitpid(process_, &status_, 0) == process_ || errno != EINTR;
  }
}

}  // namespace vinebench::harness

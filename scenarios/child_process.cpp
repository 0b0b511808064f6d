// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "scenarios/child_process.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "slam/base/error.h"

namespace vinebench {
namespace {

constexpr int kJobFailed = 2;

[[noreturn]] void fail_by_system(const std::string& what) {
  fail("{}: {}", what, std::generic_category().message(errno));
}

void write_all(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = write(descriptor, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) _exit(1);
    done += static_cast<std::size_t>(count);
  }
}

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t count = read(descriptor, part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(part.data(), static_cast<std::size_t>(count));
  }
}

/// Leaves without the parent's clean-up.
[[noreturn]] void be_the_child(int descriptor, const std::function<std::string()>& job) {
  int code = 0;
  std::string text;
  try {
    text = job();
  } catch (const std::exception& error) {
    code = kJobFailed;
    text = error.what();
  }
  write_all(descriptor, text);
  _exit(code);
}

}  // namespace

std::string run_in_child(const std::string& what, const std::function<std::string()>& job) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) fail_by_system(what);
  std::fflush(nullptr);  // else the child might write it a second time
  const pid_t child = fork();
  if (child < 0) fail_by_system(what);
  if (child == 0) {
    close(ends[0]);
    be_the_child(ends[1], job);
  }
  close(ends[1]);
  std::string text = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) fail("{}: the process ended by signal {}", what, WTERMSIG(status));
  if (WEXITSTATUS(status) == kJobFailed) fail("{}", text);
  if (WEXITSTATUS(status) != 0) fail("{}: exit code {}", what, WEXITSTATUS(status));
  return text;
}

}  // namespace vinebench

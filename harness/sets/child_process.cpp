// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/child_process.h"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <map>
#include <system_error>
#include <vector>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr int kJobFailed = 2;
constexpr int kLookForStop = 200;  // ms

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

/// Ends this process when its parent ends, however that is. What a killed process leaves behind is
/// whole: files get their names when they are.
void end_with(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it ended before prctl
}

/// Exits without the parent's clean-up.
[[noreturn]] void be_the_child(pid_t parent, int descriptor,
                               const std::function<std::string()>& job) {
  end_with(parent);
  int code = 0;
  std::string text;
  try {
    text = job();
  } catch (const std::exception& error) {
    code = kJobFailed;
    text = error.what();
  }
  std::fflush(nullptr);
  write_all(descriptor, text);
  _exit(code);
}

/// A forked process and the pipe for its text.
class Child {
 public:
  Child(std::string what, const std::function<std::string()>& job) : what_(std::move(what)) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) fail_by_system(what_);
    std::fflush(nullptr);  // otherwise the child might write it again
    const pid_t parent = getpid();
    process_ = fork();
    if (process_ < 0) fail_by_system(what_);
    if (process_ == 0) {
      close(ends[0]);
      be_the_child(parent, ends[1], job);
    }
    close(ends[1]);
    descriptor_ = ends[0];
  }

  /// Waits for more text; false at the end.
  bool read_part() {
    std::array<char, 4096> part{};
    for (;;) {
      const ssize_t count = read(descriptor_, part.data(), part.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      text_.append(part.data(), static_cast<std::size_t>(count));
      return true;
    }
  }

  /// Call after the end of the text.
  ChildOutcome wait() {
    close(descriptor_);
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFSIGNALED(status)) {
      return {false, fmt::format("{}: the process ended by signal {}", what_, WTERMSIG(status))};
    }
    const int code = WEXITSTATUS(status);
    if (code == 0 || code == kJobFailed) return {code == 0, std::move(text_)};
    return {false, fmt::format("{}: exit code {}", what_, code)};
  }

  int descriptor() const { return descriptor_; }
  void terminate() const { kill(process_, SIGTERM); }

 private:
  std::string what_;
  pid_t process_ = 0;
  int descriptor_ = 0;
  std::string text_;
};

/// The running jobs.
class RunningJobs {
 public:
  explicit RunningJobs(const ChildJobs& jobs) : jobs_(jobs) {}

  void run() {
    for (;;) {
      if (!terminated_ && jobs_.stopped && jobs_.stopped()) terminate();
      while (!terminated_ && next_ < jobs_.count &&
             running_.size() < static_cast<std::size_t>(jobs_.at_once)) {
        start(next_++);
      }
      if (running_.empty()) return;
      wait_for_news();
    }
  }

 private:
  void start(std::size_t index) {
    running_.emplace(index, Child(jobs_.name(index), [this, index] {
                       setpgid(0, 0);
                       return jobs_.job(index);
                     }));
  }

  void terminate() {
    terminated_ = true;
    for (const auto& [index, child] : running_) child.terminate();
  }

  void wait_for_news() {
    std::vector<pollfd> polls;
    std::vector<std::size_t> indices;
    for (const auto& [index, child] : running_) {
      polls.push_back({child.descriptor(), POLLIN, 0});
      indices.push_back(index);
    }
    if (poll(polls.data(), polls.size(), kLookForStop) <= 0) return;
    for (std::size_t i = 0; i < polls.size(); ++i) {
      if (polls[i].revents == 0 || running_.at(indices[i]).read_part()) continue;
      const ChildOutcome outcome = running_.at(indices[i]).wait();
      running_.erase(indices[i]);
      jobs_.done(indices[i], outcome);
    }
  }

  const ChildJobs& jobs_;
  std::map<std::size_t, Child> running_;
  std::size_t next_ = 0;
  bool terminated_ = false;
};

}  // namespace

std::string run_in_child(const std::string& what, const std::function<std::string()>& job) {
  Child child(what, job);
  while (child.read_part()) {
  }
  const ChildOutcome outcome = child.wait();
  if (!outcome.ok) fail("{}", outcome.text);
  return outcome.text;
}

void run_in_children(const ChildJobs& jobs) {
  RunningJobs(jobs).run();
}

}  // namespace vinebench::harness

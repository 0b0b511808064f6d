// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/plugin_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "core/files/files.h"
#include "harness/report/report_json.h"
#include "harness/run.h"
#include "harness/systems/plugin_slam.h"
#include "tests/support/fakes.h"
#include "tests/support/plugins.h"
#include "tests/support/processes.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::int64_t kFakeFrames = 21;

class PluginProcessTest : public testing::Test {
 protected:
  PluginProcessTest() {
    config_.library = test::beside_test("fake_plugin.so");
    config_.frame_timeout = config_.timeout = 30;  // s: only a hang takes that long
  }

  std::unique_ptr<SlamSystem> load(const std::string& settings) {
    if (!settings.empty()) config_.settings = settings;
    return load_plugin_slam(config_, test::fake_rig(), {}, std::nullopt, 1,
                            {test::beside_test("vinebench_plugin_host"), stopped_});
  }
  RunOutcome run(const std::string& settings) {
    test::prepare_fake_folder(folder_.path());
    test::FakeSource source(1, kFakeFrames);
    RunOptions options;
    options.folder = folder_.path();
    options.stopped = stopped_;
    const auto slam = load(settings);
    return run_lockstep_and_judge(test::fake_trial(), source, *slam, options);
  }
  /// The cause of a failure in the fourth frame, which is number 3.
  std::string cause(const std::string& settings) {
    const RunReport report = run(settings).report;
    EXPECT_FALSE(all_hold(report.checks));
    EXPECT_EQ(report.frames, 3);
    EXPECT_EQ(report.failure.value().frame, 3);
    return report.failure->cause;
  }

  test::TestFolder folder_;
  PluginSlamConfig config_;
  std::function<bool()> stopped_;
};

TEST_F(PluginProcessTest, GivesTheSameBytesAsInTheBenchsProcess) {
  const std::string hash = run("").report.hash;
  config_.in_process = true;
  EXPECT_EQ(run("").report.hash, hash);
}

TEST_F(PluginProcessTest, AnExitIsAFailureWithTheFrame) {
  EXPECT_THAT(cause("exit.frame"),
              HasSubstr("fake_plugin.so: process: its process ended: exit code 0"));
  const Json metrics = Json::parse(read_file(folder_ / "metrics.json"));
  EXPECT_THAT(metrics.at("failure").at("cause"), HasSubstr("exit code 0"));
  EXPECT_EQ(metrics.at("failure").at("frame"), 3);
  EXPECT_EQ(metrics.at("expectations").at(0).at("what"), "SLAM system");
  EXPECT_EQ(metrics.at("expectations").at(0).at("ok"), false);
  EXPECT_EQ(read_tum(folder_ / "estimate_live.tum").size(), 3u);  // nothing recorded is lost
}

TEST_F(PluginProcessTest, ACrashNamesTheSignal) {
  EXPECT_THAT(cause("crash.frame"), HasSubstr("ended by signal 11 (Segmentation fault)"));
}

TEST_F(PluginProcessTest, AHangEndsAtTheLimit) {
  config_.frame_timeout = 1;
  EXPECT_THAT(cause("hang.frame"), HasSubstr("fake_plugin.so: process: took more than 1 s"));
}

// At 1 MiB each millisecond, of which the limit is looked at every 100 ms.
TEST_F(PluginProcessTest, MemoryHasALimit) {
  config_.memory_mib = 150;
  EXPECT_THAT(cause("grow.frame"), HasSubstr("process: used more than 150 MiB of memory"));
}

TEST_F(PluginProcessTest, AFailureBeforeTheFirstFrameIsAVerdictToo) {
  for (const auto& [settings, text] :
       {std::pair("exit.create", "create: its process ended: exit code 0"),
        std::pair("crash.create", "create: its process ended: ended by signal 11"),
        std::pair("hang.create", "create: took more than 1 s")}) {
    config_.timeout = std::string(settings) == "hang.create" ? 1 : 30;
    const RunReport report = run(settings).report;
    EXPECT_EQ(report.frames, 0);
    EXPECT_EQ(report.failure.value().frame, 0);
    EXPECT_THAT(report.failure->cause, HasSubstr(text));
    EXPECT_FALSE(all_hold(report.checks));
  }
}

TEST_F(PluginProcessTest, AFailureAfterTheLastFrameKeepsTheLiveEstimates) {
  const RunReport report = run("crash.finish").report;
  EXPECT_EQ(report.frames, kFakeFrames);
  EXPECT_FALSE(report.failure.value().frame);
  EXPECT_THAT(report.failure->cause, HasSubstr("finish: its process ended: ended by signal 11"));
  EXPECT_EQ(report.results.coverage, 1);
  EXPECT_THAT(format_checks(report.checks),
              AllOf(HasSubstr("SLAM system"), HasSubstr("(after the last frame)")));
}

// A second is left to it, of a limit of thirty.
TEST_F(PluginProcessTest, AStopEndsAHang) {
  const fs::path hangs = folder_ / "hang.frame";
  stopped_ = [&] { return fs::exists(hangs); };
  const auto start = std::chrono::steady_clock::now();
  const RunOutcome outcome = run(hangs.string());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_FALSE(outcome.report.failure);
  EXPECT_EQ(outcome.report.frames, 3);
  EXPECT_FALSE(fs::exists(folder_ / "metrics.json"));
}

/// The number of a process whose only argument is that of `parent`; 0 if there is none.
pid_t host_of(pid_t parent) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    std::ifstream in(entry.path() / "cmdline");
    const std::string line{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (line.ends_with(std::string("plugin_host") + '\0' + std::to_string(parent) + '\0')) {
      return static_cast<pid_t>(std::stoi(entry.path().filename()));
    }
  }
  return 0;
}

// The bench cannot tell its plug-in, which hangs, that it ends.
TEST_F(PluginProcessTest, NoProcessIsLeftWhenTheBenchIsKilled) {
  const pid_t bench = fork();
  if (bench == 0) {
    run("hang.frame");
    _exit(0);
  }
  EXPECT_TRUE(test::comes([&] { return host_of(bench) != 0; }, std::chrono::seconds(10)));
  kill(bench, SIGKILL);
  waitpid(bench, nullptr, 0);
  EXPECT_TRUE(test::comes([&] { return host_of(bench) == 0; }, std::chrono::seconds(2)));
}

TEST_F(PluginProcessTest, TheHostIsBesideTheProgramOrInstalled) {
  fs::create_directories(folder_ / "bin");
  fs::create_directories(folder_ / "libexec/vinebench");
  EXPECT_EQ(find_plugin_host(folder_ / "bin/vinebench"), "");
  folder_.write("libexec/vinebench/vinebench_plugin_host", "");
  EXPECT_TRUE(fs::equivalent(find_plugin_host(folder_ / "bin/vinebench"),
                             folder_ / "libexec/vinebench/vinebench_plugin_host"));
  folder_.write("bin/vinebench_plugin_host", "");
  EXPECT_EQ(find_plugin_host(folder_ / "bin/vinebench"), folder_ / "bin/vinebench_plugin_host");
}

}  // namespace
}  // namespace vinebench::harness

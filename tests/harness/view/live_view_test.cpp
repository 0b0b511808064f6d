// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/view/live_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/files/files.h"
#include "harness/run.h"
#include "tests/support/fakes.h"
#include "tests/support/test_folder.h"
#include "tests/support/view_client.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

RunOutcome run(Watcher* watcher, std::function<bool()> stopped = {}) {
  test::FakeSource source;
  test::FakeSlam slam;
  RunOptions options;
  options.watcher = watcher;
  options.features = [] { return std::vector<SupportingFeature>{{0, {3.5, 2.5}}, {2, {0, 0}}}; };
  options.stopped = std::move(stopped);
  return run_lockstep_and_judge(test::fake_trial(), source, slam, options);
}

TEST(LiveViewTest, ChangesNoByteOfARun) {
  LiveView view({}, [] { return false; });
  test::ViewClient viewer(view.address());
  std::thread watching([&] { viewer.events_until("\"frame\":200"); });
  const RunOutcome watched = run(&view);
  watching.join();
  EXPECT_EQ(watched.report.hash, run(nullptr).report.hash);
}

TEST(LiveViewTest, TellsEveryFrame) {
  LiveView view({}, [] { return false; });
  run(&view);
  view.end("PASSED", "");
  test::ViewClient viewer(view.address());
  const std::string events = viewer.events_until("event: end");
  EXPECT_THAT(events, HasSubstr("\"total\":201"));
  EXPECT_THAT(events, HasSubstr("{\"t\":20.0,\"frame\":200,"));
  EXPECT_THAT(events, HasSubstr("\"verdict\":\"PASSED\""));
}

/// What the viewer of a run that it paused at its beginning sees of it.
class PausedRun {
 public:
  PausedRun() : view_({}, [this] { return stop_.load(); }), viewer_(view_.address()) {
    viewer_.post("control", R"({"paused":true})");
    thread_ = std::thread([this] { outcome_ = run(&view_, [this] { return stop_.load(); }); });
  }
  ~PausedRun() {
    stop_ = true;
    thread_.join();
  }
  void wish(const std::string& text) { EXPECT_EQ(viewer_.post("control", text).status, 204); }
  test::ViewClient& viewer() { return viewer_; }
  std::string address() const { return view_.address(); }

 private:
  std::atomic<bool> stop_{false};
  LiveView view_;
  test::ViewClient viewer_;
  RunOutcome outcome_;
  std::thread thread_;
};

TEST(LiveViewTest, PausesAndSteps) {
  PausedRun paused;
  EXPECT_THAT(paused.viewer().events_until("\"frame\":0,"), HasSubstr("\"paused\":true"));
  paused.wish(R"({"step":true})");
  EXPECT_THAT(paused.viewer().events_until("\"frame\":1,"),
              testing::Not(HasSubstr("\"frame\":2,")));
}

TEST(LiveViewTest, ShowsACameraAlone) {
  PausedRun paused;
  paused.viewer().events_until("\"frame\":0,");
  paused.wish(R"({"camera":2})");
  // A picture is made when someone looks; there may be one of all cameras already.
  const std::string alone = "\"cells\":[{\"camera\":\"side\",\"x\":0,\"width\":8}]";
  std::string events;
  std::atomic<bool> seen{false};
  std::thread looking([&] {
    test::ViewClient other(paused.address());
    events = other.events_until(alone);
    seen = true;
  });
  // Nobody looks until its connection stands.
  for (int step = 0; step < 100 && !seen; ++step) {
    paused.wish(R"({"step":true})");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  looking.join();
  EXPECT_THAT(events, HasSubstr(alone));
}

TEST(LiveViewTest, RefusesWhatItCannotDo) {
  LiveView view({}, [] { return false; });
  test::ViewClient viewer(view.address());
  EXPECT_EQ(viewer.post("control", R"({"camera":0})").status, 400);  // there is no run yet
  run(&view);
  EXPECT_EQ(viewer.post("control", R"({"camera":2})").status, 204);
  EXPECT_THAT(viewer.post("control", R"({"camera":3})").body, HasSubstr("0 to 2, found 3"));
  EXPECT_EQ(viewer.post("control", R"({"camera":"side"})").status, 400);
  EXPECT_EQ(viewer.post("control", R"({"speed":-1})").status, 400);
}

TEST(LiveViewTest, TheReportIsFetchedBeforeTheEnd) {
  const test::TestFolder folder;
  write_file_atomically(folder / "report.html", "<p>report</p>");
  LiveView view({}, [] { return false; });
  test::ViewClient viewer(view.address());
  std::string report;
  std::thread watching([&] {
    viewer.events_until("event: end");
    report = viewer.get("report").body;
  });
  run(&view);
  while (view.viewers() == 0) std::this_thread::yield();
  view.end("PASSED", folder / "report.html");
  watching.join();
  EXPECT_EQ(report, "<p>report</p>");
}

}  // namespace
}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/view/view_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace vinebench::harness {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

std::string what_is_new(ViewLog& log, ViewLog::Reader& reader) {
  return log.next(reader, Clock::now());
}

TEST(ViewLogTest, AViewerIsToldWhatItLacks) {
  ViewLog log;
  ViewLog::Reader reader;
  EXPECT_EQ(what_is_new(log, reader), "");
  log.begin({{"title", "run"}});
  log.add_tick({{"frame", 0}});
  log.add_tick({{"frame", 1}});
  log.set_picture({{"frame", 1}});
  EXPECT_EQ(what_is_new(log, reader),
            "event: begin\ndata: {\"title\":\"run\"}\n\n"
            "event: ticks\nid: 2\ndata: [{\"frame\":0},{\"frame\":1}]\n\n"
            "event: picture\ndata: {\"frame\":1}\n\n");
  EXPECT_EQ(what_is_new(log, reader), "");
  log.add_tick({{"frame", 2}});
  EXPECT_EQ(what_is_new(log, reader), "event: ticks\nid: 3\ndata: [{\"frame\":2}]\n\n");
}

TEST(ViewLogTest, PicturesAndStatesAreTheLatest) {
  ViewLog log;
  ViewLog::Reader reader;
  for (int frame = 0; frame < 3; ++frame) log.set_picture({{"frame", frame}});
  for (const bool paused : {true, false}) log.set_state({{"paused", paused}});
  EXPECT_EQ(what_is_new(log, reader),
            "event: state\ndata: {\"paused\":false}\n\nevent: picture\ndata: {\"frame\":2}\n\n");
}

TEST(ViewLogTest, ALongListComesInParts) {
  ViewLog log;
  for (int i = 0; i < 1200; ++i) log.add_tick(i);
  log.end({{"verdict", "PASSED"}});
  ViewLog::Reader reader;
  EXPECT_THAT(what_is_new(log, reader), testing::StartsWith("event: ticks\nid: 500\ndata: [0,1,"));
  EXPECT_THAT(what_is_new(log, reader), testing::StartsWith("event: ticks\nid: 1000\n"));
  // The end comes behind the last of them.
  const std::string last = what_is_new(log, reader);
  EXPECT_THAT(last, testing::StartsWith("event: ticks\nid: 1200\n"));
  EXPECT_THAT(last, testing::EndsWith("event: end\ndata: {\"verdict\":\"PASSED\"}\n\n"));
}

TEST(ViewLogTest, WhoComesAgainGoesOn) {
  ViewLog log;
  for (int i = 0; i < 5; ++i) log.add_tick(i);
  ViewLog::Reader reader;
  reader.ticks = 3;
  EXPECT_EQ(what_is_new(log, reader), "event: ticks\nid: 5\ndata: [3,4]\n\n");
  reader.ticks = 99;  // of another run
  EXPECT_EQ(what_is_new(log, reader), "");
}

TEST(ViewLogTest, KnowsWhetherAPictureWasRead) {
  ViewLog log;
  ViewLog::Reader reader;
  EXPECT_TRUE(log.picture_was_read());  // there is none
  log.set_picture(1);
  EXPECT_FALSE(log.picture_was_read());
  what_is_new(log, reader);
  EXPECT_TRUE(log.picture_was_read());
}

TEST(ViewLogTest, WakesWhoWaits) {
  ViewLog log;
  ViewLog::Reader reader;
  std::thread later([&log] { log.add_tick(7); });
  EXPECT_THAT(log.next(reader, Clock::now() + std::chrono::seconds(20)), testing::HasSubstr("[7]"));
  later.join();
  std::thread end([&log] { log.close(); });
  EXPECT_EQ(log.next(reader, Clock::now() + std::chrono::seconds(20)), "");
  EXPECT_TRUE(log.closed());
  end.join();
}

}  // namespace
}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/view/view_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/util/error.h"
#include "tests/support/view_client.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ViewServerTest : public testing::Test {
 protected:
  ViewContent content() {
    return {"<p>page</p>",
            [this](const nlohmann::json& wish) {
              if (wish.contains("speed")) fail("speed: no");
              wishes_.push_back(wish.dump());
            },
            [this] { return report_; }};
  }
  ViewLog log_;
  std::vector<std::string> wishes_;
  std::string report_;
  ViewServer server_{{}, content(), log_};
  test::ViewClient client_{server_.address()};
};

TEST_F(ViewServerTest, ThePageIsAtItsAddress) {
  EXPECT_THAT(server_.address(), testing::MatchesRegex("http://127.0.0.1:[0-9]+/[0-9a-f]{32}/"));
  EXPECT_EQ(client_.get("").body, "<p>page</p>");
  EXPECT_EQ(client_.get("").headers.find("Cache-Control")->second, "no-store");
}

TEST_F(ViewServerTest, WithoutTheTokenThereIsNothing) {
  for (const char* path : {"/", "/events", "/report", "/0123456789abcdef0123456789abcdef/"}) {
    EXPECT_EQ(client_.get_absolute(path).status, 404) << path;
  }
  EXPECT_EQ(client_.post("../control", "{}").status, 404);
  EXPECT_TRUE(wishes_.empty());
}

TEST_F(ViewServerTest, EventsComeAsTheyHappen) {
  log_.begin({{"title", "run"}});
  EXPECT_THAT(client_.events_until("\"run\""), StartsWith("event: begin\n"));
}

TEST_F(ViewServerTest, WishesAreJsonObjects) {
  EXPECT_EQ(client_.post("control", "{\"step\":true}").status, 204);
  EXPECT_THAT(wishes_, testing::ElementsAre("{\"step\":true}"));
  EXPECT_EQ(client_.post("control", "[1]").status, 400);
  EXPECT_EQ(client_.post("control", "{").status, 400);
  EXPECT_EQ(client_.post("control", std::string(1000, '[')).status, 400);
  EXPECT_EQ(client_.post("control", std::string(100'000, ' ')).status, 413);  // too large
  const auto refused = client_.post("control", "{\"speed\":1}");
  EXPECT_EQ(refused.status, 400);
  EXPECT_THAT(refused.body, HasSubstr("speed: no"));
  EXPECT_EQ(wishes_.size(), 1u);
}

TEST_F(ViewServerTest, AReportIsThereWhenItIs) {
  EXPECT_EQ(client_.get("report").status, 404);
  report_ = "<p>report</p>";
  EXPECT_EQ(client_.get("report").body, "<p>report</p>");
}

TEST_F(ViewServerTest, APortInUseIsAnError) {
  try {
    const ViewServer second({"127.0.0.1", client_.port()}, content(), log_);
    ADD_FAILURE() << "two servers have one port";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("127.0.0.1:" + std::to_string(client_.port())));
    EXPECT_THAT(error.what(), HasSubstr("the port is in use"));
  }
}

TEST_F(ViewServerTest, AnAddressOfNobodyIsAnError) {
  EXPECT_THROW(ViewServer({"192.0.2.1", 0}, content(), log_), Error);  // RFC 5737: for documents
  EXPECT_THROW(ViewServer({"no such host", 0}, content(), log_), Error);
}

}  // namespace
}  // namespace vinebench::harness

// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/mcap/mcap_file.h"

#include <gmock/gmock.h>

#include "harness/datasets/ros2/mcap/mcap_writer.h"
#include "harness/datasets/ros2/mcap/zstd.h"
#include "tests/support/compressed.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;

/// Of a chunk without compression and checksum.
std::string bare_chunk(const std::string& records, std::uint64_t size, std::uint32_t crc = 0,
                       const char* compression = "") {
  return McapFields()
      .put(std::uint64_t{1})
      .put(std::uint64_t{2})
      .put(size)
      .put(crc)
      .put_text(compression)
      .put(std::uint64_t{records.size()})
      .put_bytes(records)
      .record(McapRecord::kChunk);
}

std::string message_of(std::uint16_t channel, const std::string& data) {
  return McapFields()
      .put(channel)
      .put(std::uint32_t{0})
      .put(std::uint64_t{1})
      .put(std::uint64_t{1})
      .put_bytes(data)
      .record(McapRecord::kMessage);
}

/// Channel 3, "/a" of type A.
std::string channel_of_a(std::uint16_t schema = 2, const char* encoding = "cdr") {
  return McapFields()
             .put(std::uint16_t{2})
             .put_text("A")
             .put_text("")
             .put_text("")
             .record(McapRecord::kSchema) +
         McapFields()
             .put(std::uint16_t{3})
             .put(schema)
             .put_text("/a")
             .put_text(encoding)
             .put_map({})
             .record(McapRecord::kChannel);
}

class McapFileTest : public testing::Test {
 protected:
  fs::path file(const std::string& records) const {
    return folder_.write("a.mcap", std::string(kMcapMagic) + records);
  }
  /// "topic type data" of each message, read twice.
  std::vector<std::string> messages(const fs::path& name) {
    McapFile in(name);
    std::vector<std::string> found;
    std::vector<std::pair<MessagePlace, std::string>> places;
    in.scan([&](const BagMessage& m) {
      found.push_back(fmt::format("{} {} {}", m.topic, m.type, m.data));
      places.emplace_back(m.place, m.data);
    });
    for (const auto& [place, data] : places) EXPECT_EQ(in.read(place), data);
    cut_off_ = in.cut_off();
    return found;
  }
  std::string problem(const std::string& records) {
    const fs::path name = file(records);
    const std::string error = error_of([&] { messages(name); });
    EXPECT_THAT(error, HasSubstr(name.string()));
    return error;
  }

  test::TestFolder folder_;
  std::string cut_off_;
};

TEST_F(McapFileTest, MessagesAreFoundInAndOutsideOfChunks) {
  const std::string two = message_of(3, "x") + message_of(3, "yz");
  const auto both = ElementsAre("/a A x", "/a A yz");
  const std::string end = McapFields().put(std::uint32_t{0}).record(McapRecord::kDataEnd);
  EXPECT_THAT(messages(file(channel_of_a() + two + end)), both);
  EXPECT_EQ(cut_off_, "");
  const std::string all = channel_of_a() + two;
  EXPECT_THAT(messages(file(bare_chunk(all, all.size()) + end)), both);
  const std::string packed = zstd_compress(all);
  EXPECT_THAT(messages(file(bare_chunk(packed, all.size(), 0, "zstd") + end)), both);
  const std::string lz4 = test::lz4_frame(all);
  EXPECT_THAT(messages(file(bare_chunk(lz4, all.size(), 0, "lz4") + end)), both);
  EXPECT_THAT(messages(file(channel_of_a(2, "json") + two + end)), ElementsAre());
}

/// Files of the reference implementation in Python (tests/fuzz/corpus): the same bag three times.
TEST_F(McapFileTest, FilesOfAnotherWriterAreRead) {
  const fs::path corpus = fs::path(VINEBENCH_SOURCE_DIR) / "tests/fuzz/corpus/mcap";
  const std::vector<std::string> plain = messages(corpus / "plain");
  ASSERT_EQ(plain.size(), 13u);  // /tf_static, and twice: /imu, two images and infos, a pose
  EXPECT_THAT(plain[0], HasSubstr("/tf_static tf2_msgs/msg/TFMessage "));
  EXPECT_THAT(plain[2], HasSubstr("/left/image_rect sensor_msgs/msg/Image "));
  EXPECT_EQ(messages(corpus / "chunk"), plain);
  EXPECT_EQ(messages(corpus / "zstd"), plain);
  EXPECT_EQ(cut_off_, "");
}

TEST_F(McapFileTest, OursSaysWhenStamp0Is) {
  const auto start_in = [&](const McapMap& map) {
    {
      McapWriter out(folder_ / "ours.mcap", "test");
      out.write_metadata("vinebench", map);
    }
    McapFile in(folder_ / "ours.mcap");
    in.scan([](const BagMessage&) {});
    return in.start();
  };
  EXPECT_EQ(start_in({{"time_of_stamp_0", "1000000000"}}), 1'000'000'000);
  EXPECT_EQ(start_in({{"other", "1"}}), 0);
  EXPECT_THAT(error_of([&] {
                start_in({{"time_of_stamp_0", "soon"}});
              }),
              HasSubstr("expected a time in ns, found 'soon'"));
}

TEST_F(McapFileTest, AFileThatEndsTooEarlyIsReadUpToThere) {
  const std::string whole = channel_of_a() + message_of(3, "x");
  const fs::path cut = file(whole + message_of(3, "yz").substr(0, 20));
  EXPECT_THAT(messages(cut), ElementsAre("/a A x"));
  EXPECT_EQ(cut_off_, fmt::format("ends at byte {}, in the record at byte {}",
                                  8 + whole.size() + 20, 8 + whole.size()));
}

TEST_F(McapFileTest, WhatIsNoMcapFileIsAnError) {
  for (const char* content : {"", "\x89MCAP", "#ROSBAG V2.0\n"}) {
    const fs::path name = folder_.write("none.mcap", content);
    EXPECT_EQ(error_of([&] { McapFile{name}; }),
              name.string() + ": expected an MCAP file, which begins with \\x89MCAP0");
  }
}

TEST_F(McapFileTest, BrokenRecordsAreErrorsWithTheirPlace) {
  EXPECT_THAT(problem(message_of(3, "x")),
              HasSubstr("byte 17: expected one of the channels before it, found 3"));
  EXPECT_THAT(problem(channel_of_a(7)), HasSubstr("topic /a: expected one of the schemas"));
  EXPECT_THAT(problem(McapFields().put(std::uint8_t{1}).record(McapRecord::kMessage)),
              HasSubstr("byte 17: expected 2 more bytes in the record, found 1"));
  const std::string endless =
      McapFields().put(std::uint16_t{2}).put(0xffffffffu).record(McapRecord::kSchema);
  EXPECT_THAT(problem(endless), HasSubstr("expected 4294967295 more bytes in the record, found 0"));
}

TEST_F(McapFileTest, BrokenChunksAreErrorsWithTheirPlace) {
  const std::string all = channel_of_a() + message_of(3, "x");
  EXPECT_THAT(problem(bare_chunk(all, all.size(), 1)), HasSubstr("the chunk is damaged"));
  EXPECT_THAT(problem(bare_chunk(all, all.size(), 0, "lz4")), HasSubstr("byte 17: lz4: "));
  EXPECT_THAT(problem(bare_chunk(all, all.size(), 0, "xz")), HasSubstr("or bz2, found 'xz'"));
  EXPECT_THAT(problem(bare_chunk(all, all.size(), 0, "zstd")), HasSubstr("byte 17: zstd: "));
  const std::string packed = zstd_compress(all);
  EXPECT_THAT(problem(bare_chunk(packed, all.size() + 1, 0, "zstd")),
              HasSubstr("bytes without compression, found"));
  EXPECT_THAT(problem(bare_chunk(packed, std::uint64_t{1} << 60, 0, "zstd")),
              HasSubstr("expected a chunk of at most 268435456 bytes"));
  EXPECT_THAT(problem(bare_chunk(all.substr(0, all.size() - 1), all.size() - 1)),
              HasSubstr("of the chunk at byte 17: expected 23 more bytes, found 22"));
  EXPECT_THAT(problem(bare_chunk(all + "\5", all.size() + 1)), HasSubstr("expected a record"));
}

}  // namespace
}  // namespace vinebench::harness

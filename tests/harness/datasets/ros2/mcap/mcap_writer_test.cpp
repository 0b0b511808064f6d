// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/mcap/mcap_writer.h"

#include <gmock/gmock.h>
#include <libdeflate.h>

#include "harness/datasets/ros2/mcap/mcap_file.h"
#include "harness/datasets/ros2/mcap/zstd.h"
#include "tests/support/size_limit.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using test::error_of;

/// A record of a file in memory.
struct Found {
  McapRecord kind{};
  std::size_t at = 0;  ///< of the record
  std::string_view fields;
  std::size_t end = 0;
};

Found record_at(const std::string& bytes, std::size_t at) {
  McapFieldReader head(std::string_view(bytes).substr(at), "record");
  Found found;
  found.kind = static_cast<McapRecord>(head.get<std::uint8_t>());
  found.at = at;
  found.fields = head.take(head.get<std::uint64_t>());
  found.end = at + kMcapRecordHead + found.fields.size();
  return found;
}

std::vector<Found> records_of(const std::string& bytes, std::size_t at, std::size_t end) {
  std::vector<Found> records;
  for (; at < end; at = records.back().end) records.push_back(record_at(bytes, at));
  return records;
}

std::uint32_t crc(std::string_view bytes) {
  return libdeflate_crc32(0, bytes.data(), bytes.size());
}

class McapWriterTest : public testing::Test {
 protected:
  /// Two chunks: a and b at 10 and 20 ns, then b at 30 ns.
  std::string write(const std::string& name) const {
    McapWriter out(folder_ / name, "test");
    out.write_metadata("vinebench", {{"key", "value"}});
    const std::size_t a = out.add_channel({"/a", "pkg/msg/A", "int32 x\n", {}, 0});
    const std::size_t b = out.add_channel({"/b", "pkg/msg/B", "int32 y\n", {{"k", "v"}}, 0});
    out.add_channel({"/unused", "pkg/msg/C", "", {}, 0});
    out.write(a, 10, "first");
    out.write(b, 20, std::string(1000, 'b'));
    out.end_chunk();
    out.end_chunk();  // no empty chunk
    out.write(b, 30, "last");
    out.close();
    EXPECT_EQ(out.statistics().messages, 3u);
    EXPECT_EQ(out.channels()[b].messages, 2u);
    return read_file(folder_ / name);
  }

  test::TestFolder folder_;
};

TEST_F(McapWriterTest, TheSameMessagesAreTheSameBytes) {
  EXPECT_EQ(write("a.mcap"), write("b.mcap"));
}

TEST_F(McapWriterTest, RecordsAreInTheOrderOfTheFormat) {
  const std::string bytes = write("a.mcap");
  EXPECT_TRUE(bytes.starts_with(kMcapMagic));
  EXPECT_TRUE(bytes.ends_with(kMcapMagic));
  std::vector<McapRecord> kinds;
  for (const Found& found : records_of(bytes, 8, bytes.size() - 8)) kinds.push_back(found.kind);
  using R = McapRecord;
  EXPECT_THAT(kinds, testing::ElementsAre(
                         R::kHeader, R::kMetadata, R::kChunk, R::kMessageIndex, R::kMessageIndex,
                         R::kChunk, R::kMessageIndex, R::kDataEnd, R::kSchema, R::kSchema,
                         R::kChannel, R::kChannel, R::kStatistics, R::kChunkIndex, R::kChunkIndex,
                         R::kMetadataIndex, R::kSummaryOffset, R::kSummaryOffset, R::kSummaryOffset,
                         R::kSummaryOffset, R::kSummaryOffset, R::kFooter));
}

TEST_F(McapWriterTest, ChecksumsAgree) {
  const std::string bytes = write("a.mcap");
  for (const Found& found : records_of(bytes, 8, bytes.size() - 8)) {
    McapFieldReader in(found.fields, "fields");
    if (found.kind == McapRecord::kDataEnd) {
      EXPECT_EQ(in.get<std::uint32_t>(), crc(bytes.substr(0, found.at)));
    } else if (found.kind == McapRecord::kFooter) {
      const auto summary = in.get<std::uint64_t>();
      EXPECT_EQ(record_at(bytes, summary).kind, McapRecord::kSchema);
      EXPECT_EQ(record_at(bytes, in.get<std::uint64_t>()).kind, McapRecord::kSummaryOffset);
      EXPECT_EQ(in.get<std::uint32_t>(),
                crc(bytes.substr(summary, found.end - sizeof(std::uint32_t) - summary)));
    }
  }
}

TEST_F(McapWriterTest, TheIndexLeadsToEveryMessage) {
  const std::string bytes = write("a.mcap");
  std::vector<std::pair<std::uint64_t, std::string>> messages;  // time and data
  for (const Found& found : records_of(bytes, 8, bytes.size() - 8)) {
    if (found.kind != McapRecord::kChunkIndex) continue;
    McapFieldReader index(found.fields, "index");
    index.take(16);  // times
    const Found chunk = record_at(bytes, index.get<std::uint64_t>());
    ASSERT_EQ(chunk.kind, McapRecord::kChunk);
    EXPECT_EQ(index.get<std::uint64_t>(), chunk.end - chunk.at);
    McapFieldReader in(chunk.fields, "chunk");
    in.take(16);
    const auto size = in.get<std::uint64_t>();
    const auto sum = in.get<std::uint32_t>();
    EXPECT_EQ(in.get_text(), "zstd");
    const std::string records = zstd_decompress(in.take(in.get<std::uint64_t>()), size);
    EXPECT_EQ(sum, crc(records));
    McapFieldReader offsets(index.get_text(), "offsets");
    while (!offsets.rest().empty()) {
      const auto channel = offsets.get<std::uint16_t>();
      const Found list = record_at(bytes, offsets.get<std::uint64_t>());
      ASSERT_EQ(list.kind, McapRecord::kMessageIndex);
      McapFieldReader entries(list.fields, "entries");
      EXPECT_EQ(entries.get<std::uint16_t>(), channel);
      McapFieldReader pairs(entries.get_text(), "pairs");
      const auto time = pairs.get<std::uint64_t>();
      const Found message = record_at(records, pairs.get<std::uint64_t>());
      ASSERT_EQ(message.kind, McapRecord::kMessage);
      McapFieldReader fields(message.fields, "message");
      EXPECT_EQ(fields.get<std::uint16_t>(), channel);
      fields.take(4 + 16);  // sequence, times
      messages.emplace_back(time, std::string(fields.rest()).substr(0, 5));
    }
  }
  EXPECT_THAT(messages, testing::ElementsAre(testing::Pair(10, "first"), testing::Pair(20, "bbbbb"),
                                             testing::Pair(30, "last")));
}

TEST_F(McapWriterTest, AFileThatOutgrowsTheDiskIsClosedAllTheSame) {
  const fs::path file = folder_ / "full.mcap";
  std::uint64_t written = 0;
  std::string error;
  {
    const test::SizeLimit limit(100'000);
    McapWriter out(file, "test");
    const std::size_t topic = out.add_channel({"/a", "pkg/msg/A", "int32 x\n", {}, 0});
    error = error_of([&] {
      for (std::uint64_t i = 1; i < 10'000; ++i) {
        std::string noise(1000, '\0');  // that Zstandard does not make small
        for (std::size_t k = 0; k < noise.size(); ++k) {
          noise[k] = static_cast<char>((i * 7919 + k * k * 104729) >> 5);
        }
        out.write(topic, i, noise);
        out.end_chunk();
        ++written;
      }
    });
  }
  EXPECT_EQ(error, file.string() + ": cannot be written: File too large");
  EXPECT_GT(written, 20u);
  EXPECT_LE(fs::file_size(file), 100'000u);
  McapFile in(file);
  std::uint64_t found = 0;
  in.scan([&](const BagMessage&) { ++found; });
  EXPECT_EQ(found, written);
  EXPECT_EQ(in.cut_off(), "");
  EXPECT_TRUE(read_file(file).ends_with(kMcapMagic));
}

TEST_F(McapWriterTest, AFileThatWasNeverClosedHasItsChunks) {
  const fs::path file = folder_ / "open.mcap";
  McapWriter out(file, "test");
  const std::size_t topic = out.add_channel({"/a", "pkg/msg/A", "int32 x\n", {}, 0});
  out.write(topic, 10, "first");
  out.end_chunk();
  out.write(topic, 20, "second");
  McapFile in(file);
  std::vector<std::string> found;
  in.scan([&](const BagMessage& message) { found.emplace_back(message.data); });
  EXPECT_THAT(found, testing::ElementsAre("first"));
  EXPECT_EQ(in.cut_off(),
            fmt::format("ends at byte {}, before the end of its data", fs::file_size(file)));
}

TEST_F(McapWriterTest, ALinkInItsPlaceIsNotFollowed) {
  const fs::path target = folder_.write("target", "theirs");
  fs::create_symlink(target, folder_ / "a.mcap");
  write("a.mcap");
  EXPECT_EQ(read_file(target), "theirs");
}

}  // namespace
}  // namespace vinebench::harness

// SPDX-License-Identifier: Apache-2.0
#include "recording/file_stream.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "recording/mcap_reader.hpp"
#include "recording/mcap_writer.hpp"

namespace trunnion::recording {
namespace {

TEST(FileStream, GivesBackWhatWasWritten) {
  const std::string path = testing::TempDir() + "/file_stream_test.mcap";
  {
    FileSink sink(path);
    Writer writer(sink);
    const auto channel = writer.add_channel("a", "A", "struct A {};");
    ASSERT_TRUE(writer.write(channel, 1, 2, Bytes{3, 4}));
    ASSERT_TRUE(writer.finish());
    EXPECT_TRUE(sink.sync());
    EXPECT_EQ(std::filesystem::file_size(path), writer.bytes());
  }
  FileSource source(path);
  Reader reader(source);
  MessageView message;
  ASSERT_TRUE(reader.next(message));
  EXPECT_EQ(Bytes(message.data.begin(), message.data.end()), (Bytes{3, 4}));
  EXPECT_FALSE(reader.next(message));
  EXPECT_EQ(reader.ending(), Ending::complete);
  std::filesystem::remove(path);
}

TEST(FileStream, SaysWhichFileCannotBeOpenedAndWhy) {
  try {
    FileSource source("/nowhere/at/all.mcap");
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "/nowhere/at/all.mcap: No such file or directory");
  }
  EXPECT_THROW(FileSink("/nowhere/at/all.mcap"), std::runtime_error);
  EXPECT_THROW(FileSource("/"), std::runtime_error);
}

TEST(FileStream, AFullDiskIsOneLineAndStaysSo) {
  // Linux offers a device on which every write finds the disk full.
  FileSink sink("/dev/full");
  EXPECT_FALSE(sink.write(Bytes(10)));
  EXPECT_EQ(sink.problem(), "/dev/full: No space left on device");
  EXPECT_FALSE(sink.write(Bytes(10)));
  EXPECT_FALSE(sink.sync());
}

}  // namespace
}  // namespace trunnion::recording

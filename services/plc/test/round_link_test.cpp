// SPDX-License-Identifier: Apache-2.0
#include "round_link.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <random>

namespace trunnion::plc {
namespace {

class RoundLink : public testing::Test {
 protected:
  RoundLink() : path_(testing::TempDir() + "rounds-" + std::to_string(getpid())) {
    std::filesystem::remove(path_);
  }
  ~RoundLink() override { std::filesystem::remove(path_); }
  static bus::Bytes record(std::size_t size, std::uint8_t fill) { return bus::Bytes(size, fill); }
  const std::string path_;
};

TEST_F(RoundLink, WhatIsWrittenIsReadInItsOrderAlsoAcrossTheEndOfTheRing) {
  RoundReader reader(path_);
  RoundWriter writer(path_);
  ASSERT_EQ(writer.wanted(10), reader.generation());
  std::mt19937_64 random(1);
  bus::Bytes bytes;
  // 40 MB through 4 MB, up to three records behind.
  for (int k = 0; k < 2000; ++k) {
    const auto burst = 1 + random() % 3;
    std::vector<bus::Bytes> sent;
    for (std::uint64_t n = 0; n < burst; ++n) {
      sent.push_back(record(random() % 20000, static_cast<std::uint8_t>(random())));
      ASSERT_TRUE(writer.write(sent.back()));
    }
    for (const auto& expected : sent) {
      ASSERT_TRUE(reader.read(bytes));
      ASSERT_EQ(bytes, expected);
    }
    ASSERT_FALSE(reader.read(bytes));
  }
  EXPECT_FALSE(reader.lost());
}

TEST_F(RoundLink, AReaderThatWasOvertakenSaysSoAndGoesOnWhenItAsksAgain) {
  RoundReader reader(path_);
  RoundWriter writer(path_);
  const auto generation = writer.wanted(10);
  for (int k = 0; k < 50; ++k) ASSERT_TRUE(writer.write(record(100000, 7)));
  bus::Bytes bytes;
  EXPECT_FALSE(reader.read(bytes));
  EXPECT_TRUE(reader.lost());
  reader.request_start();
  EXPECT_FALSE(reader.lost());
  EXPECT_FALSE(reader.read(bytes)) << "what was there is dropped";
  EXPECT_EQ(writer.wanted(10.01), generation + 1);
  ASSERT_TRUE(writer.write(record(10, 9)));
  ASSERT_TRUE(reader.read(bytes));
  EXPECT_EQ(bytes, record(10, 9));
}

TEST_F(RoundLink, WhatIsLargerThanTheRingIsNotWritten) {
  RoundReader reader(path_);
  RoundWriter writer(path_);
  ASSERT_NE(writer.wanted(10), 0u);
  EXPECT_FALSE(writer.write(record(5u << 20, 1)));
  bus::Bytes bytes;
  EXPECT_FALSE(reader.read(bytes));
  EXPECT_FALSE(reader.lost());
}

TEST_F(RoundLink, NobodyAsksUntilThereIsAReaderAndNobodyAfterItHasStoppedBreathing) {
  RoundWriter writer(path_);
  EXPECT_EQ(writer.wanted(10), 0u);
  EXPECT_FALSE(writer.write(record(10, 1)));
  auto reader = std::make_unique<RoundReader>(path_);
  EXPECT_EQ(writer.wanted(10.05), 0u) << "it polls every 0.1 s";
  EXPECT_NE(writer.wanted(10.2), 0u);
  EXPECT_NE(writer.wanted(11.1), 0u);
  reader->send_heartbeat();
  EXPECT_NE(writer.wanted(11.3), 0u);
  EXPECT_NE(writer.wanted(12.2), 0u);
  EXPECT_EQ(writer.wanted(12.4), 0u) << "1.1 s without a heartbeat";
  EXPECT_FALSE(std::filesystem::exists(path_)) << "what a dead one leaves behind is taken away";
  EXPECT_EQ(writer.wanted(13), 0u);
}

// Killed, it has not taken its file away.
TEST_F(RoundLink, AReaderThatFollowsADeadOneIsHeardAtOnceAndReadsNothingOfBefore) {
  auto* dead = new RoundReader(path_);
  RoundWriter writer(path_);
  const auto generation = writer.wanted(10);
  ASSERT_TRUE(writer.write(record(3, 4)));
  RoundReader next(path_);
  EXPECT_EQ(writer.wanted(10.01), generation + 1);
  bus::Bytes bytes;
  EXPECT_FALSE(next.read(bytes));
  ASSERT_TRUE(writer.write(record(5, 6)));
  EXPECT_TRUE(next.read(bytes));
  EXPECT_EQ(bytes, record(5, 6));
  delete dead;
}

TEST_F(RoundLink, OneThatTookItsFileAwayDoesNotTakeThatOfTheNext) {
  RoundWriter writer(path_);
  {
    RoundReader first(path_);
    ASSERT_NE(writer.wanted(10), 0u);
  }
  RoundReader next(path_);
  EXPECT_EQ(writer.wanted(11.1), 0u) << "the first has stopped breathing";
  EXPECT_TRUE(std::filesystem::exists(path_));
  EXPECT_NE(writer.wanted(11.3), 0u);
  ASSERT_TRUE(writer.write(record(3, 4)));
  bus::Bytes bytes;
  EXPECT_TRUE(next.read(bytes));
}

TEST_F(RoundLink, AFileThatIsNoRingIsNotTakenForOne) {
  { storage::MappedFile other(path_, 100); }
  RoundWriter writer(path_);
  EXPECT_EQ(writer.wanted(10), 0u);
  EXPECT_THROW(RoundReader("/nowhere/at/all"), std::exception);
}

}  // namespace
}  // namespace trunnion::plc

// SPDX-License-Identifier: Apache-2.0
#include "bus/shared_history.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bus/bus.hpp"
#include "contracts/topics.hpp"
#include "testing_support/eventually.hpp"

namespace trunnion::bus {
namespace {

using testing_support::eventually;
using Place = SharedHistoryReader::Place;

Bytes message(std::uint8_t number) { return Bytes(100, number); }

TEST(SharedHistory, HasWhatWasWrittenBeforeItWasFoundAndSince) {
  const auto history = SharedHistory::make();
  ASSERT_NE(history, nullptr);
  history->write(8, message(1));
  const auto found = SharedHistoryReader::find(history->address());
  ASSERT_EQ(found.place, Place::here);
  history->write(16, message(2));
  Bytes bytes;
  SampleInfo info;
  ASSERT_TRUE(found.reader->take(bytes, info));
  EXPECT_EQ(bytes, message(1));
  EXPECT_EQ(info.source_timestamp, 8);
  ASSERT_TRUE(found.reader->take(bytes, info));
  EXPECT_EQ(bytes, message(2));
  EXPECT_EQ(info.source_timestamp, 16);
  EXPECT_FALSE(found.reader->take(bytes, info));
  EXPECT_EQ(found.reader->lost(), 0u);
}

TEST(SharedHistory, CountsWhatWasOverwrittenBeforeItWasTaken) {
  const auto history = SharedHistory::make();
  const auto found = SharedHistoryReader::find(history->address());
  ASSERT_EQ(found.place, Place::here);
  // Six messages of a megabyte, of which three and their headers fit into 4 MiB with a fourth that does not.
  for (int n = 0; n < 6; ++n) history->write(8, Bytes(std::size_t{1} << 20));
  Bytes bytes;
  SampleInfo info;
  int taken = 0;
  while (found.reader->take(bytes, info)) ++taken;
  EXPECT_EQ(taken, 3);
  EXPECT_EQ(found.reader->lost(), 3u);
}

TEST(SharedHistory, OfAProcessThatIsKilledWhoeverHasItOpenStillReadsAllAndNobodyElseFindsIt) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const auto history = SharedHistory::make();
    for (std::uint8_t n = 0; n < 10; ++n) history->write(8, message(n));
    const auto& address = history->address();
    if (write(ends[1], address.data(), address.size()) < 0) _exit(1);
    pause();
  }
  char text[256] = "";
  ASSERT_GT(read(ends[0], text, sizeof text - 1), 0);
  const auto found = SharedHistoryReader::find(text);
  ASSERT_EQ(found.place, Place::here);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  Bytes bytes;
  SampleInfo info;
  for (std::uint8_t n = 0; n < 10; ++n) {
    ASSERT_TRUE(found.reader->take(bytes, info));
    EXPECT_EQ(bytes, message(n));
  }
  EXPECT_EQ(SharedHistoryReader::find(text).place, Place::gone);
  close(ends[0]);
  close(ends[1]);
}

TEST(SharedHistory, AnAddressThatIsNoneOrOfAnotherHostIsElsewhereAndAnOldOneIsGone) {
  EXPECT_EQ(SharedHistoryReader::find("").place, Place::elsewhere);
  EXPECT_EQ(SharedHistoryReader::find("trunnion-history/1").place, Place::elsewhere);
  const auto history = SharedHistory::make();
  const std::string address = history->address();
  const auto space = address.find(' ') + 1;
  auto other_host = address;
  other_host[space] = other_host[space] == '0' ? '1' : '0';
  EXPECT_EQ(SharedHistoryReader::find(other_host).place, Place::elsewhere);
  // The same numbers, made at another time.
  auto older = address;
  older.back() = older.back() == '0' ? '1' : '0';
  EXPECT_EQ(SharedHistoryReader::find(older).place, Place::gone);
  // Some file that is no history at all.
  const auto file = address.rfind(' ', address.rfind(' ') - 1);
  EXPECT_EQ(SharedHistoryReader::find(address.substr(0, file) + " 0 5").place, Place::gone);
}

class DiscoveryOverVendors : public testing::TestWithParam<std::tuple<Vendor, Vendor, std::uint32_t>> {};

// How a recorder finds them: by what the DDS writer tells of itself.
TEST_P(DiscoveryOverVendors, TellsOfEveryWriterWhatItIsWhereItsBatchesAreAndWhichSamplesAreItsOwn) {
  const auto [from, to, domain] = GetParam();
  Bus a(from, {domain}), b(to, {domain});
  auto shared = std::make_unique<Writer<idl::stream::AxisBatch>>(a.writer(topics::gantry_batch));
  const auto plain = a.backend().writer(describe(topics::gantry_batch), {true, 16});
  auto reader = b.reader(topics::gantry_batch);
  std::vector<DiscoveredWriter> writers;
  const auto discovered = [&](std::size_t count) {
    return eventually([&] {
      b.backend().discover(writers);
      std::erase_if(writers, [](const auto& w) { return w.topic != topics::gantry_batch.name; });
      return writers.size() == count;
    });
  };
  ASSERT_TRUE(discovered(2));
  EXPECT_FALSE(b.backend().discover(writers)) << "nothing has changed";
  if (writers[0].user_data.empty()) std::swap(writers[0], writers[1]);
  EXPECT_EQ(writers[1].user_data, "");
  for (const auto& writer : writers) EXPECT_EQ(writer.wire_type, topics::gantry_batch.wire_type);
  ASSERT_TRUE(eventually([&] { return reader.matched() == 2; }));

  idl::stream::AxisBatch batch;
  batch.count = 1;
  shared->write(batch);
  ASSERT_TRUE(eventually([&] { return reader.take(batch); }));
  EXPECT_EQ(reader.info().writer, writers[0].id);
  const auto sent = reader.info().source_timestamp;
  auto found = SharedHistoryReader::find(writers[0].user_data);
  ASSERT_EQ(found.place, Place::here);
  Bytes bytes, expected;
  SampleInfo info;
  ASSERT_TRUE(found.reader->take(bytes, info));
  encode(batch, expected);
  EXPECT_EQ(bytes, expected);
  EXPECT_EQ(info.source_timestamp, sent) << "in memory and by DDS it is the same message";

  plain->write(bytes);
  ASSERT_TRUE(eventually([&] { return reader.take(batch); }));
  EXPECT_EQ(reader.info().writer, writers[1].id);
  EXPECT_FALSE(found.reader->take(bytes, info));

  shared.reset();
  EXPECT_TRUE(discovered(1));
}

// On the wire it counts in 2^-32 s; a batch must be the same in memory and by DDS.
TEST_P(DiscoveryOverVendors, ATimeStampIsReadAsItWasWritten) {
  const auto [from, to, domain] = GetParam();
  Bus a(from, {domain + 4}), b(to, {domain + 4});
  const auto writer = a.backend().writer(describe(topics::gantry_batch), {true, 2000});
  auto reader = b.backend().reader(describe(topics::gantry_batch), {true, 0}, nullptr);
  Bytes bytes;
  encode(idl::stream::AxisBatch{}, bytes);
  // All over a second, on no grid, in their order.
  std::vector<std::int64_t> sent(1000);
  for (std::size_t k = 0; k < sent.size(); ++k)
    sent[k] = 1'700'000'000'000'000'000 + static_cast<std::int64_t>(k) * 999983;
  for (const auto time : sent) ASSERT_TRUE(writer->write(bytes, time));
  SampleInfo info;
  for (const auto time : sent) {
    ASSERT_TRUE(eventually([&] { return reader->take(bytes, info); }));
    ASSERT_EQ(info.source_timestamp, time);
  }
}

INSTANTIATE_TEST_SUITE_P(Vendors, DiscoveryOverVendors,
                         testing::Values(std::tuple{Vendor::cyclonedds, Vendor::cyclonedds, 1},
                                         std::tuple{Vendor::fastdds, Vendor::fastdds, 2},
                                         std::tuple{Vendor::cyclonedds, Vendor::fastdds, 3},
                                         std::tuple{Vendor::fastdds, Vendor::cyclonedds, 4}),
                         [](const auto& it) {
                           return std::string(to_string(std::get<0>(it.param))) + "_to_" +
                                  to_string(std::get<1>(it.param));
                         });

}  // namespace
}  // namespace trunnion::bus

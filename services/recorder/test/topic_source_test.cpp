// SPDX-License-Identifier: Apache-2.0
#include "topic_source.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "bus/bus.hpp"
#include "contracts/topics.hpp"

namespace trunnion::recorder {
namespace {

using bus::Bytes;
using bus::DiscoveredWriter;

struct Sample {
  Bytes cdr;
  bus::SampleInfo info;
};

// The DDS side: what waits at its one reader is put there by the test.
class Side : public bus::Backend {
 public:
  std::unique_ptr<bus::RawWriter> writer(const bus::TopicDescription&, const bus::EndpointQos&) override {
    return nullptr;
  }
  std::unique_ptr<bus::RawReader> reader(const bus::TopicDescription&, const bus::EndpointQos& qos,
                                         bus::Signal*) override {
    ++readers;
    asked_for = qos;
    return std::make_unique<Reader>(*this);
  }
  bool discover(std::vector<DiscoveredWriter>&) override { return false; }
  bus::WriterOrigin origin_of(const bus::WriterId&) override { return {}; }

  int readers = 0;
  bus::EndpointQos asked_for;
  std::deque<Sample> waiting;

 private:
  class Reader : public bus::RawReader {
   public:
    explicit Reader(Side& side) : side_(side) {}
    ~Reader() override { --side_.readers; }
    bool take(Bytes& cdr, bus::SampleInfo& info) override {
      if (side_.waiting.empty()) return false;
      cdr = side_.waiting.front().cdr;
      info = side_.waiting.front().info;
      side_.waiting.pop_front();
      return true;
    }
    int matched() override { return 0; }

   private:
    Side& side_;
  };
};

class Batches : public testing::Test {
 protected:
  static constexpr bus::WriterId here{1}, elsewhere{2};
  static DiscoveredWriter writer(bus::WriterId id, const std::string& address,
                                 const std::string& topic = topics::path_batch.name) {
    return {id, topic, bus::find_topic(topic)->description.wire_type, address};
  }
  static Sample sample(std::uint8_t number, bus::WriterId id, std::int64_t time) {
    return {Bytes(8, number), {time, id}};
  }
  // The first byte of every message there is.
  static std::vector<int> taken(TopicSource& topic) {
    std::vector<int> result;
    Bytes cdr;
    bus::SampleInfo info;
    while (topic.take(cdr, info)) result.push_back(cdr.at(0));
    return result;
  }
  void write(std::uint8_t number, std::int64_t time) const { history->write(time, Bytes(8, number)); }

  Side side;
  std::unique_ptr<bus::SharedHistory> history = bus::SharedHistory::make();
  TopicSource topic{side, *bus::find_topic("path_batch"), nullptr};
};

using Numbers = std::vector<int>;

TEST_F(Batches, ThoseOfAWriterInMemoryNeedNoReaderOfDds) {
  topic.begin(100);
  topic.see({writer(here, history->address())});
  EXPECT_TRUE(topic.has_writer());
  EXPECT_EQ(side.readers, 0);
  write(1, 104);
  write(2, 112);
  EXPECT_EQ(taken(topic), (Numbers{1, 2}));
}

TEST_F(Batches, AReaderOfDdsIsThereOnlyWhileAWriterNeedsIt) {
  topic.begin(100);
  topic.see({writer(here, history->address()), writer(elsewhere, "")});
  EXPECT_EQ(side.readers, 1);
  EXPECT_TRUE(side.asked_for.transient_local) << "what it wrote before it was discovered is recorded";
  write(1, 104);
  side.waiting = {sample(7, elsewhere, 104), sample(1, here, 104), sample(8, elsewhere, 112)};
  EXPECT_EQ(taken(topic), (Numbers{1, 7, 8})) << "each once";
  topic.see({writer(here, history->address())});
  side.waiting = {sample(9, elsewhere, 120)};
  EXPECT_EQ(taken(topic), Numbers{9}) << "what had come before the writer left";
  EXPECT_EQ(side.readers, 0);
}

TEST_F(Batches, ThoseOfAnotherTopicOrContractAreNotTaken) {
  auto foreign = writer(here, history->address());
  foreign.wire_type += "x";
  topic.begin(100);
  topic.see({foreign, writer(elsewhere, "", topics::gantry_batch.name)});
  write(1, 104);
  EXPECT_EQ(taken(topic), Numbers{});
  EXPECT_FALSE(topic.has_writer());
  EXPECT_EQ(side.readers, 0);
}

TEST_F(Batches, SetpointsOfBeforeTheBeginningAreLeftOutAndFeedbackIsNot) {
  TopicSource feedback(side, *bus::find_topic("feedback"), nullptr);
  topic.see({writer(here, history->address())});
  feedback.see({writer(here, history->address(), topics::feedback.name)});
  write(1, 50);
  EXPECT_EQ(taken(topic), Numbers{});
  EXPECT_EQ(taken(feedback), Numbers{1});
  write(2, 92);
  topic.begin(100);
  feedback.begin(100);
  write(3, 100);
  EXPECT_EQ(taken(topic), Numbers{3});
  EXPECT_EQ(topic.left_out(), 92) << "a service may not have it yet";
  EXPECT_EQ(taken(feedback), (Numbers{2, 3}));
  EXPECT_EQ(feedback.left_out(), 0);
}

TEST_F(Batches, AWriterThatDiscoveryLosesForAWhileIsReadOnAndNothingOfItIsTakenTwice) {
  topic.begin(100);
  topic.see({writer(here, history->address())});
  write(1, 104);
  EXPECT_EQ(taken(topic), Numbers{1});
  topic.see({});  // its lease has ended while it was suspended
  write(2, 112);
  EXPECT_EQ(taken(topic), Numbers{2});
  topic.see({writer({9}, history->address()), writer(elsewhere, "")});  // back, with another number
  write(3, 120);
  side.waiting = {sample(3, {9}, 120)};
  EXPECT_EQ(taken(topic), Numbers{3});
}

TEST_F(Batches, OfAWriterThatHasEndedAllIsTakenOnceAlsoWhatStillWaitsAtTheReaderOfDds) {
  topic.begin(100);
  topic.see({writer(here, history->address()), writer(elsewhere, "")});
  write(1, 104);
  write(2, 112);
  history.reset();
  side.waiting = {sample(1, here, 104), sample(2, here, 112)};
  topic.see({writer(elsewhere, "")});
  EXPECT_EQ(taken(topic), (Numbers{1, 2}));
  EXPECT_EQ(topic.overwritten(), 0u);
}

TEST(Topics, WithoutBatchesAreReadByDds) {
  Side side;
  TopicSource topic(side, *bus::find_topic("alarm"), nullptr);
  EXPECT_EQ(side.readers, 1);
  EXPECT_TRUE(side.asked_for.transient_local);
  topic.see({});
  side.waiting = {Sample{Bytes(8, 5), {}}};
  Bytes cdr;
  bus::SampleInfo info;
  EXPECT_TRUE(topic.take(cdr, info));
  EXPECT_FALSE(topic.take(cdr, info));
  EXPECT_EQ(side.readers, 1) << "every new writer is read";
}

// The process of a command writes its request when the service that it asks has discovered it; the recorder
// may do so later. What was written before the recorder was there has had its effect in the states it starts
// with.
TEST(Topics, RequestsAreReadFromWhatAWriterKeepsButNoneOfBeforeTheRecorder) {
  Side side;
  const std::int64_t before = bus::source_time();
  TopicSource topic(side, *bus::find_topic("channel_request"), nullptr);
  EXPECT_TRUE(side.asked_for.transient_local);
  EXPECT_TRUE(bus::writer_qos(bus::QosKind::event, {}).transient_local);
  EXPECT_FALSE(bus::reader_qos(bus::QosKind::event).transient_local) << "no service acts on an old request";
  side.waiting = {Sample{Bytes(8, 1), {before - 1, {}}}, Sample{Bytes(8, 2), {bus::source_time(), {}}}};
  Bytes cdr;
  bus::SampleInfo info;
  ASSERT_TRUE(topic.take(cdr, info));
  EXPECT_EQ(cdr.at(0), 2);
  EXPECT_FALSE(topic.take(cdr, info));
}

}  // namespace
}  // namespace trunnion::recorder

// SPDX-License-Identifier: Apache-2.0
#include "bus/contract.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace trunnion::bus {
namespace {

TopicEntry topic(const std::string& name, const std::string& type, std::vector<std::string> writers,
                 std::vector<std::string> readers) {
  TopicEntry entry{};
  entry.description.name = name, entry.description.wire_type = type;
  entry.writers = std::move(writers), entry.readers = std::move(readers);
  return entry;
}

class Contract : public testing::Test {
 protected:
  std::vector<TopicEntry> topics_{topic("rows", "Rows_1", {"stage"}, {"drive"}),
                                  topic("state", "State_1", {"all"}, {"deploy"}),
                                  topic("image", "Image_1", {"plc"}, {"gateway"})};
  const std::string stage_ = contract_of("stage", topics_), plc_ = contract_of("plc", topics_);
};

TEST_F(Contract, ATypeThatAServiceDoesNotUseMayChange) {
  topics_[2].description.wire_type = "Image_2";
  EXPECT_EQ(contract_of("stage", topics_), stage_);
  EXPECT_NE(contract_of("plc", topics_), plc_);
}

TEST_F(Contract, ATopicOfAllServicesIsEveryOnes) {
  topics_[1].description.wire_type = "State_2";
  EXPECT_NE(contract_of("stage", topics_), stage_);
  EXPECT_NE(contract_of("plc", topics_), plc_);
}

TEST_F(Contract, NameAndQualityOfServiceBelongToIt) {
  auto renamed = topics_, other_quality = topics_;
  renamed[0].description.name = "rows/2";
  other_quality[0].qos = QosKind::event;
  for (const auto& changed : {renamed, other_quality}) {
    EXPECT_NE(contract_of("stage", changed), stage_);
    EXPECT_EQ(contract_of("plc", changed), plc_);
  }
}

TEST_F(Contract, ANewTopicOfOthersAndTheOrderOfTheTableChangeNothing) {
  topics_.insert(topics_.begin(), topic("new", "New_1", {"plc"}, {"gateway"}));
  std::mt19937 random(7);
  std::shuffle(topics_.begin(), topics_.end(), random);
  EXPECT_EQ(contract_of("stage", topics_), stage_);
  EXPECT_NE(contract_of("plc", topics_), plc_);
}

// FNV-1a of "rows Rows_1 batch\nstate State_1 batch\n", computed beside this program:
// python3 -c "h=0xcbf29ce484222325
// for c in b'rows Rows_1 batch\nstate State_1 batch\n': h=(h^c)*0x100000001b3%2**64
// print('%016x'%h)"
TEST_F(Contract, IsTheHashThatOthersCompute) { EXPECT_EQ(stage_, "92c66362c655b453"); }

TEST(Contracts, OfTheServicesAreAllDifferent) {
  std::vector<std::string> all;
  for (const auto* service : {"channel", "kinematics", "compensation", "gantry", "plc", "drive", "gateway"})
    all.push_back(contract_of(service));
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
}

}  // namespace
}  // namespace trunnion::bus

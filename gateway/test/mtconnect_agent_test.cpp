// SPDX-License-Identifier: Apache-2.0
#include "mtconnect/agent.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

namespace trunnion::gateway::mtconnect {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(MtconnectBuffer, HasTheStateAfterEveryObservationThatItKeeps) {
  // Against a replay of everything from the beginning, for buffers that have lost some and none.
  std::mt19937 random(11);
  for (const std::size_t size : {1u, 7u, 50u, 1000u}) {
    const std::vector<bool> conditions{false, false, true};
    Buffer buffer(size, conditions);
    std::vector<Observation> all;
    for (std::uint64_t sequence = 1; sequence <= 300; ++sequence) {
      Observation one;
      one.item = static_cast<std::uint32_t>(random() % 3);
      one.value = std::to_string(random() % 5);
      if (one.item == 2) {
        one.code = "c" + std::to_string(random() % 3);
        one.level = random() % 2 == 0 ? Level::normal : Level::fault;
      }
      buffer.add(one);
      one.sequence = sequence;
      all.push_back(one);
    }
    EXPECT_EQ(buffer.first(), size >= 300 ? 1 : 301 - size);
    EXPECT_EQ(buffer.last(), 300u);
    for (auto sequence = buffer.first(); sequence <= buffer.last(); ++sequence) {
      State expected;
      for (std::uint64_t i = 0; i < sequence; ++i) expected.apply(all[i], conditions[all[i].item]);
      std::vector<std::uint64_t> a, b;
      for (const auto* one : expected.all()) a.push_back(one->sequence);
      const auto state = buffer.state(sequence);
      for (const auto* one : state.all()) b.push_back(one->sequence);
      ASSERT_EQ(a, b) << size << " " << sequence;
    }
  }
}

Observation condition(Level level, const std::string& code) {
  Observation one;
  one.level = level;
  one.code = code;
  return one;
}

TEST(MtconnectState, HasEveryActiveConditionAndIsNormalWhenTheLastHasGone) {
  State state;
  state.apply(condition(Level::normal, ""), true);
  state.apply(condition(Level::fault, "a"), true);
  state.apply(condition(Level::warning, "b"), true);
  ASSERT_EQ(state.all().size(), 2u);
  state.apply(condition(Level::normal, "a"), true);
  ASSERT_EQ(state.all().size(), 1u);
  EXPECT_EQ(state.all()[0]->code, "b");
  state.apply(condition(Level::normal, "b"), true);
  ASSERT_EQ(state.all().size(), 1u);
  EXPECT_EQ(state.all()[0]->level, Level::normal);
  EXPECT_EQ(state.all()[0]->code, "");
}

struct Machine {
  ClusterState cluster;
  Agent agent;
  int observed = 0;

  explicit Machine(std::size_t buffer = 1000) : agent(settings(buffer)) {
    auto parameters = std::make_shared<idl::parameters::ParameterSet>();
    parameters->revision = 1;
    parameters->values = {{100000, 0, "X"}, {100001, 1, ""}, {106000, 0, "C"}, {106001, 3, ""}};
    cluster.set_parameters(parameters);
    auto& state = cluster.channels[0];
    state.name = "mill & turn";
    state.program = "A<B>.NC";
    state.letters = "XC";
    state.workpiece = {1, 2};
    cluster.document = {{"cluster", {{"machine", "m"}}},
                        {"services",
                         {{"4", {{"service", "channel"}, {"alive", true}}},
                          {"5", {{"service", "drive"}, {"alive", true}}},
                          {"6", {{"service", "plc"}, {"alive", true}}}}},
                        {"axes", {{"0", {{"actual", 1.25}}}, {"6", {{"actual", 90}}}}},
                        {"plc", {{"emergency_stop", false}}}};
  }
  static AgentSettings settings(std::size_t buffer) {
    AgentSettings settings;
    settings.machine = "mill", settings.title = "Mill", settings.computer = "host",
    settings.buffer_size = buffer;
    settings.channel_of = {{4, 0}};
    return settings;
  }
  void observe() {
    char time[40];
    std::snprintf(time, sizeof time, "2026-01-01T00:00:%02d.000Z", observed++ % 60);
    agent.observe(cluster, time);
  }
  std::string get(const std::string& target) {
    return agent.answer(agent.parse("GET", target), "2026-01-01T00:01:00.000Z");
  }
};

TEST(MtconnectAgent, KnowsNoDeviceBeforeTheMachineHasPublished) {
  Machine machine;
  EXPECT_THROW(machine.get("/probe"), RequestError);
  machine.cluster.channels.clear();
  machine.observe();
  EXPECT_EQ(machine.agent.device(), nullptr);
}

TEST(MtconnectAgent, ObservesChangesAlone) {
  Machine machine;
  machine.observe();
  const auto next = machine.agent.buffer().next();
  machine.observe();
  EXPECT_EQ(machine.agent.buffer().next(), next);
  machine.cluster.document["axes"]["0"]["actual"] = 1.5;
  machine.cluster.document["axes"]["6"]["actual"] = 90.00001;  // less than the 4 digits that are kept
  machine.observe();
  EXPECT_EQ(machine.agent.buffer().next(), next + 1);
  EXPECT_THAT(machine.get("/sample?from=" + std::to_string(next)), HasSubstr(">1.5</Position>"));
}

TEST(MtconnectAgent, WhatASilentServiceKnowsIsUnavailable) {
  Machine machine;
  machine.observe();
  EXPECT_THAT(machine.get("/current?path=//Linear"), HasSubstr(">1.25</Position>"));
  machine.cluster.document["services"]["5"]["alive"] = false;
  machine.cluster.document["services"]["5"]["expected"] = true;
  machine.observe();
  EXPECT_THAT(machine.get("/current?path=//Linear"), HasSubstr(">UNAVAILABLE</Position>"));
  EXPECT_THAT(machine.get("/current?path=//Controller"),
              HasSubstr("drive (instance 5) sends no heartbeat</Fault>"));
  EXPECT_THAT(machine.get("/current?path=//Path"), HasSubstr(">READY</Execution>"));
}

TEST(MtconnectAgent, EscapesWhatXmlDoesNotPermit) {
  Machine machine;
  machine.cluster.channels[0].program = std::string("A<B>&\"\x01.NC");
  machine.observe();
  EXPECT_THAT(machine.get("/current"), HasSubstr(">A&lt;B&gt;&amp;\"?.NC</Program>"));
  EXPECT_THAT(machine.get("/probe"), HasSubstr("name=\"mill &amp; turn\""));
}

TEST(MtconnectAgent, RefusesWhatTheBufferHasLost) {
  Machine machine(40);
  for (int i = 0; i < 100; ++i) {
    machine.cluster.document["axes"]["0"]["actual"] = i;
    machine.observe();
  }
  const auto first = machine.agent.buffer().first();
  EXPECT_GT(first, 1u);
  EXPECT_THROW(machine.get("/sample?from=" + std::to_string(first - 1)), RequestError);
  EXPECT_NO_THROW(machine.get("/sample?from=" + std::to_string(first)));
  EXPECT_NO_THROW(machine.get("/sample?from=" + std::to_string(machine.agent.buffer().next())));
  EXPECT_THAT(machine.get("/current"), HasSubstr(">READY</Execution>"))
      << "older than the buffer, and still so";
}

TEST(MtconnectAgent, ANewAxisIsANewDeviceWithANewInstance) {
  Machine machine;
  machine.observe();
  EXPECT_THAT(machine.get("/probe"), HasSubstr("instanceId=\"1\""));
  auto parameters = std::make_shared<idl::parameters::ParameterSet>(*machine.cluster.parameters);
  parameters->revision = 2;
  machine.cluster.set_parameters(parameters);
  machine.observe();
  EXPECT_THAT(machine.get("/probe"), HasSubstr("instanceId=\"1\"")) << "a revision with the same axes";
  parameters = std::make_shared<idl::parameters::ParameterSet>(*parameters);
  parameters->revision = 3;
  parameters->values.insert(parameters->values.begin() + 2, {{101000, 0, "Y"}, {101001, 1, ""}});
  machine.cluster.set_parameters(parameters);
  machine.observe();
  EXPECT_THAT(machine.get("/probe"), HasSubstr("instanceId=\"2\""));
  EXPECT_EQ(machine.agent.buffer().first(), 1u);
}

TEST(MtconnectAgent, ReportsToolsThatChangeAndThatAreRemoved) {
  Machine machine;
  auto table = std::make_shared<idl::parameters::ToolTable>();
  table->tools = {{1, 100, 0, 5, 0, "drill"}, {2, 50, 0, 3, 0, ""}};
  machine.cluster.tools = table;
  machine.observe();
  EXPECT_THAT(machine.get("/current"), HasSubstr("assetType=\"CuttingTool\">UNAVAILABLE</AssetChanged>"));
  table = std::make_shared<idl::parameters::ToolTable>(*table);
  table->tools[0].length_wear = -0.5;
  machine.cluster.tools = table;
  machine.observe();
  EXPECT_THAT(machine.get("/current"), HasSubstr(">T1</AssetChanged>"));
  EXPECT_THAT(machine.get("/asset/T1"), HasSubstr(">99.5</FunctionalLength>"));
  table = std::make_shared<idl::parameters::ToolTable>(*table);
  table->tools.pop_back();
  machine.cluster.tools = table;
  machine.observe();
  EXPECT_THAT(machine.get("/current"), HasSubstr(">T2</AssetRemoved>"));
  EXPECT_THAT(machine.get("/assets"), Not(HasSubstr("T2")));
  EXPECT_THAT(machine.get("/assets?removed=true"), HasSubstr("assetId=\"T2\""));
}

TEST(MtconnectDocument, HasARowForEveryDataItemThatIsMade) {
  std::ifstream file(MTCONNECT_DOCUMENT);
  std::stringstream text;
  text << file.rdbuf();
  for (const auto quantity : all_quantities()) {
    const auto& type = type_of(quantity);
    const char* const categories[] = {"SAMPLE", "EVENT", "CONDITION"};
    std::string row = std::string("| ") + type.type + " | " + (*type.sub_type != 0 ? type.sub_type : "–") +
                      " | " + categories[static_cast<int>(type.category)] + " | " +
                      (*type.units != 0 ? type.units : "–") + " | " + type.source + " |";
    EXPECT_THAT(text.str(), HasSubstr(row));
  }
}

}  // namespace
}  // namespace trunnion::gateway::mtconnect

// SPDX-License-Identifier: Apache-2.0
#include "core/operator_journal.hpp"

#include <gtest/gtest.h>

#include <set>

#include "bus/codec.hpp"
#include "storage/crc32.hpp"

namespace trunnion::gateway {
namespace {

using idl::gateway::Sender;

TEST(Journal, KeepsWhatMakesTheGatewayWriteToTheBusAndNoMereReading) {
  std::set<std::string> read;
  for (const auto& route : routes())
    if (!is_journaled(route.operation)) read.insert(std::string(route.pattern));
  EXPECT_EQ(read, (std::set<std::string>{"/api/status",
                                         "/api/alarms",
                                         "/api/alarms/history",
                                         "/api/channels",
                                         "/api/channels/{channel}",
                                         "/api/bodies/{channel}",
                                         "/api/parameters",
                                         "/api/parameters/{number}",
                                         "/api/tools",
                                         "/api/work-offsets",
                                         "/api/programs",
                                         "/api/plc/image",
                                         "/api/measurement",
                                         "/api/measurement/inputs",
                                         "/api/measurement/undo",
                                         "/api/measurement/manual",
                                         "/api/variables/{channel}",
                                         "/api/openapi.json",
                                         "/api/stream",
                                         "/api/session",
                                         "/api/recordings",
                                         "/api/recordings/{name}",
                                         "/api/recordings/{name}/table",
                                         "/api/recordings/{name}/stop",
                                         "/api/operating-right",
                                         "/api/plc/programs",
                                         "/api/plc/programs/{file}",
                                         "/api/plc/variables",
                                         "/api/plc/watch",
                                         "/api/plc/forces",
                                         "/api/plc/tasks",
                                         "/api/plc/uses",
                                         "/api/plc/force",
                                         "/api/plc/release",
                                         "/api/plc/trace",
                                         "/api/plc/load",
                                         "/api/plc/load/compare",
                                         "/api/plc/load/take-over"}))
      << "recordings are files: nothing of them is on the bus; the PLC has a journal of its own";
  EXPECT_TRUE(is_journaled(Operation::read_program)) << "it asks the program service";
}

TEST(Journal, ATextThatFitsIsKeptInPartsAndALongerOneIsItsSizeAndSumAlone) {
  auto line = begin_line(Sender::TOOL, "127.0.0.1", "PUT", "/api/programs/A");
  const std::string part(512, 'x');
  add_body(line, part);
  add_body(line, part);
  EXPECT_EQ(line.body, part + part) << "1024 bytes are the bound";
  EXPECT_EQ(line.body_crc32, storage::crc32(part + part));
  add_body(line, "y");
  EXPECT_EQ(line.body, "");
  EXPECT_EQ(line.body_size, 1025u);
  EXPECT_EQ(line.body_crc32, storage::crc32(part + part + "y"));
  add_answer(line, "{}");
  EXPECT_EQ(line.answer, "{}");
  EXPECT_EQ(line.answer_size, 2u);
}

TEST(Journal, NoRequestHoweverLongIsBeyondTheBoundsOfTheLine) {
  const std::string text(100000, '/');
  auto line = begin_line(Sender::PAGE, text, text, text);
  set_user(line, {text, access::Role::setter});
  add_body(line, text);
  add_answer(line, text);
  bus::Bytes bytes;
  EXPECT_NO_THROW(bus::encode(line, bytes));
  EXPECT_EQ(line.target.size(), 256u);
  EXPECT_EQ(line.role, 1);
}

}  // namespace
}  // namespace trunnion::gateway

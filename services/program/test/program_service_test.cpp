// SPDX-License-Identifier: Apache-2.0
// The executable over DDS: upload, download, kill -9.
#include <gtest/gtest.h>

#include "contracts/topics.hpp"
#include "service/request.hpp"
#include "storage/crc32.hpp"
#include "testing_support/running_service.hpp"

namespace trunnion::program {
namespace {

using idl::program::Operation;
using testing_support::eventually;
using testing_support::RunningService;
constexpr int domain = 62;

TEST(ProgramServiceOverDds, AnUploadComesBackTheSameAndSurvivesAKill) {
  RunningService service(TRUNNION_PROGRAM, "program", domain);
  service.write("machine/programs/delivered.nc", "M30\n");
  service.write("machine/cycles/O9000.nc", "M99\n");
  service.start();

  bus::Bus bus(bus::Vendor::cyclonedds, {domain});
  auto lists = bus.reader(topics::program_list);
  service::RequestClient<idl::program::ProgramRequest, idl::program::ProgramReply> client(
      bus, topics::program_request, topics::program_reply);
  idl::program::ProgramList list;
  const auto listed = [&](std::size_t count) {
    return eventually([&] { return lists.take_newest(list), list.programs.size() == count; });
  };
  ASSERT_TRUE(listed(1));
  EXPECT_EQ(list.programs[0].name, "delivered.nc");

  std::vector<std::uint8_t> text;
  for (int i = 0; i < 10000; ++i)
    for (const char c : "G1 X" + std::to_string(i) + "\n") text.push_back(static_cast<std::uint8_t>(c));
  idl::program::ProgramRequest request;
  const auto call = [&](Operation operation) {
    request.operation = operation;
    request.name = "part.nc";
    const auto reply = client.call(request, 10);
    EXPECT_TRUE(reply && reply->accepted) << (reply ? reply->reason : "no answer");
    return reply.value_or(idl::program::ProgramReply{});
  };
  call(Operation::BEGIN_UPLOAD);
  for (std::size_t at = 0; at < text.size(); at += 60000) {
    request.offset = at;
    request.data.assign(text.begin() + static_cast<std::ptrdiff_t>(at),
                        text.begin() + static_cast<std::ptrdiff_t>(std::min(at + 60000, text.size())));
    call(Operation::WRITE);
  }
  request.data.clear();
  request.size = text.size();
  request.crc32 = storage::crc32(0, text);
  EXPECT_EQ(call(Operation::COMMIT_UPLOAD).entry.lines, 10000u);
  ASSERT_TRUE(listed(2));

  service.kill_hard();
  service.start();
  std::vector<std::uint8_t> back;
  request.length = 60000;
  request.revision = 1;
  while (back.size() < text.size()) {
    request.offset = back.size();
    const auto reply = call(Operation::READ);
    ASSERT_FALSE(reply.data.empty());
    back.insert(back.end(), reply.data.begin(), reply.data.end());
  }
  EXPECT_EQ(back, text);
  request.name = "%9000";
  request.operation = Operation::RESOLVE;
  const auto reply = client.call(request, 10);
  ASSERT_TRUE(reply.has_value());
  EXPECT_EQ(reply->entry.name, "O9000.nc");
}

}  // namespace
}  // namespace trunnion::program

// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <random>

#include "modbus_link.hpp"
#include "modbus_peer.hpp"

namespace trunnion::plc {
namespace {

using testing::HasSubstr;

st::ModbusFile device_file(int port) {
  const std::string yaml = "devices:\n  valves:\n    host: 127.0.0.1\n    port: " + std::to_string(port) +
                           "\n    period_ms: 5\n    timeout_ms: 200\n    inputs:\n"
                           "      - {table: discrete_inputs, address: 3, count: 10, at: X32, at_loss: 0}\n"
                           "      - {table: input_registers, address: 5, count: 2, at: X40, at_loss: 4660}\n"
                           "      - {table: holding_registers, address: 60, count: 1, at: X50}\n"
                           "    outputs:\n      - {table: coils, address: 8, count: 9, at: Y32.4}\n"
                           "      - {table: holding_registers, address: 20, count: 4, at: D7}\n";
  return st::read_modbus(yaml, "modbus.yaml");
}

st::ModbusFile server_file(int port, const std::string& more = "") {
  return st::read_modbus("server:\n  port: " + std::to_string(port) + "\n" + more +
                             "  inputs:\n    - {table: coils, address: 10, count: 12, at: X60, at_loss: 1}\n"
                             "    - {table: holding_registers, address: 0, count: 2, at: X64}\n"
                             "  outputs:\n    - {table: discrete_inputs, address: 100, count: 8, at: R9}\n"
                             "    - {table: input_registers, address: 7, count: 2, at: W20}\n",
                         "modbus.yaml");
}

class Linked {
 public:
  explicit Linked(const st::ModbusFile& file) : link(file) {}
  /// Exchanges like the PLC until it is true.
  template <class Condition>
  bool until(Condition condition) {
    for (int i = 0; i < 12000; ++i) {  // a minute at least, which only ends a hang
      link.exchange(registers);
      for (std::size_t b = 0; b < register_count; ++b) registers.x[b] = link.inputs().in(registers.x[b], b);
      if (condition()) return true;
      usleep(5000);
    }
    return false;
  }
  Registers registers;
  ModbusLink link;
};

TEST(ModbusDevice, ExchangesBitsAndWords) {
  const int port = free_port();
  Device device(port);
  {
    const std::lock_guard lock(device.mutex);
    device.inputs[3] = device.inputs[12] = true,
    device.inputs[13] = true;  // the first, the last and one behind
    device.input_registers[5] = 0x1234, device.input_registers[6] = 0xfffe, device.holding_registers[60] = 77;
  }
  Linked plc(device_file(port));
  plc.registers.x[33] = 0xf0;                              // bits beside those of the device stay
  plc.registers.y[32] = 0x90, plc.registers.y[33] = 0x03;  // Y32.4, Y32.7, Y33.0, Y33.1
  plc.registers.d[7] = -2, plc.registers.d[8] = 0x12345678;
  ASSERT_TRUE(plc.until([&] { return plc.registers.x[32] == 0x01 && plc.registers.x[50] == 77; }))
      << plc.link.problem(0);
  EXPECT_EQ(plc.registers.x[33], 0xf2);
  EXPECT_EQ(plc.registers.x[40] | plc.registers.x[41] << 8, 0x1234);
  EXPECT_EQ(plc.registers.x[42] | plc.registers.x[43] << 8, 0xfffe);
  EXPECT_EQ(plc.link.problem(0), "");
  ASSERT_TRUE(plc.until([&] {
    const std::lock_guard lock(device.mutex);
    return device.coils[8] && device.holding_registers[23] != 0;  // the output that is written last
  }));
  const std::lock_guard lock(device.mutex);
  std::string coils;
  for (std::size_t i = 7; i < 18; ++i) coils += device.coils[i] ? '1' : '0';
  EXPECT_EQ(coils, "01001110000");
  EXPECT_EQ(device.holding_registers[20], 0xfffe);
  EXPECT_EQ(device.holding_registers[21], 0xffff);
  EXPECT_EQ(device.holding_registers[22], 0x5678);
  EXPECT_EQ(device.holding_registers[23], 0x1234);
}

TEST(ModbusDevice, WithoutConnectionTheInputsAreThoseForThatCaseAndComeBack) {
  const int port = free_port();
  Device device(port);
  device.inputs[3] = true, device.input_registers[5] = 1, device.holding_registers[60] = 9;
  Linked plc(device_file(port));
  ASSERT_TRUE(plc.until([&] { return plc.registers.x[32] == 1 && plc.registers.x[50] == 9; }));
  device.stop();
  ASSERT_TRUE(plc.until([&] { return !plc.link.problem(0).empty() && plc.registers.x[32] == 0; }));
  EXPECT_EQ(plc.registers.x[40] | plc.registers.x[41] << 8, 4660);
  EXPECT_EQ(plc.registers.x[50], 9) << "without at_loss the last value stays";
  EXPECT_THAT(plc.link.problem(0),
              HasSubstr("The Modbus device 'valves' (127.0.0.1, port " + std::to_string(port)));
  EXPECT_THAT(plc.link.problem(0),
              HasSubstr("Its inputs X32 .. X33, X40 .. X43, X50 .. X51 have their values for this case"));
  device.start();
  EXPECT_TRUE(plc.until([&] { return plc.link.problem(0).empty() && plc.registers.x[32] == 1; }));
}

TEST(ModbusDevice, WhatNeverAnswersHasTheInputsWithoutConnection) {
  Linked plc(device_file(free_port()));
  EXPECT_TRUE(plc.until([&] { return (plc.registers.x[40] | plc.registers.x[41] << 8) == 4660; }));
}

TEST(ModbusDevice, ARefusalIsNamed) {
  const int port = free_port();
  Device device(port);
  auto file = device_file(port);
  file.devices[0].inputs[0].address = 60;  // 60 .. 69 of 64
  Linked plc(file);
  ASSERT_TRUE(plc.until([&] { return !plc.link.problem(0).empty(); }));
  EXPECT_THAT(plc.link.problem(0), HasSubstr("refuses a request: Illegal data address"));
}

// Silence, bytes cut off, added or changed, other transactions: never a wrong length, and afterwards it
// works.
TEST(ModbusDevice, SpoiltAnswersLeadToAProblemAndNotFurther) {
  const int port = free_port();
  Device device(port);
  device.inputs[3] = true;
  auto file = device_file(port);
  file.devices[0].timeout = 0.03;
  Linked plc(file);
  std::mt19937 random(4);
  int problems = 0;
  {
    const std::lock_guard lock(device.mutex);
    device.spoil = [&](Bytes bytes) {
      switch (random() % 5) {
        case 0:
          return Bytes{};
        case 1:
          bytes.resize(random() % bytes.size());
          return bytes;
        case 2:
          bytes.push_back(static_cast<std::uint8_t>(random()));
          return bytes;
        case 3:
          bytes[random() % std::min<std::size_t>(bytes.size(), 9)] ^=
              static_cast<std::uint8_t>(1 + random() % 255);
          return bytes;
        default:
          return bytes;
      }
    };
  }
  for (int i = 0; i < 300; ++i) {
    plc.link.exchange(plc.registers);
    problems += plc.link.problem(0).empty() ? 0 : 1;
    usleep(5000);
  }
  EXPECT_GT(problems, 10);
  {
    const std::lock_guard lock(device.mutex);
    device.spoil = nullptr;
  }
  EXPECT_TRUE(plc.until([&] { return plc.link.problem(0).empty() && plc.registers.x[32] == 1; }));
}

TEST(ModbusServer, OthersReadOutputsAndWriteInputs) {
  const int port = free_port();
  Linked plc(server_file(port));
  plc.registers.r[9] = 0xa5, plc.registers.w[20] = 0x1234, plc.registers.w[21] = 0xffff;
  Asking other(port);
  ASSERT_TRUE(other.connected());
  ASSERT_TRUE(plc.until([] { return true; }));
  EXPECT_EQ(other.ask({2, 0, 100, 0, 8}), (Bytes{2, 1, 0xa5}));
  EXPECT_EQ(other.ask({4, 0, 7, 0, 2}), (Bytes{4, 4, 0x12, 0x34, 0xff, 0xff}));
  // Coils 10 .. 21 are X60.0 .. X61.3: 1 without a connection, the first is written now.
  EXPECT_EQ(other.ask({15, 0, 10, 0, 12, 2, 0x05, 0x08}), (Bytes{15, 0, 10, 0, 12}));
  EXPECT_EQ(other.ask({5, 0, 12, 0, 0}), (Bytes{5, 0, 12, 0, 0}));
  EXPECT_EQ(other.ask({16, 0, 0, 0, 2, 4, 0xab, 0xcd, 0, 7}), (Bytes{16, 0, 0, 0, 2}));
  EXPECT_EQ(other.ask({22, 0, 0, 0xf0, 0xff, 0, 0}), (Bytes{22, 0, 0, 0xf0, 0xff, 0, 0}));
  // 16#ABCD by the mask AND 16#F0FF.
  ASSERT_TRUE(plc.until([&] { return (plc.registers.x[64] | plc.registers.x[65] << 8) == 0xa0cd; }));
  EXPECT_EQ(plc.registers.x[60], 0x01);
  EXPECT_EQ(plc.registers.x[61], 0x08);
  EXPECT_EQ(plc.registers.x[66], 7);
  EXPECT_EQ(other.ask({1, 0, 10, 0, 12}), (Bytes{1, 2, 0x01, 0x08}));
  EXPECT_EQ(other.ask({3, 0, 1, 0, 1}), (Bytes{3, 2, 0, 7}));
  EXPECT_EQ(plc.link.problem(0), "");
}

TEST(ModbusServer, WhatIsNotServedIsRefusedWithTheExceptionOfTheStandard) {
  const int port = free_port();
  Linked plc(server_file(port));
  Asking other(port);
  ASSERT_TRUE(other.connected());
  EXPECT_EQ(other.ask({2, 0, 99, 0, 8}), (Bytes{0x82, 2}));
  EXPECT_EQ(other.ask({2, 0, 100, 0, 9}), (Bytes{0x82, 2}));
  EXPECT_EQ(other.ask({4, 0, 0, 0, 1}), (Bytes{0x84, 2}));
  EXPECT_EQ(other.ask({5, 0, 9, 0xff, 0}), (Bytes{0x85, 2}));
  EXPECT_EQ(other.ask({6, 0, 2, 0, 1}), (Bytes{0x86, 2}));
  EXPECT_EQ(other.ask({15, 0, 10, 0, 12, 1, 0x05}), (Bytes{0x8f, 3})) << "12 bits are two bytes";
  EXPECT_EQ(other.ask({16, 0, 1, 0, 2, 4, 0, 0, 0, 0}), (Bytes{0x90, 2}));
  EXPECT_EQ(other.ask({2, 0, 100, 0, 8}), (Bytes{2, 1, 0}));
}

// So that a PLC that was restarted keeps what the other device does not write again.
TEST(ModbusServer, OnlyWhatIsWrittenChanges) {
  const int port = free_port();
  Linked plc(server_file(port));
  plc.registers.x[60] = 0x55, plc.registers.x[61] = 0x05, plc.registers.x[64] = 7, plc.registers.x[66] = 8;
  Asking other(port);
  ASSERT_EQ(other.ask({5, 0, 11, 0xff, 0}).size(), 5u);
  ASSERT_EQ(other.ask({6, 0, 1, 0x12, 0x34}).size(), 5u);
  ASSERT_TRUE(plc.until([&] { return plc.registers.x[66] == 0x34; }));
  EXPECT_EQ(plc.registers.x[60], 0x57);
  EXPECT_EQ(plc.registers.x[61], 0x05);
  EXPECT_EQ(plc.registers.x[64], 7);
  EXPECT_EQ(plc.registers.x[67], 0x12);
  ASSERT_EQ(other.ask({15, 0, 17, 0, 3, 1, 0x01}).size(), 5u);
  EXPECT_TRUE(plc.until([&] { return plc.registers.x[60] == 0xd7 && plc.registers.x[61] == 0x04; }));
}

TEST(ModbusServer, SilenceIsALossWhenATimeIsGiven) {
  const int port = free_port();
  Linked plc(server_file(port, "  timeout_ms: 150\n"));
  {
    Asking other(port);
    ASSERT_EQ(other.ask({15, 0, 10, 0, 12, 2, 0, 0}).size(), 5u);
    ASSERT_TRUE(plc.until([&] { return plc.registers.x[60] == 0; }));
  }
  ASSERT_TRUE(plc.until([&] { return plc.registers.x[60] == 0xff && plc.registers.x[61] == 0x0f; }));
  EXPECT_THAT(plc.link.problem(0),
              HasSubstr("no other device has written for 150 ms. The inputs X60 .. X61, X64 .. X67"));
  Asking again(port);
  ASSERT_EQ(again.ask({5, 0, 10, 0, 0}).size(), 5u);
  EXPECT_TRUE(plc.until([&] { return plc.registers.x[60] == 0xfe && plc.link.problem(0).empty(); }));
}

// Frames of random bytes, with right and wrong headers, and ends in the middle: the next connection is
// served.
TEST(ModbusServer, MalformedFramesAndDisconnectsHurtNobodyElse) {
  const int port = free_port();
  Linked plc(server_file(port));
  plc.registers.r[9] = 0x5a;
  ASSERT_TRUE(plc.until([] { return true; }));
  std::mt19937 random(9);
  for (int round = 0; round < 150; ++round) {
    Asking bad(port);
    ASSERT_TRUE(bad.connected()) << round;
    for (int n = 0; n < 5; ++n) {
      Bytes data(1 + random() % 40);
      for (auto& byte : data) byte = static_cast<std::uint8_t>(random() % 3 == 0 ? random() : random() % 24);
      if (random() % 2 == 0) data = framed(random() % 65536, 1, data);
      if (random() % 4 == 0) data.resize(1 + random() % data.size());
      bad.send_bytes(data);
    }
  }
  Asking good(port);
  EXPECT_EQ(good.ask({2, 0, 100, 0, 8}), (Bytes{2, 1, 0x5a}));
}

TEST(ModbusServer, TakesEightConnectionsAndGoesOnWhenSomeEnd) {
  const int port = free_port();
  Linked plc(server_file(port));
  for (int round = 0; round < 3; ++round) {
    std::vector<std::unique_ptr<Asking>> others;
    for (int i = 0; i < 8; ++i) {
      others.push_back(std::make_unique<Asking>(port));
      EXPECT_EQ(others.back()->ask({2, 0, 100, 0, 1}).size(), 3u) << round << " " << i;
    }
  }
}

TEST(ModbusServer, IdleConnectionsShutNobodyOut) {
  const int port = free_port();
  Linked plc(server_file(port));
  const auto answers = [](Asking& one) { return one.ask({2, 0, 100, 0, 1}).size() == 3; };
  Asking busy(port);
  std::vector<std::unique_ptr<Asking>> idle;
  for (int i = 0; i < 24; ++i) {
    EXPECT_TRUE(answers(busy)) << "one that asks is kept, before " << i;
    idle.push_back(std::make_unique<Asking>(port));
    EXPECT_TRUE(answers(*idle.back())) << i;
  }
  EXPECT_FALSE(answers(*idle.front())) << "the one that had been silent for longest was ended";
}

// A slow device: the rest of a request comes after others have been answered for as long as they like.
TEST(ModbusServer, HalfOfARequestHoldsUpNobodyAndMayBeCompleted) {
  const int port = free_port();
  Linked plc(server_file(port));
  Asking slow(port), good(port);
  const auto request = framed(7, 1, {2, 0, 100, 0, 8});
  for (std::size_t half = 1; half < request.size(); ++half) {
    const auto middle = request.begin() + static_cast<std::ptrdiff_t>(half);
    slow.send_bytes({request.begin(), middle});
    for (int i = 0; i < 20; ++i) ASSERT_EQ(good.ask({2, 0, 100, 0, 8}), (Bytes{2, 1, 0}));
    slow.send_bytes({middle, request.end()});
    ASSERT_EQ(slow.next(), framed(7, 1, {2, 1, 0})) << "after " << half << " bytes";
  }
}

TEST(ModbusServer, RequestsThatArriveTogetherAreAnsweredOneByOne) {
  const int port = free_port();
  Linked plc(server_file(port));
  Asking other(port);
  auto both = framed(1, 1, {2, 0, 100, 0, 8});
  const auto second = framed(2, 1, {2, 0, 99, 0, 8});
  both.insert(both.end(), second.begin(), second.end());
  other.send_bytes(both);
  EXPECT_EQ(other.next(), framed(1, 1, {2, 1, 0}));
  EXPECT_EQ(other.next(), framed(2, 1, {0x82, 2}));
}

// Answers that nobody reads fill the buffers of both sides; then the connection ends.
TEST(ModbusServer, AClientThatReadsNoAnswersHoldsUpNobody) {
  const int port = free_port();
  Linked plc(server_file(port));
  Asking deaf(port, 4096), good(port);
  const auto request = framed(1, 1, {2, 0, 100, 0, 8});
  while (deaf.sends(request)) {
  }
  EXPECT_EQ(good.ask({2, 0, 100, 0, 8}), (Bytes{2, 1, 0}));
}

TEST(ModbusServer, ARequestOfAWrongLengthIsRefused) {
  const int port = free_port();
  Linked plc(server_file(port));
  Asking other(port);
  EXPECT_EQ(other.ask({5, 0, 12, 0}), (Bytes{0x85, 3}));
  EXPECT_EQ(other.ask({2, 0, 100, 0, 8, 0}), (Bytes{0x82, 3}));
  EXPECT_EQ(other.ask({22, 0, 0, 0xf0, 0xff, 0}), (Bytes{0x96, 3}));
  EXPECT_EQ(other.ask({2}), (Bytes{0x82, 3}));
  EXPECT_EQ(other.ask({2, 0, 100, 0, 8}), (Bytes{2, 1, 0}));
}

TEST(ModbusServer, APortThatIsTakenIsNamed) {
  const int port = free_port();
  Device device(port);
  Linked plc(server_file(port));
  ASSERT_TRUE(plc.until([&] { return !plc.link.problem(0).empty(); }));
  EXPECT_THAT(plc.link.problem(0), HasSubstr("nothing can be received at 127.0.0.1, port " +
                                             std::to_string(port) + ": Address already in use"));
}

}  // namespace
}  // namespace trunnion::plc

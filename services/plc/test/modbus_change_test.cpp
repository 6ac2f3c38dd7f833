// SPDX-License-Identifier: Apache-2.0
// Another modbus.yaml while the PLC runs, and the threads of Modbus beside the scan (make threads).
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>

#include "modbus_link.hpp"
#include "modbus_peer.hpp"

namespace trunnion::plc {
namespace {

std::string device_text(const std::string& name, int port, int address, int at) {
  return "  " + name + ":\n    host: 127.0.0.1\n    port: " + std::to_string(port) +
         "\n    period_ms: 5\n    timeout_ms: 200\n    inputs:\n      - {table: discrete_inputs, address: " +
         std::to_string(address) + ", count: 8, at: X" + std::to_string(at) +
         "}\n    outputs:\n      - {table: coils, address: 0, count: 8, at: Y" + std::to_string(at) + "}\n";
}
std::string server_text(int port, int address) {
  return "server:\n  port: " + std::to_string(port) +
         "\n  inputs:\n    - {table: coils, address: " + std::to_string(address) +
         ", count: 8, at: X60}\n  outputs:\n    - {table: discrete_inputs, address: " +
         std::to_string(address) + ", count: 8, at: R9}\n";
}
st::ModbusFile read(const std::string& yaml) { return st::read_modbus(yaml, "modbus.yaml"); }

struct Plc {
  explicit Plc(const st::ModbusFile& file) : link(file) {}
  template <class Condition>
  bool until(Condition condition) {
    for (int i = 0; i < 30000; ++i) {  // a minute at least, which only ends a hang
      link.exchange(registers);
      for (std::size_t b = 0; b < register_count; ++b) registers.x[b] = link.inputs().in(registers.x[b], b);
      if (condition()) return true;
      usleep(2000);
    }
    return false;
  }
  Registers registers;
  ModbusLink link;
};

void set_inputs(Device& device, std::uint8_t bits, std::size_t from = 0) {
  const std::lock_guard lock(device.mutex);
  for (std::size_t i = 0; i < 8; ++i) device.inputs[from + i] = (bits >> i & 1) != 0;
}
std::uint8_t coils(Device& device) {
  const std::lock_guard lock(device.mutex);
  std::uint8_t bits = 0;
  for (std::size_t i = 0; i < 8; ++i) bits |= static_cast<std::uint8_t>(device.coils[i] ? 1u << i : 0u);
  return bits;
}

TEST(ModbusChange, ConnectionsThatBothFilesHaveGoOnAndOthersBeginAndEnd) {
  const int first_port = free_port(), second_port = free_port(), port = free_port();
  Device first(first_port), second(second_port);
  set_inputs(first, 0x11), set_inputs(second, 0x22);
  const auto one = device_text("one", first_port, 0, 32), two = device_text("two", second_port, 0, 40);
  Plc plc(read("devices:\n" + one + server_text(port, 0)));
  plc.registers.y[32] = 0x5a, plc.registers.y[40] = 0xa5, plc.registers.r[9] = 0x3c;
  ASSERT_TRUE(plc.until([&] { return plc.registers.x[32] == 0x11 && coils(first) == 0x5a; }));
  Asking other(port);
  ASSERT_TRUE(plc.until([&] { return other.ask({2, 0, 0, 0, 8}) == Bytes{2, 1, 0x3c}; }));

  // The server is the same: whoever is connected stays so.
  plc.link.change(read("devices:\n" + one + two + server_text(port, 0)));
  ASSERT_TRUE(plc.until([&] { return plc.registers.x[40] == 0x22 && coils(second) == 0xa5; }));
  EXPECT_EQ(other.ask({2, 0, 0, 0, 8}), (Bytes{2, 1, 0x3c}));
  EXPECT_EQ(plc.link.connections(), 3u);

  // The device `one` is no longer asked: its inputs stay, and nothing is written to it any longer.
  plc.link.change(read("devices:\n" + two + server_text(port, 100)));
  // Whoever connects before the new server listens is with the old one, which ends.
  ASSERT_TRUE(plc.until([&] { return Asking(port).ask({2, 0, 100, 0, 8}) == Bytes{2, 1, 0x3c}; }));
  set_inputs(first, 0xff), set_inputs(second, 0x44);
  plc.registers.y[32] = 0;
  ASSERT_TRUE(plc.until([&] { return plc.registers.x[40] == 0x44; }));
  EXPECT_EQ(plc.registers.x[32], 0x11);
  EXPECT_EQ(coils(first), 0x5a);
  EXPECT_EQ(Asking(port).ask({2, 0, 0, 0, 8}), (Bytes{0x82, 2})) << "the old address is refused";
}

TEST(ModbusChange, DoesNotWaitForADeviceThatIsSilent) {
  const int port = free_port();
  Device device(port);
  std::atomic<int> asked = 0;
  device.spoil = [&](const Bytes&) {
    ++asked;
    return Bytes();
  };  // never an answer: the thread waits for its time limit
  const auto text = [port](int address) {
    auto slow = device_text("slow", port, address, 32);
    return "devices:\n" + slow.replace(slow.find("200"), 3, "5000");
  };
  Plc plc(read(text(0)));
  ASSERT_TRUE(plc.until([&] { return asked == 1; }));
  for (int i = 1; i <= 3; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    plc.link.change(read(text(i)));
    plc.link.exchange(plc.registers);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    // One that waited would be here 5 s after the request, which has only just been sent.
    EXPECT_LT(took.count(), 4);
    ASSERT_TRUE(plc.until([&] { return asked == i + 1; }));
  }
}

TEST(ModbusChange, ThreadsAndScanShareOnlyWhatTheLockProtects) {
  const int device_port = free_port(), port = free_port();
  Device device(device_port);
  const auto one = device_text("one", device_port, 0, 32);
  Plc plc(read("devices:\n" + one + server_text(port, 0)));
  std::atomic<bool> ends = false;
  std::thread clients([&] {
    for (unsigned n = 0; !ends; ++n) {
      Asking client(port);
      for (unsigned i = 0; i < 20 && client.connected() && !ends; ++i)
        client.ask(
            {5, 0, static_cast<std::uint8_t>(i % 8), static_cast<std::uint8_t>(n % 2 == 0 ? 0xff : 0), 0});
    }
  });
  std::thread changes([&] {
    for (std::uint8_t n = 0; !ends; ++n) set_inputs(device, n), usleep(1000);
  });
  // The scan: outputs change, inputs are read, the file changes now and then.
  for (int scan = 0; scan < 600; ++scan) {
    plc.registers.y[32] = static_cast<std::uint8_t>(scan),
    plc.registers.r[9] = static_cast<std::uint8_t>(scan);
    plc.link.exchange(plc.registers);
    for (std::size_t b = 0; b < register_count; ++b)
      plc.registers.x[b] = plc.link.inputs().in(plc.registers.x[b], b);
    for (std::size_t i = 0; i < plc.link.connections(); ++i) (void)plc.link.problem(i).size();
    if (scan % 200 == 199) plc.link.change(read("devices:\n" + one + server_text(port, scan)));
    usleep(1000);
  }
  ends = true;
  clients.join(), changes.join();
  // The device is not changed by any of the files: it has gone on all the time.
  set_inputs(device, 0x77);
  plc.registers.y[32] = 0x69;
  EXPECT_TRUE(plc.until([&] { return plc.registers.x[32] == 0x77 && coils(device) == 0x69; }));
}

}  // namespace
}  // namespace trunnion::plc

// SPDX-License-Identifier: Apache-2.0
// trunnion-hal-io FILE: a HAL component of ordinary priority. It exchanges its pins with the Modbus server of
// the PLC; a .hal file loads it with `loadusr -Wn io trunnion-hal-io io.yaml`. While the PLC does not answer,
// the outputs are 0.
#include <hal.h>
#include <modbus/modbus.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "plc/devices/hal_pins.hpp"

namespace {
using namespace trunnion;
using Clock = std::chrono::steady_clock;

constexpr double retry_period = 0.2;  // s between two attempts to connect

volatile std::sig_atomic_t end_requested = 0;
void request_end(int) { end_requested = 1; }

/// The pins of one block. They are in HAL's shared memory.
struct Pins {
  explicit Pins(const st::HalPins& pins) : block(pins) {}
  st::HalPins block;
  hal_bit_t** bits = nullptr;
  hal_u32_t** words = nullptr;

  void export_to(int component, hal_pin_dir_t direction) {
    const auto count = block.pins.size();
    int failed = 0;
    if (st::has_bits(block.table)) {
      bits = static_cast<hal_bit_t**>(hal_malloc(static_cast<long>(count * sizeof(hal_bit_t*))));
      for (std::size_t i = 0; bits != nullptr && i < count; ++i)
        failed |= hal_pin_bit_newf(direction, &bits[i], component, "io.%s", block.pins[i].c_str());
    } else {
      words = static_cast<hal_u32_t**>(hal_malloc(static_cast<long>(count * sizeof(hal_u32_t*))));
      for (std::size_t i = 0; words != nullptr && i < count; ++i)
        failed |= hal_pin_u32_newf(direction, &words[i], component, "io.%s", block.pins[i].c_str());
    }
    if (failed != 0 || (bits == nullptr && words == nullptr))
      throw std::runtime_error("HAL has too little memory for the pins, or they exist already");
  }
  void set(std::size_t i, unsigned value) const {
    if (bits != nullptr)
      *bits[i] = value != 0;
    else
      *words[i] = value;
  }
  unsigned get(std::size_t i) const { return bits != nullptr ? (*bits[i] ? 1 : 0) : *words[i]; }
};

struct FreeContext {
  void operator()(modbus_t* context) const { modbus_close(context), modbus_free(context); }
};

class Exchange {
 public:
  Exchange(st::HalPinsFile file, int component) : file_(std::move(file)) {
    for (const auto& block : file_.outputs) outputs_.emplace_back(block).export_to(component, HAL_OUT);
    for (const auto& block : file_.inputs) inputs_.emplace_back(block).export_to(component, HAL_IN);
    connected_ = static_cast<hal_bit_t**>(hal_malloc(sizeof(hal_bit_t*)));
    if (connected_ == nullptr || hal_pin_bit_newf(HAL_OUT, connected_, component, "io.connected") != 0)
      throw std::runtime_error("HAL has too little memory for the pins, or they exist already");
  }

  void run() {
    while (end_requested == 0) {
      const auto begin = Clock::now();
      const bool works = (context_ || connect()) && transfer();
      if (!works) {
        context_.reset();
        for (const auto& pins : outputs_)
          for (std::size_t i = 0; i < pins.block.pins.size(); ++i) pins.set(i, 0);
      }
      **connected_ = works;
      std::this_thread::sleep_until(begin +
                                    std::chrono::duration<double>(works ? file_.period : retry_period));
    }
  }

 private:
  bool connect() {
    context_.reset(modbus_new_tcp_pi(file_.host.c_str(), std::to_string(file_.port).c_str()));
    if (!context_) return false;
    const auto seconds = static_cast<std::uint32_t>(file_.timeout);
    modbus_set_response_timeout(context_.get(), seconds,
                                static_cast<std::uint32_t>(std::lround((file_.timeout - seconds) * 1e6)));
    return modbus_connect(context_.get()) == 0;
  }

  bool transfer() {
    for (const auto& pins : outputs_)
      if (!read(pins)) return false;
    for (const auto& pins : inputs_)
      if (!write(pins)) return false;
    return true;
  }

  bool read(const Pins& pins) const {
    const auto count = static_cast<int>(pins.block.pins.size());
    std::uint8_t bits[512];
    std::uint16_t words[512];
    const bool has_bits = pins.bits != nullptr;
    if ((has_bits ? modbus_read_input_bits(context_.get(), pins.block.address, count, bits)
                  : modbus_read_input_registers(context_.get(), pins.block.address, count, words)) != count)
      return false;
    for (std::size_t i = 0; i < pins.block.pins.size(); ++i) pins.set(i, has_bits ? bits[i] : words[i]);
    return true;
  }

  bool write(const Pins& pins) const {
    const auto count = static_cast<int>(pins.block.pins.size());
    std::uint8_t bits[512];
    std::uint16_t words[512];
    for (std::size_t i = 0; i < pins.block.pins.size(); ++i) {
      bits[i] = pins.get(i) != 0;
      words[i] = static_cast<std::uint16_t>(pins.get(i));
    }
    return (pins.bits != nullptr
                ? modbus_write_bits(context_.get(), pins.block.address, count, bits)
                : modbus_write_registers(context_.get(), pins.block.address, count, words)) == count;
  }

  const st::HalPinsFile file_;
  std::vector<Pins> outputs_, inputs_;
  hal_bit_t** connected_ = nullptr;
  std::unique_ptr<modbus_t, FreeContext> context_;
};

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  if (!in) throw std::runtime_error(path + ": cannot be read");
  return text.str();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(
        stderr,
        "usage: trunnion-hal-io FILE.yaml, from a .hal file: loadusr -Wn io trunnion-hal-io FILE.yaml\n");
    return 2;
  }
  std::signal(SIGTERM, request_end);
  std::signal(SIGINT, request_end);
  int component = -1;
  int status = 0;
  try {
    auto file = st::read_hal_pins(text_of(argv[1]), argv[1]);
    component = hal_init("io");
    if (component < 0) throw std::runtime_error("HAL takes no component 'io': does it run, and without one?");
    Exchange exchange(std::move(file), component);
    hal_ready(component);
    exchange.run();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "trunnion-hal-io: %s\n", e.what());
    status = 1;
  }
  if (component >= 0) hal_exit(component);
  return status;
}

// SPDX-License-Identifier: Apache-2.0
// A device that the PLC asks over Modbus TCP.

#include <cerrno>
#include <cmath>
#include <memory>

#include "modbus_connection.hpp"
#include "modbus_protocol.hpp"

namespace trunnion::plc {
namespace {

constexpr double retry_period = 0.5;  // s between two attempts to connect

struct FreeContext {
  void operator()(modbus_t* context) const { modbus_close(context), modbus_free(context); }
};
using Context = std::unique_ptr<modbus_t, FreeContext>;

class DeviceConnection : public ModbusLink::Connection {
 public:
  explicit DeviceConnection(const st::ModbusDevice& device)
      : Connection(device.inputs, device.outputs), device_(device) {}

 private:
  void run(const std::stop_token& stop) override {
    for (bool connected = false; !stop.stop_requested();) {
      if (!connected && !(connected = connect())) {
        lost(text("cannot be reached", modbus_strerror(errno)));
        if (!wait(stop, retry_period)) return;
        continue;
      }
      if (transfer()) {
        works();
      } else {
        const int why = errno;
        const bool answered = why >= EMBXILFUN && why <= EMBXGTAR;
        lost(text(answered ? "refuses a request" : "does not answer", modbus_strerror(why)));
        // An answer that comes too late must not be that to the next request.
        if (!answered) context_.reset(), connected = false;
      }
      if (!wait(stop, device_.period)) return;
    }
  }

  bool connect() {
    context_.reset(modbus_new_tcp_pi(device_.host.c_str(), std::to_string(device_.port).c_str()));
    if (!context_) return false;
    const auto seconds = static_cast<std::uint32_t>(device_.timeout);
    modbus_set_response_timeout(context_.get(), seconds,
                                static_cast<std::uint32_t>(std::lround((device_.timeout - seconds) * 1e6)));
    modbus_set_slave(context_.get(), device_.unit);
    return modbus_connect(context_.get()) == 0;
  }

  // False with errno.
  bool transfer() {
    const auto values = outputs();
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!write(output_blocks[i], values[i])) return false;
    NetworkInputs inputs;
    for (const auto& block : input_blocks)
      if (!read(block, inputs)) return false;
    give(inputs);
    return true;
  }

  bool write(const st::ModbusBlock& block, const std::vector<std::uint16_t>& values) {
    if (!st::has_bits(block.table))
      return modbus_write_registers(context_.get(), block.address, block.count, values.data()) == block.count;
    const std::vector<std::uint8_t> bits(values.begin(), values.end());
    return modbus_write_bits(context_.get(), block.address, block.count, bits.data()) == block.count;
  }

  bool read(const st::ModbusBlock& block, NetworkInputs& inputs) {
    std::vector<std::uint16_t> values(block.count);
    if (st::has_bits(block.table)) {
      std::vector<std::uint8_t> bits(block.count);
      const auto function = block.table == st::ModbusTable::coils ? modbus_read_bits : modbus_read_input_bits;
      if (function(context_.get(), block.address, block.count, bits.data()) != block.count) return false;
      values.assign(bits.begin(), bits.end());
    } else {
      const auto function = block.table == st::ModbusTable::holding_registers ? modbus_read_registers
                                                                              : modbus_read_input_registers;
      if (function(context_.get(), block.address, block.count, values.data()) != block.count) return false;
    }
    put_block(block, values, inputs);
    return true;
  }

  std::string text(const std::string& what, const std::string& why) const {
    std::string message = "The Modbus device '" + device_.name + "' (" + device_.host + ", port " +
                          std::to_string(device_.port) + ", unit " + std::to_string(device_.unit) + ") " +
                          what + ": " + why;
    if (!input_blocks.empty())
      message += ". Its inputs " + registers_text(input_blocks) + " have their values for this case";
    return message + ". Check the device, its cable and its entry in modbus.yaml, then reset";
  }

  const st::ModbusDevice device_;
  Context context_;
};

}  // namespace

std::unique_ptr<ModbusLink::Connection> modbus_device(const st::ModbusDevice& device) {
  return std::make_unique<DeviceConnection>(device);
}

}  // namespace trunnion::plc

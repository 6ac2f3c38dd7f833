// SPDX-License-Identifier: Apache-2.0
// Modbus TCP by threads of its own; the PLC exchanges values with them without waiting.
#pragma once

#include <future>
#include <memory>
#include <string>
#include <vector>

#include "modbus_image.hpp"

namespace trunnion::plc {

class ModbusLink {
 public:
  /// Connects to the devices and listens, each in a thread with ordinary scheduling.
  explicit ModbusLink(const st::ModbusFile& file = {});
  ~ModbusLink();
  /// Connections that both files have go on. The others end, in a thread that waits for the answers they wait
  /// for, and the new ones begin when they have ended, so that no device hears of both.
  void change(const st::ModbusFile& file);
  ModbusLink(const ModbusLink&) = delete;
  ModbusLink& operator=(const ModbusLink&) = delete;

  /// Gives the outputs and takes what has come; of a connection whose thread holds its values just now in the
  /// next call.
  void exchange(const Registers& registers);
  /// As of the last exchange.
  const NetworkInputs& inputs() const { return inputs_; }
  std::size_t connections() const { return connections_.size(); }
  /// Why the connection does not work, with what to do; empty while it does. As of the last exchange.
  const std::string& problem(std::size_t connection) const;

  class Connection;

 private:
  st::ModbusFile file_;
  std::vector<std::unique_ptr<Connection>> connections_;  ///< the devices, then the server
  std::future<void> changing_;
  NetworkInputs inputs_;
};

}  // namespace trunnion::plc

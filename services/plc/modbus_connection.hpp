// SPDX-License-Identifier: Apache-2.0
// What a thread of Modbus and the PLC share.
#pragma once

#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "modbus_link.hpp"

namespace trunnion::plc {

class ModbusLink::Connection {
 public:
  using Values = std::vector<std::vector<std::uint16_t>>;  ///< of each block

  Connection(std::vector<st::ModbusBlock> inputs, std::vector<st::ModbusBlock> outputs);
  virtual ~Connection() = default;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Begins the thread. Call it when the object is complete, and stop() before it is destroyed.
  void start();
  void stop();
  /// Of the PLC; does nothing while the thread holds the values.
  void exchange(const Registers& registers);
  const NetworkInputs& inputs() const { return taken_; }
  const std::string& problem() const { return shown_problem_; }

 protected:
  virtual void run(const std::stop_token& stop) = 0;
  /// False when the thread is to end.
  bool wait(const std::stop_token& stop, double seconds);
  Values outputs();
  /// What has come, or without a connection what counts then.
  void give(const NetworkInputs& inputs);
  /// Also gives the values for the loss of the connection, when it has worked until now.
  void lost(const std::string& problem);
  void works();

  const std::vector<st::ModbusBlock> input_blocks, output_blocks;

 private:
  std::mutex mutex_;
  std::condition_variable_any wakes_;
  Values values_;
  NetworkInputs given_, taken_;
  std::string problem_, shown_problem_;
  bool has_outputs_ = false;
  std::jthread thread_;
};

std::unique_ptr<ModbusLink::Connection> modbus_device(const st::ModbusDevice& device);
std::unique_ptr<ModbusLink::Connection> modbus_server(const st::ModbusServer& server);

}  // namespace trunnion::plc

// SPDX-License-Identifier: Apache-2.0
#include "modbus_link.hpp"

#include <pthread.h>

#include <chrono>

#include "modbus_connection.hpp"

namespace trunnion::plc {

ModbusLink::Connection::Connection(std::vector<st::ModbusBlock> inputs, std::vector<st::ModbusBlock> outputs)
    : input_blocks(std::move(inputs)), output_blocks(std::move(outputs)) {
  for (const auto& block : output_blocks) values_.emplace_back(block.count);
}

void ModbusLink::Connection::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) {
    // A thread begins with the scheduling of the one that makes it.
    const sched_param parameters{};
    pthread_setschedparam(pthread_self(), SCHED_OTHER, &parameters);
    run(stop);
  });
}

void ModbusLink::Connection::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

void ModbusLink::Connection::exchange(const Registers& registers) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  for (std::size_t i = 0; i < output_blocks.size(); ++i) read_block(registers, output_blocks[i], values_[i]);
  if (!has_outputs_) {
    has_outputs_ = true;
    wakes_.notify_all();
  }
  taken_ = given_;
  if (shown_problem_ != problem_) shown_problem_ = problem_;
}

bool ModbusLink::Connection::wait(const std::stop_token& stop, double seconds) {
  std::unique_lock lock(mutex_);
  wakes_.wait_for(lock, stop, std::chrono::duration<double>(seconds), [] { return false; });
  return !stop.stop_requested();
}

ModbusLink::Connection::Values ModbusLink::Connection::outputs() {
  std::unique_lock lock(mutex_);
  return has_outputs_ ? values_ : Values{};
}

void ModbusLink::Connection::give(const NetworkInputs& inputs) {
  const std::unique_lock lock(mutex_);
  given_.merge(inputs);
}

void ModbusLink::Connection::lost(const std::string& problem) {
  const std::unique_lock lock(mutex_);
  if (problem_.empty()) put_losses(input_blocks, given_);
  problem_ = problem;
}

void ModbusLink::Connection::works() {
  const std::unique_lock lock(mutex_);
  problem_.clear();
}

ModbusLink::ModbusLink(const st::ModbusFile& file) {
  for (const auto& device : file.devices) connections_.push_back(modbus_device(device));
  if (file.server) connections_.push_back(modbus_server(*file.server));
  for (auto& connection : connections_) connection->start();
}

ModbusLink::~ModbusLink() {
  for (auto& connection : connections_) connection->stop();
}

void ModbusLink::exchange(const Registers& registers) {
  for (auto& connection : connections_) {
    connection->exchange(registers);
    inputs_.merge(connection->inputs());
  }
}

const std::string& ModbusLink::problem(std::size_t connection) const {
  return connections_[connection]->problem();
}

}  // namespace trunnion::plc

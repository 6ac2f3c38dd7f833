// SPDX-License-Identifier: Apache-2.0
#include "modbus_link.hpp"

#include <algorithm>
#include <chrono>

#include "modbus_connection.hpp"
#include "ordinary_scheduling.hpp"

namespace trunnion::plc {
ModbusLink::Connection::Connection(std::vector<st::ModbusBlock> inputs, std::vector<st::ModbusBlock> outputs)
    : input_blocks(std::move(inputs)), output_blocks(std::move(outputs)) {
  for (const auto& block : output_blocks) values_.emplace_back(block.count);
}

void ModbusLink::Connection::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) {
    use_ordinary_scheduling();
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

ModbusLink::ModbusLink(const st::ModbusFile& file) { change(file); }

void ModbusLink::change(const st::ModbusFile& file) {
  auto before = std::move(connections_);
  connections_.clear();
  std::vector<Connection*> fresh;
  const auto begin = [&](std::unique_ptr<Connection> connection) {
    fresh.push_back(connection.get());
    connections_.push_back(std::move(connection));
  };
  for (const auto& device : file.devices) {
    const auto known = std::find(file_.devices.begin(), file_.devices.end(), device);
    if (known != file_.devices.end())
      connections_.push_back(std::move(before[static_cast<std::size_t>(known - file_.devices.begin())]));
    else
      begin(modbus_device(device));
  }
  if (file.server && file.server == file_.server)
    connections_.push_back(std::move(before.back()));
  else if (file.server)
    begin(modbus_server(*file.server));
  file_ = file;
  inputs_ = {};
  std::erase(before, nullptr);
  changing_ = std::async(std::launch::async,
                         [previous = std::move(changing_), before = std::move(before), fresh]() mutable {
                           use_ordinary_scheduling();
                           if (previous.valid()) previous.wait();
                           for (const auto& connection : before) connection->stop();
                           before.clear();  // with the port of a server
                           for (auto* connection : fresh) connection->start();
                         });
}

ModbusLink::~ModbusLink() {
  if (changing_.valid()) changing_.wait();
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

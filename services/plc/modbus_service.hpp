// SPDX-License-Identifier: Apache-2.0
// Modbus beside the PLC: what comes from the network is a request of the panel, so that it is an input like
// any other, logged with its tick.
#pragma once

#include <array>

#include "modbus_link.hpp"
#include "plc_core.hpp"
#include "service/node.hpp"

namespace trunnion::plc {

class ModbusService {
 public:
  explicit ModbusService(service::Node& node);

  /// These are the connections from now on; none in a verification.
  void change(const st::ModbusFile& file);

  /// After the scans. `now` in s.
  void pump(const PlcCore& core, double now);

 private:
  void send(const Memory& memory, double now);
  void show_problems(std::uint64_t cycle);

  struct Sent {
    std::uint8_t value = 0;
    double at = 0;  ///< s; 0: not sent
  };
  service::Node& node_;
  bus::Writer<idl::plc::PanelRequest> requests_;
  ModbusLink link_;
  std::array<Sent, register_count> sent_{};
  std::vector<std::string> shown_;
  std::uint64_t client_ = 0, number_ = 0;
};

}  // namespace trunnion::plc

// SPDX-License-Identifier: Apache-2.0
#include "modbus_service.hpp"

#include <algorithm>

#include "machine/alarm_constants.hpp"
#include "service/request.hpp"

namespace trunnion::plc {
namespace {

constexpr double resend_period = 0.1;  // s after which an input that has not arrived is sent again

bool is_forced(const Memory& memory, std::size_t byte) {
  const auto cell = st::address_of(st::Area::x, static_cast<std::uint32_t>(byte));
  return std::any_of(memory.forces.values.begin(), memory.forces.values.begin() + memory.forces.count,
                     [&](const Force& force) { return force.cell == cell; });
}

}  // namespace

ModbusService::ModbusService(service::Node& node)
    : node_(node), requests_(node.bus().writer(topics::panel_request)), client_(service::make_client_id()) {}

void ModbusService::change(const st::ModbusFile& file) {
  if (node_.snapshot() != nullptr) return;
  link_.change(file);
  // The numbers of the connections are other ones: what still holds is raised again.
  for (std::size_t i = 0; i < shown_.size(); ++i)
    if (!shown_[i].empty()) node_.alarms().clear(alarm::plc_modbus, static_cast<std::uint32_t>(i + 1));
  shown_.assign(link_.connections(), "");
}

void ModbusService::pump(const PlcCore& core, double now) {
  if (link_.connections() == 0) return;
  link_.exchange(core.memory().registers);
  send(core.memory(), now);
  show_problems(core.executed());
}

void ModbusService::send(const Memory& memory, double now) {
  const auto& inputs = link_.inputs();
  for (std::size_t i = 0; i < register_count; ++i) {
    if (inputs.mask[i] == 0) continue;
    const auto value = inputs.in(memory.registers.x[i], i);
    auto& sent = sent_[i];
    if (value == memory.registers.x[i]) {
      sent.at = 0;
      continue;
    }
    if ((sent.at != 0 && sent.value == value && now - sent.at < resend_period) || is_forced(memory, i))
      continue;
    idl::plc::PanelRequest request;
    request.client = client_;
    request.number = ++number_;
    request.kind = idl::plc::PanelRequestKind::FORCE_INPUT;
    request.address = static_cast<std::uint32_t>(i);
    request.value = value;
    requests_.write(request);
    sent = {value, now};
  }
}

void ModbusService::show_problems(std::uint64_t cycle) {
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const auto& problem = link_.problem(i);
    if (problem == shown_[i]) continue;
    shown_[i] = problem;
    const auto part = static_cast<std::uint32_t>(i + 1);
    if (problem.empty())
      node_.alarms().release(alarm::plc_modbus, part);
    else
      node_.alarms().raise(alarm::plc_modbus, part, problem, cycle);
  }
}

}  // namespace trunnion::plc

// SPDX-License-Identifier: Apache-2.0
#include "fault_matrix_cells.hpp"

#include <algorithm>

#include "machine/services.hpp"

namespace trunnion::integration {
namespace {

bool is_stage(const std::string& service) {
  const auto* definition = machine::find_service(service);
  return definition != nullptr && definition->transforms();
}

std::string numbers(const std::set<unsigned>& alarms) {
  std::string text;
  for (const auto number : alarms) text += (text.empty() ? "" : " ") + std::to_string(number);
  return text;
}

const char* text_of(Machine machine) {
  switch (machine) {
    case Machine::goes_on:
      return "continues";
    case Machine::stops_on_path:
      return "stops on the path";
    case Machine::stops_axes_off:
      return "stops on the path, axes off";
  }
  return "";
}

const char* text_of(Way way) {
  switch (way) {
    case Way::nothing:
      return "nothing to do";
    case Way::cycle_start:
      return "reset, cycle start";
    case Way::begin_again:
      return "reset the channel, begin again";
  }
  return "";
}

// Who stops the machine decides within how many cycles.
std::string bound(const std::string& service, const Expectation& e) {
  if (e.machine == Machine::goes_on) return "0";
  if (service == "drive") return "0: the simulated axes stop where they are";
  if (is_stage(service) || service == "channel") return "the setpoints at hand (512), or the channel's hold";
  return "the channel's hold";
}

}  // namespace

const char* name_of(Fault fault) {
  switch (fault) {
    case Fault::killed:
      return "killed";
    case Fault::terminated:
      return "terminated";
    case Fault::suspended:
      return "suspended";
    case Fault::restarts:
      return "restarts";
  }
  return "";
}

std::string Cell::name() const {
  return service + "_" + name_of(fault) + "_" + layout + (in_motion ? "_in_motion" : "_at_rest");
}

const std::vector<std::string>& matrix_services() {
  static const auto services = [] {
    std::vector<std::string> names;
    for (const auto& definition : machine::service::all) names.emplace_back(definition.name);
    names.emplace_back("recorder");
    return names;
  }();
  return services;
}

const std::vector<std::string>& matrix_layouts() {
  static const std::vector<std::string> layouts{"fastdds", "cyclonedds", "mixed"};
  return layouts;
}

std::vector<Cell> all_cells() {
  std::vector<Cell> cells;
  for (const auto& service : matrix_services())
    for (const auto fault : every_fault)
      for (const auto& layout : matrix_layouts())
        for (const bool in_motion : {true, false}) cells.push_back({service, fault, layout, in_motion});
  return cells;
}

Expectation expectation(const std::string& service, Fault fault, bool in_motion) {
  Expectation e{Machine::stops_on_path, {100}, {}, Way::cycle_start, false, fault != Fault::suspended};
  if (service == "recorder") return {Machine::goes_on, {}, {}, Way::nothing, false, false};
  if (fault == Fault::restarts) e.must.insert(105);
  if (!in_motion) {
    e.machine = Machine::goes_on;
    e.way = Way::nothing;
    if (service == "plc") {
      e.may = {130, 133};
      if (fault == Fault::suspended) e.must.insert(133);
    }
    return e;
  }
  if (is_stage(service)) {
    e.may = {110, 144};
  } else if (service == "channel") {
    e.may = {110, 144};
    if (fault != Fault::suspended) e.must.insert(144);
  } else if (service == "drive") {
    if (fault == Fault::suspended)
      e.may = {144};
    else
      e.must.insert(144);
  } else if (service == "plc") {
    e.may = {130, 133, 144};
    e.may_begin_again = true;
    if (fault == Fault::suspended) {
      e.machine = Machine::stops_axes_off;
      e.way = Way::begin_again;
      e.must.insert({133, 144});
    }
  }
  for (const auto number : e.must) e.may.erase(number);
  return e;
}

std::string matrix_document() {
  std::string text;
  for (const bool in_motion : {true, false}) {
    text += std::string("\n## ") + (in_motion ? "In motion" : "At rest") + "\n\n";
    text +=
        in_motion
            ? "| service | fault | machine | within, cycles | alarms | perhaps also | process | to continue "
              "|\n"
              "|---|---|---|---|---|---|---|---|\n"
            : "| service | fault | machine | alarms | perhaps also | process |\n|---|---|---|---|---|---|\n";
    for (const auto& service : matrix_services())
      for (const auto fault : every_fault) {
        const auto e = expectation(service, fault, in_motion);
        const std::string process = service == "recorder"       ? "as its user wants"
                                    : fault == Fault::suspended ? "continues"
                                    : fault == Fault::restarts  ? "given up, started again by the reset"
                                                                : "a new one";
        text += "| " + service + " | " + name_of(fault) + " | " +
                (in_motion ? std::string(text_of(e.machine)) + " | " + bound(service, e) : "standstill") +
                " | " + numbers(e.must) + " | " + numbers(e.may) + " | " + process;
        if (in_motion)
          text += std::string(" | ") + text_of(e.way) +
                  (e.may_begin_again && e.way != Way::begin_again ? "; after 133 as below" : "");
        text += " |\n";
      }
  }
  return text;
}

}  // namespace trunnion::integration

// SPDX-License-Identifier: Apache-2.0
#include "recording_alarms.hpp"

#include <unistd.h>

#include <chrono>
#include <thread>

#include "machine/alarm_constants.hpp"

namespace trunnion::recorder {
namespace {

constexpr auto time_to_take = std::chrono::milliseconds(200);
// The services of a machine count from 1, and process numbers are below 2^22.
constexpr std::uint32_t first_instance = 1u << 24;

}  // namespace

RecordingAlarms::RecordingAlarms(bus::Bus& bus)
    : alarms_(bus, first_instance + static_cast<std::uint32_t>(getpid()), "recorder") {}

void RecordingAlarms::tell(const SpaceWatch::Finding& finding) {
  if (finding.kind == SpaceWatch::Kind::enough)
    alarms_.clear(alarm::recording_space_low, 0);
  else
    alarms_.raise(alarm::recording_space_low, 0, finding.text);
}

void RecordingAlarms::finish(const std::string& problem) {
  if (!problem.empty()) alarms_.raise(alarm::recording_ended, 0, problem);
  if (!alarms_.any()) return;
  alarms_.clear(alarm::recording_space_low, 0);
  std::this_thread::sleep_for(time_to_take);
}

}  // namespace trunnion::recorder

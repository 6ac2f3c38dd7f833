// SPDX-License-Identifier: Apache-2.0
#include "flight_recorder.hpp"

#include <stdexcept>
#include <utility>

#include "bus/codec.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::recorder {
namespace {
// What a message costs beside its bytes.
constexpr std::size_t kept_overhead = sizeof(Message) + 64;

// To save because the disk is almost full would fill it.
bool is_of_recorder(const idl::service::Alarm& alarm) {
  return alarm.number == alarm::recording_space_low.number || alarm.number == alarm::recording_ended.number;
}
}  // namespace

FlightRecorder::FlightRecorder(std::string path, FileHeader header, FlightLimits limits, std::int64_t began)
    : path_(std::move(path)),
      header_(std::move(header)),
      limits_(limits),
      began_(began),
      states_(header_.topics) {}

void FlightRecorder::take(Message& message, double now) {
  const bool fired = fires(message);
  bytes_ += message.cdr.size() + kept_overhead;
  kept_.push_back(
      {{message.topic, message.sequence, message.source_time, std::exchange(message.cdr, {})}, now});
  if (fired && !save_at_) save_at_ = now + limits_.after;
  idle(now);
}

void FlightRecorder::idle(double now) {
  if (save_at_ && now >= *save_at_) save();
  forget(now);
}

void FlightRecorder::finish(double) {
  if (save_at_) save();
}

void FlightRecorder::forget(double now) {
  // What is to be saved with an alarm stays until it is, unless the memory is too small for it.
  const double oldest = (save_at_ ? *save_at_ - limits_.after : now) - limits_.before;
  while (!kept_.empty() && (kept_.front().arrived < oldest || bytes_ > limits_.bytes)) {
    states_.see(kept_.front().message);
    bytes_ -= kept_.front().message.cdr.size() + kept_overhead;
    kept_.pop_front();
  }
}

bool FlightRecorder::fires(const Message& message) {
  if (header_.topics.at(message.topic)->handle != "alarm") return false;
  idl::service::Alarm alarm;
  if (!bus::decode(message.cdr, alarm) || is_of_recorder(alarm)) return false;
  auto& known = occurrences_[{alarm.instance, alarm.number, alarm.part}];
  const bool news = alarm.active && alarm.occurrences != known;
  known = alarm.active ? alarm.occurrences : 0;
  if (!news || alarm.severity < limits_.severity || message.source_time < began_) return false;
  if (!save_at_) why_ = "alarm " + std::to_string(alarm.number) + " of " + alarm.source + ": " + alarm.text;
  return true;
}

void FlightRecorder::save() {
  save_at_.reset();
  try {
    RecordingFile file(numbered(path_, next_number(path_)), header_, {{"saved_because", why_}});
    FileReport report{file.path(), 0, 0, why_};
    const auto write = [&](const Message& message) {
      if (file.write(message))
        ++report.messages;
      else
        ++unwritten_;
    };
    for (const auto* message : states_.states()) write(*message);
    for (const auto& kept : kept_) write(kept.message);
    file.finish();
    report.bytes = file.bytes();
    if (problem_.empty()) problem_ = file.problem();
    files_.push_back(std::move(report));
  } catch (const std::runtime_error& error) {
    unwritten_ += kept_.size();
    if (problem_.empty()) problem_ = error.what();
  }
}

}  // namespace trunnion::recorder

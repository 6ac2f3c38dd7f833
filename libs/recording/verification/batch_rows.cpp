// SPDX-License-Identifier: Apache-2.0
#include "verification/batch_rows.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "bus/codec.hpp"

namespace trunnion::verification {
namespace {

constexpr const char* path_letters[] = {"X", "Y", "Z", "A", "B", "C", "U", "V", "W"};
constexpr std::size_t path_width = std::size(path_letters);
constexpr std::size_t most_spindles = 8;  // of the feedback

std::string name_of(const char* sequence, std::size_t index) {
  return std::string(sequence) + "[" + std::to_string(index) + "]";
}

void flatten(const std::string& name, const bus::Json& value, std::vector<Field>& out) {
  if (value.is_object()) {
    const std::string prefix = name.empty() ? "" : name + ".";
    for (const auto& [key, child] : value.items()) flatten(std::string(prefix).append(key), child, out);
  } else if (value.is_array()) {
    out.push_back({name + ".size", value.size()});
    for (std::size_t i = 0; i < value.size(); ++i)
      flatten(name + "[" + std::to_string(i) + "]", value[i], out);
  } else {
    out.push_back({name, value});
  }
}

template <class Batch>
void states_of(const Batch& f, std::vector<Field>& out) {
  using Snapshot = bus::Fields<idl::stream::ChannelSnapshot>;
  if (f.snapshot.valid)
    Snapshot::visit(f.snapshot, [&](const char* name, const auto& field, auto...) {
      if constexpr (requires { field.begin(); }) {
        for (std::size_t i = 0; i < field.size(); ++i)
          out.push_back({"snapshot." + std::string(name) + "[" + std::to_string(i) + "]", field[i], true});
      } else {
        out.push_back({"snapshot." + std::string(name), bus::to_json(field), true});
      }
    });
  for (const auto& state : f.states)
    for (std::size_t i = 0; i < state.values.size(); ++i)
      out.push_back({"state." + std::string(bus::to_string(state.stage)) + "[" + std::to_string(i) + "]",
                     state.values[i], true});
}

template <class Batch>
BatchSpan span_of(const Batch& f) {
  return {f.channel, f.epoch, f.first, f.count, f.revision, f.starts, f.ends};
}

}  // namespace

bool is_cyclic(const bus::TopicEntry& topic) { return topic.qos == bus::QosKind::batch; }

bool MessageRows::load(const bus::TopicEntry& topic, std::span<const std::uint8_t> cdr) {
  span_ = {};
  rows_ = 1;
  if (topic.type == bus::Fields<idl::stream::PathBatch>::name) {
    kind_ = Kind::path;
    if (!bus::decode(cdr, path_)) return false;
    span_ = span_of(path_);
    rows_ = std::min<std::size_t>(path_.count, path_.setpoints.size() / path_width);
  } else if (topic.type == bus::Fields<idl::stream::AxisBatch>::name) {
    kind_ = Kind::axis;
    if (!bus::decode(cdr, axis_)) return false;
    span_ = span_of(axis_);
    rows_ = axis_.axes.empty()
                ? 0
                : std::min<std::size_t>(axis_.count, axis_.setpoints.size() / axis_.axes.size());
  } else if (topic.type == bus::Fields<idl::stream::Feedback>::name) {
    kind_ = Kind::feedback;
    if (!bus::decode(cdr, feedback_)) return false;
    span_.first = feedback_.first;
    span_.count = feedback_.count;
    span_.revision = feedback_.revision;
    const std::size_t width = std::max<std::size_t>(1, feedback_.axis_count);
    rows_ = std::min({static_cast<std::size_t>(feedback_.count), feedback_.commanded.size() / width,
                      feedback_.actual.size() / width});
  } else {
    kind_ = Kind::other;
    try {
      other_ = topic.to_json(cdr);
    } catch (const bus::CdrError&) {
      return false;
    }
  }
  return true;
}

void MessageRows::fields(std::size_t row, std::vector<Field>& out) const {
  out.clear();
  const auto batch = [&](const auto& f) {
    out.push_back({"revision", f.revision});
    out.push_back({"starts", f.starts && row == 0});
    out.push_back({"ends", f.ends && row + 1 == f.count});
    out.push_back({"line", row < f.lines.size() ? f.lines[row] : 0});
  };
  switch (kind_) {
    case Kind::path:
      batch(path_);
      out.push_back({"transformation", bus::to_string(path_.transformation)});
      out.push_back({"tool_length", path_.tool_length});
      for (std::size_t i = 0; i < path_width; ++i)
        out.push_back({std::string("setpoint.") + path_letters[i], path_.setpoints[row * path_width + i]});
      if (row + 1 == path_.count) states_of(path_, out);
      break;
    case Kind::axis:
      batch(axis_);
      for (std::size_t i = 0; i < axis_.axes.size(); ++i)
        out.push_back(
            {"setpoint.axis" + std::to_string(axis_.axes[i]), axis_.setpoints[row * axis_.axes.size() + i]});
      if (row + 1 == axis_.count) states_of(axis_, out);
      break;
    case Kind::feedback:
      out.push_back({"revision", feedback_.revision});
      for (std::size_t i = 0; i < feedback_.axis_count; ++i)
        out.push_back(
            {"commanded[" + std::to_string(i) + "]", feedback_.commanded[row * feedback_.axis_count + i]});
      for (std::size_t i = 0; i < feedback_.axis_count; ++i)
        out.push_back(
            {"actual[" + std::to_string(i) + "]", feedback_.actual[row * feedback_.axis_count + i]});
      break;
    case Kind::other:
      flatten("", other_, out);
      break;
  }
}

void MessageRows::append_spindles(std::size_t row, std::vector<Field>& out) const {
  const auto coupled = [&](const auto& batch) {
    if (row < batch.turning_radius.size()) out.push_back({"turning_radius", batch.turning_radius[row]});
    if (row >= batch.spindle.size()) return;
    out.push_back({"spindle_axis", batch.spindle_axis});
    out.push_back({"spindle", batch.spindle[row]});
    if (batch.follows_spindle) out.push_back({"follows_spindle", true});
  };
  if (kind_ == Kind::path) coupled(path_);
  if (kind_ == Kind::axis) coupled(axis_);
  if (kind_ != Kind::feedback) return;
  const auto& f = feedback_;
  const std::size_t spindles = f.spindle_speed.size();
  if ((row + 1) * spindles <= f.spindle_angle.size())
    for (std::size_t i = 0; i < spindles; ++i)
      out.push_back({name_of("spindle_angle", i), f.spindle_angle[row * spindles + i]});
  if (row + 1 != rows_) return;
  const auto taken =
      std::count_if(f.applied.begin(), f.applied.end(), [&](const auto& a) { return a.tick == f.tick; });
  const Moment moment{f.tick, static_cast<std::size_t>(taken)};
  const auto now = [&](const char* name, std::size_t i, const bus::Json& value) {
    out.push_back({name_of(name, i), value, true, moment});
  };
  for (std::size_t i = 0; i < spindles; ++i) now("spindle_speed", i, f.spindle_speed[i]);
  for (std::size_t i = 0; i < f.spindle_oriented.size(); ++i)
    now("spindle_oriented", i, f.spindle_oriented[i]);
  for (std::size_t i = 0; i < f.spindles.size(); ++i) {
    const auto& spindle = f.spindles[i];
    now("spindle_condition", i, bus::to_string(spindle.condition));
    now("spindle_reference", i, spindle.reference);
    now("spindle_homed", i, spindle.homed ? 1 : 0);
    now("spindle_gear", i, spindle.gear);
    now("spindle_master", i, spindle.master);
    now("spindle_synchronization_error", i, spindle.synchronization_error);
    now("spindle_correction", i, spindle.correction);
    now("spindle_torque", i, spindle.torque);
  }
}

void MessageRows::append_uncompared(std::size_t row, std::vector<Field>& out) const {
  if (kind_ != Kind::feedback || row + 1 != rows_) return;
  const auto& f = feedback_;
  for (std::size_t i = 0; i < f.velocity.size(); ++i) out.push_back({name_of("velocity", i), f.velocity[i]});
  for (std::size_t i = 0; i < f.torque.size(); ++i) out.push_back({name_of("torque", i), f.torque[i]});
}

std::string meaning_of(const std::string& field) {
  static constexpr std::pair<const char*, const char*> meanings[] = {
      {"spindle_angle", "angle, rev"},
      {"spindle_speed", "measured speed, 1/min"},
      {"spindle_oriented", "held at its orientation angle, 1 = yes"},
      {"spindle_condition", "condition"},
      {"spindle_reference", "commanded speed, 1/min"},
      {"spindle_homed", "its index mark was passed, 1 = yes"},
      {"spindle_gear", "gear, 0 = none"},
      {"spindle_master", "its master, counted from 0, -1 = none"},
      {"spindle_synchronization_error", "synchronization error, rev"},
      {"spindle_correction", "correction, 1/min"},
      {"spindle_torque", "torque, share of the most it has"}};
  for (const auto& [name, meaning] : meanings)
    for (std::size_t i = 0; i < most_spindles; ++i)
      if (field == name_of(name, i)) return "spindle " + std::to_string(i + 1) + ": " + meaning;
  return "";
}

}  // namespace trunnion::verification

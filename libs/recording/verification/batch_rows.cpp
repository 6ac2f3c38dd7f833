// SPDX-License-Identifier: Apache-2.0
#include "verification/batch_rows.hpp"

#include <algorithm>

#include "bus/codec.hpp"

namespace trunnion::verification {
namespace {

constexpr const char* path_letters[] = {"X", "Y", "Z", "A", "B", "C", "U", "V", "W"};
constexpr std::size_t path_width = std::size(path_letters);

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
  const auto coupled = [&](const auto& f) {
    if (row < f.turning_radius.size()) out.push_back({"turning_radius", f.turning_radius[row]});
    if (row >= f.spindle.size()) return;
    out.push_back({"spindle_axis", f.spindle_axis});
    out.push_back({"spindle", f.spindle[row]});
    if (f.follows_spindle) out.push_back({"follows_spindle", true});
  };
  const std::size_t spindles = feedback_.spindle_speed.size();
  switch (kind_) {
    case Kind::path:
      batch(path_);
      out.push_back({"transformation", bus::to_string(path_.transformation)});
      out.push_back({"tool_length", path_.tool_length});
      for (std::size_t i = 0; i < path_width; ++i)
        out.push_back({std::string("setpoint.") + path_letters[i], path_.setpoints[row * path_width + i]});
      coupled(path_);
      if (row + 1 == path_.count) states_of(path_, out);
      break;
    case Kind::axis:
      batch(axis_);
      for (std::size_t i = 0; i < axis_.axes.size(); ++i)
        out.push_back(
            {"setpoint.axis" + std::to_string(axis_.axes[i]), axis_.setpoints[row * axis_.axes.size() + i]});
      coupled(axis_);
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
      if ((row + 1) * spindles > feedback_.spindle_angle.size()) break;
      for (std::size_t i = 0; i < spindles; ++i)
        out.push_back(
            {"spindle_angle[" + std::to_string(i) + "]", feedback_.spindle_angle[row * spindles + i]});
      break;
    case Kind::other:
      flatten("", other_, out);
      break;
  }
}

void MessageRows::append_uncompared(std::size_t row, std::vector<Field>& out) const {
  const auto indexed = [&](const char* name, const auto& values, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      out.push_back({std::string(name) + "[" + std::to_string(i) + "]", values[first + i]});
  };
  if (kind_ != Kind::feedback) return;
  const auto& f = feedback_;
  const std::size_t spindles = f.spindle_speed.size();
  if (row + 1 != rows_) return;
  indexed("spindle_speed", f.spindle_speed, 0, spindles);
  indexed("spindle_oriented", f.spindle_oriented, 0, f.spindle_oriented.size());
  for (std::size_t i = 0; i < f.spindles.size(); ++i) {
    const auto place = "[" + std::to_string(i) + "]";
    out.push_back({"spindle_condition" + place, bus::to_string(f.spindles[i].condition)});
    out.push_back({"spindle_reference" + place, f.spindles[i].reference});
    out.push_back({"spindle_homed" + place, f.spindles[i].homed ? 1 : 0});
    out.push_back({"spindle_gear" + place, f.spindles[i].gear});
    out.push_back({"spindle_master" + place, f.spindles[i].master});
    out.push_back({"spindle_synchronization_error" + place, f.spindles[i].synchronization_error});
    out.push_back({"spindle_correction" + place, f.spindles[i].correction});
  }
  indexed("velocity", f.velocity, 0, f.velocity.size());
  indexed("torque", f.torque, 0, f.torque.size());
}

}  // namespace trunnion::verification

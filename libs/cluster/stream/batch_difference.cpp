// SPDX-License-Identifier: Apache-2.0
#include "stream/batch_difference.hpp"

#include <algorithm>
#include <cstdio>

#include "bus/json.hpp"
#include "stream/stage_names.hpp"

namespace trunnion::stream {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}
std::string number(std::uint64_t value) { return std::to_string(value); }

class Comparison {
 public:
  Comparison(Stage stage, unsigned copy_a, unsigned copy_b, std::uint64_t first)
      : head_("Replicas " + std::to_string(copy_a) + " and " + std::to_string(copy_b) + " of " +
              stage_name(stage) + " differ"),
        first_(first) {}

  template <class Value>
  void value(const std::string& what, std::uint64_t cycle, Value a, Value b) {
    if (found_ || a == b) return;
    const auto values = what + ": " + number(a) + " and " + number(b);
    found_ = {cycle, values, head_ + " in cycle " + std::to_string(cycle) + ", " + values};
  }
  template <class Value>
  void list(const std::string& what, std::uint64_t cycle, const std::vector<Value>& a,
            const std::vector<Value>& b) {
    value("length of " + what, cycle, std::uint64_t{a.size()}, std::uint64_t{b.size()});
    for (std::size_t i = 0; i < std::min(a.size(), b.size()) && !found_; ++i)
      if constexpr (std::is_floating_point_v<Value>)
        value(what + " " + std::to_string(i), cycle, a[i], b[i]);
      else
        value(what + " " + std::to_string(i), cycle, std::uint64_t{a[i]}, std::uint64_t{b[i]});
  }
  void rows(const std::vector<double>& a, const std::vector<double>& b, std::size_t columns) {
    value("length of setpoints", first_, std::uint64_t{a.size()}, std::uint64_t{b.size()});
    for (std::size_t i = 0; i < std::min(a.size(), b.size()) && !found_; ++i)
      value("column " + std::to_string(columns > 0 ? i % columns : i),
            first_ + (columns > 0 ? i / columns : 0), a[i], b[i]);
  }
  void states(const std::vector<idl::stream::StageState>& a, const std::vector<idl::stream::StageState>& b) {
    value("number of states", first_, std::uint64_t{a.size()}, std::uint64_t{b.size()});
    for (std::size_t i = 0; i < std::min(a.size(), b.size()) && !found_; ++i) {
      const std::string what = std::string("state of ") + stage_name(a[i].stage);
      value("stage of state " + std::to_string(i), first_, static_cast<std::uint64_t>(a[i].stage),
            static_cast<std::uint64_t>(b[i].stage));
      value(what + ", cycle", a[i].cycle, a[i].cycle, b[i].cycle);
      list(what + ", value", a[i].cycle, a[i].values, b[i].values);
    }
  }
  // The name of the first field that differs.
  void snapshot(const idl::stream::ChannelSnapshot& a, const idl::stream::ChannelSnapshot& b) {
    if (found_ || a == b) return;
    bus::Json left = bus::to_json(a), right = bus::to_json(b);
    for (const auto& [name, own] : left.items()) {
      if (own == right[name]) continue;
      const auto values =
          "snapshot of the channel, " + name + ": " + own.dump() + " and " + right[name].dump();
      found_ = {a.cycle, values, head_ + " in cycle " + std::to_string(a.cycle) + ", " + values};
      return;
    }
  }
  std::optional<BatchDifference> take() { return std::move(found_); }

 private:
  std::string head_;
  std::uint64_t first_;
  std::optional<BatchDifference> found_;
};

template <class Batch>
void compare_shape(Comparison& comparison, const Batch& a, const Batch& b) {
  comparison.value("count", a.first, std::uint64_t{a.count}, std::uint64_t{b.count});
  comparison.value("parameter revision", a.first, std::uint64_t{a.revision}, std::uint64_t{b.revision});
  comparison.value("ends", a.first, std::uint64_t{a.ends}, std::uint64_t{b.ends});
}

}  // namespace

bool same_values(const idl::stream::AxisBatch& a, const idl::stream::AxisBatch& b) {
  return a.count == b.count && a.revision == b.revision && a.ends == b.ends && a.axes == b.axes &&
         a.spindle_axis == b.spindle_axis && a.spindle == b.spindle && a.skip_move == b.skip_move &&
         a.follows_spindle == b.follows_spindle && a.turning_radius == b.turning_radius &&
         a.setpoints == b.setpoints && a.snapshot == b.snapshot && a.states == b.states;
}

bool same_values(const idl::stream::PathBatch& a, const idl::stream::PathBatch& b) {
  return a.count == b.count && a.revision == b.revision && a.ends == b.ends &&
         a.transformation == b.transformation && a.tool_length == b.tool_length &&
         a.spindle_axis == b.spindle_axis && a.spindle == b.spindle && a.skip_move == b.skip_move &&
         a.follows_spindle == b.follows_spindle && a.turning_radius == b.turning_radius &&
         a.setpoints == b.setpoints && a.snapshot == b.snapshot && a.states == b.states;
}

std::optional<BatchDifference> difference(const idl::stream::AxisBatch& a, const idl::stream::AxisBatch& b) {
  Comparison comparison(a.stage, a.replica, b.replica, a.first);
  compare_shape(comparison, a, b);
  comparison.list("axis", a.first, a.axes, b.axes);
  comparison.value("spindle axis", a.first, std::uint64_t{a.spindle_axis}, std::uint64_t{b.spindle_axis});
  comparison.list("spindle", a.first, a.spindle, b.spindle);
  comparison.value("skip move", a.first, std::uint64_t{a.skip_move}, std::uint64_t{b.skip_move});
  comparison.value("follows spindle", a.first, std::uint64_t{a.follows_spindle},
                   std::uint64_t{b.follows_spindle});
  comparison.list("turning radius", a.first, a.turning_radius, b.turning_radius);
  comparison.rows(a.setpoints, b.setpoints, a.axes.size());
  comparison.snapshot(a.snapshot, b.snapshot);
  comparison.states(a.states, b.states);
  return comparison.take();
}

std::optional<BatchDifference> difference(const idl::stream::PathBatch& a, const idl::stream::PathBatch& b) {
  Comparison comparison(Stage::CHANNEL, a.replica, b.replica, a.first);
  compare_shape(comparison, a, b);
  comparison.value("transformation", a.first, static_cast<std::uint64_t>(a.transformation),
                   static_cast<std::uint64_t>(b.transformation));
  comparison.value("tool length", a.first, a.tool_length, b.tool_length);
  comparison.value("spindle axis", a.first, std::uint64_t{a.spindle_axis}, std::uint64_t{b.spindle_axis});
  comparison.list("spindle", a.first, a.spindle, b.spindle);
  comparison.value("skip move", a.first, std::uint64_t{a.skip_move}, std::uint64_t{b.skip_move});
  comparison.value("follows spindle", a.first, std::uint64_t{a.follows_spindle},
                   std::uint64_t{b.follows_spindle});
  comparison.list("turning radius", a.first, a.turning_radius, b.turning_radius);
  comparison.rows(a.setpoints, b.setpoints, 9);
  comparison.snapshot(a.snapshot, b.snapshot);
  comparison.states(a.states, b.states);
  return comparison.take();
}

}  // namespace trunnion::stream

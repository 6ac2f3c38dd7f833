#include "channel_machine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "motion/path_segment.hpp"

namespace trunnion::channel {

void ChannelMachine::configure(const machine::Parameters& p) {
  auto chain = machine::make_chain(p, channel_);
  channel_axes_ = machine::channel_axes(p, channel_);
  chain_ = chain;
  const auto drive = machine::drive_axes(p);
  columns_.clear();
  mask_ = 0;
  limits_ = {};
  for (std::size_t i = 0; i < channel_axes_.index.size(); ++i) {
    const auto index = channel_axes_.index[i];
    const auto a = channel_axes_.number[i];
    columns_.push_back(machine::column_of(drive, a));
    mask_ = static_cast<std::uint16_t>(mask_ | (1u << index));
    limits_.axes[index] = {p.get("maximum_feed", a) / 60, p.get("rapid_feed", a) / 60,
                           p.get("maximum_acceleration", a), p.get("maximum_jerk", a)};
    travel_[index] = {p.get("negative_limit", a), p.get("positive_limit", a)};
    reference_[index] = p.get("reference_coordinate", a);
    jog_feed_[index] = p.get("jog_feed", a);
    reference_feed_[index] = p.get("reference_feed", a);
  }
  limits_.smoothing_cycles = p.integer("smoothing_cycles", channel_);
  limits_.contour_tolerance = p.get("contour_tolerance", channel_);
  limits_.arc_tolerance = p.get("arc_tolerance");
  limits_.smooth_corner_angle = p.get("smooth_corner_angle", channel_);
  limits_.centripetal_acceleration = p.get("centripetal_acceleration", channel_);
  limits_.orientation_tolerance = p.get("orientation_tolerance", channel_);
  radius_deviation_ = p.get("radius_deviation");
  cycle_seconds_ = p.get("interpolation_cycle") * 1e-6;
  lead_ = static_cast<std::uint64_t>(p.integer("stream_lead"));
  // Two frames must fit into the lead, or the credits would never let the second be written.
  const auto most = static_cast<std::uint32_t>(std::max<std::uint64_t>(1, lead_ / 2));
  frame_real_ = std::min(most, static_cast<std::uint32_t>(p.integer("frame_cycles_real_time")));
  frame_virtual_ = std::min(most, static_cast<std::uint32_t>(p.integer("frame_cycles_virtual_time")));
  revision_ = p.revision;
}

void ChannelMachine::set_tools(const idl::parameters::ToolTable& table) {
  tools_.clear();
  for (const auto& tool : table.tools) tools_[tool.number] = tool.length + tool.length_wear;
}

void ChannelMachine::set_offsets(const idl::parameters::WorkOffsets& table) {
  offsets_ = {};
  for (const auto& offset : table.offsets)
    if (offset.channel == channel_ && offset.index < offsets_.size())
      std::copy_n(offset.values.begin(), std::min(offset.values.size(), language::axis_count),
                  offsets_[offset.index].begin());
}

std::optional<double> ChannelMachine::tool_length(std::uint16_t h) const {
  const auto found = tools_.find(h);
  if (found == tools_.end()) return std::nullopt;
  return found->second;
}

AxisValues ChannelMachine::tip_from_machine(const AxisValues& machine, double tool_length) const {
  AxisValues result = machine;
  const auto tip = chain_->tip_from_machine({machine[0], machine[1], machine[2]},
                                            {machine[3], machine[4], machine[5]}, tool_length);
  std::copy_n(tip.data(), 3, result.begin());
  return result;
}

AxisValues ChannelMachine::machine_from_tip(const AxisValues& tip, double tool_length) const {
  AxisValues result = tip;
  const auto machine =
      chain_->machine_from_tip({tip[0], tip[1], tip[2]}, {tip[3], tip[4], tip[5]}, tool_length);
  std::copy_n(machine.data(), 3, result.begin());
  return result;
}

std::string ChannelMachine::travel_error(const AxisValues& from, const language::Command& move) const {
  const bool rtcp = move.modal.transformation == language::Transformation::rtcp;
  const auto path = move.kind == language::CommandKind::arc
                        ? motion::PathSegment::arc(from, move.target, move.arc)
                        : motion::PathSegment::line(from, move.target);
  // A line without transformation is farthest at its end; everything else is looked at along the way.
  const int places = rtcp || move.kind == language::CommandKind::arc ? 16 : 1;
  for (int k = 1; k <= places; ++k) {
    const AxisValues at = k == places ? move.target : path.position(path.length() * k / places);
    const AxisValues machine = rtcp ? machine_from_tip(at, move.modal.tool_length) : at;
    for (const auto index : channel_axes_.index) {
      if (machine[index] >= travel_[index].negative - 1e-6 &&
          machine[index] <= travel_[index].positive + 1e-6)
        continue;
      char text[160];
      std::snprintf(text, sizeof text, "%u: %c would go to %.4f, its travel is %.4f .. %.4f", move.line,
                    language::axis_letters[index], machine[index], travel_[index].negative,
                    travel_[index].positive);
      return text;
    }
  }
  return "";
}

}  // namespace trunnion::channel

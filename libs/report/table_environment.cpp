#include "report/table_environment.hpp"

#include "machine/axes.hpp"

namespace trunnion::report {

TableEnvironment::TableEnvironment(const MachineTables& tables)
    : chain_(machine::make_chain(tables.parameters, tables.channel)),
      radius_deviation_(tables.parameters.get("radius_deviation")) {
  const auto axes = machine::channel_axes(tables.parameters, tables.channel);
  for (std::size_t i = 0; i < axes.index.size(); ++i) {
    mask_ = static_cast<std::uint16_t>(mask_ | (1u << axes.index[i]));
    reference_[axes.index[i]] = tables.parameters.get("reference_coordinate", axes.number[i]);
  }
  for (const auto& tool : tables.tools.tools) tools_[tool.number] = tool.length + tool.length_wear;
  for (const auto& offset : tables.offsets.offsets)
    if (offset.channel == tables.channel && offset.index < offsets_.size())
      std::copy_n(offset.values.begin(), std::min(offset.values.size(), language::axis_count),
                  offsets_[offset.index].begin());
}

std::optional<double> TableEnvironment::tool_length(std::uint16_t h) const {
  const auto found = tools_.find(h);
  return found == tools_.end() ? std::nullopt : std::optional(found->second);
}

language::AxisValues TableEnvironment::tip_from_machine(const AxisValues& m, double length) const {
  AxisValues result = m;
  const Vec3 tip = chain_.tip_from_machine({m[0], m[1], m[2]}, geometry::angles_of(m.data()), length);
  std::copy_n(tip.data(), 3, result.begin());
  return result;
}

language::AxisValues TableEnvironment::machine_from_tip(const AxisValues& t, double length) const {
  AxisValues result = t;
  const Vec3 at = chain_.machine_from_tip({t[0], t[1], t[2]}, geometry::angles_of(t.data()), length);
  std::copy_n(at.data(), 3, result.begin());
  return result;
}

}  // namespace trunnion::report

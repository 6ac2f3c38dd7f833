// The tables of a machine as the interpreter asks for them.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "language/environment.hpp"
#include "report/programmed_path.hpp"

namespace trunnion::report {

/// Without subprograms from other texts. Throws std::runtime_error when the parameters make no chain.
class TableEnvironment final : public language::Environment {
 public:
  using AxisValues = language::AxisValues;

  explicit TableEnvironment(const MachineTables& tables);
  AxisValues work_offset(std::uint8_t index) const override { return offsets_[index < 6 ? index : 0]; }
  std::optional<double> tool_length(std::uint16_t h) const override;
  AxisValues reference_position() const override { return reference_; }
  AxisValues tip_from_machine(const AxisValues& machine, double tool_length) const override;
  AxisValues machine_from_tip(const AxisValues& tip, double tool_length) const override;
  std::uint16_t axes() const override { return mask_; }
  double radius_deviation() const override { return radius_deviation_; }
  language::TextSource* subprogram(std::string_view) override { return nullptr; }

 private:
  geometry::Chain chain_;
  double radius_deviation_;
  std::uint16_t mask_ = 0;
  AxisValues reference_{};
  std::map<std::uint32_t, double> tools_;
  std::array<AxisValues, 6> offsets_{};
};

}  // namespace trunnion::report

// SPDX-License-Identifier: Apache-2.0
#include "compensation/straightness.hpp"

#include "machine/parameter_constants.hpp"

namespace trunnion::compensation {

std::vector<Straightness> read_straightness(TableReader& reader, std::uint32_t a,
                                            const ChannelColumns& columns) {
  using namespace parameter;
  const std::pair<machine::IntegerParameter, TableParameters> both[] = {
      {straightness_first_axis,
       {straightness_first_type, straightness_first_start, straightness_first_points,
        straightness_first_interval, &straightness_first_modulo, &straightness_first_magnification,
        straightness_first_table}},
      {straightness_second_axis,
       {straightness_second_type, straightness_second_start, straightness_second_points,
        straightness_second_interval, &straightness_second_modulo, &straightness_second_magnification,
        straightness_second_table}}};
  std::vector<Straightness> found;
  for (const auto& [axis, table] : both) {
    auto values = reader.read(table, a);
    if (!values.enabled) continue;
    const auto column = columns.of(reader.parameters(), axis, a);
    reader.check_turns(values, table, a, columns.numbers[column]);
    found.push_back({column, std::move(values)});
  }
  return found;
}

}  // namespace trunnion::compensation

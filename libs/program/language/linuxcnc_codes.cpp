// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_codes.hpp"

#include "language/code_row.hpp"

namespace trunnion::language {
namespace {

constexpr std::array linuxcnc_rows = {
    GCode{own_code + 40, Group::one_block, AxisWords::passed,
          run<&BlockHandlers::linuxcnc_modes, &LinuxcncModes::dwell>, "dwell of P seconds, before the motion",
          Origin::linuxcnc, "0.3", "G4 P0.5"},
    GCode{own_code + 70, Group::diameter, AxisWords::move,
          run<&BlockHandlers::linuxcnc_modes, &LinuxcncModes::set_diameter, true>,
          "X words are diameters: only where parameter 040032 says so", Origin::linuxcnc, "0.3", "G7"},
    GCode{own_code + 80, Group::diameter, AxisWords::move,
          run<&BlockHandlers::linuxcnc_modes, &LinuxcncModes::set_diameter, false>,
          "X words are radii: only where parameter 040032 says so", Origin::linuxcnc, "0.3", "G8"},
    GCode{own_code + 591, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::frames, &FrameCodes::set_work_offset, 6>, "work offset 7: G54.1 P1",
          Origin::linuxcnc, "0.3", "G59.1"},
    GCode{own_code + 592, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::frames, &FrameCodes::set_work_offset, 7>, "work offset 8: G54.1 P2",
          Origin::linuxcnc, "0.3", "G59.2"},
    GCode{own_code + 593, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::frames, &FrameCodes::set_work_offset, 8>, "work offset 9: G54.1 P3",
          Origin::linuxcnc, "0.3", "G59.3"},
    GCode{own_code + 901, Group::centre_distance, AxisWords::move,
          run<&BlockHandlers::linuxcnc_modes, &LinuxcncModes::set_centre_distance, true>,
          "I J K of circles are coordinates", Origin::linuxcnc, "0.3", "G90.1 G2 X2 I1 J0 F100"},
    GCode{own_code + 911, Group::centre_distance, AxisWords::move,
          run<&BlockHandlers::linuxcnc_modes, &LinuxcncModes::set_centre_distance, false>,
          "I J K of circles count from the start", Origin::linuxcnc, "0.3", "G91.1"},
    GCode{own_code + 960, Group::spindle_mode, AxisWords::move,
          run<&BlockHandlers::linuxcnc_modes, &LinuxcncModes::set_surface_speed>,
          "constant surface speed: S in m/min (ft/min with G20), at most D 1/min", Origin::linuxcnc, "0.3",
          "G96 S100 D2000"},
};

constexpr std::uint8_t no_linuxcnc_code = 0xff;
/// Tenths of LinuxCNC to a row: of the shared codes first, then of its own.
constexpr auto linuxcnc_index = [] {
  std::array<std::uint8_t, 1000> index{};
  index.fill(no_linuxcnc_code);
  for (std::size_t i = 0; i < linuxcnc_shared_codes.size(); ++i)
    index[linuxcnc_shared_codes[i].tenths] = static_cast<std::uint8_t>(i);
  for (std::size_t i = 0; i < linuxcnc_rows.size(); ++i)
    index[linuxcnc_rows[i].tenths - own_code] = static_cast<std::uint8_t>(linuxcnc_shared_codes.size() + i);
  return index;
}();
static_assert(linuxcnc_shared_codes.size() + linuxcnc_rows.size() < no_linuxcnc_code);

const char* missing_name(std::span<const LinuxcncMissingCode> rows, std::uint32_t number) {
  for (const LinuxcncMissingCode& row : rows)
    if (number >= row.first && number <= row.last) return row.name;
  return nullptr;
}

}  // namespace

constinit const std::span<const GCode> linuxcnc_own_codes = linuxcnc_rows;

const GCode* linuxcnc_g_code(std::uint32_t tenths) {
  if (tenths >= linuxcnc_index.size() || linuxcnc_index[tenths] == no_linuxcnc_code) return nullptr;
  const std::size_t place = linuxcnc_index[tenths];
  if (place >= linuxcnc_shared_codes.size()) return &linuxcnc_rows[place - linuxcnc_shared_codes.size()];
  return g_code(linuxcnc_shared_codes[place].code);
}

const char* linuxcnc_missing_g(std::uint32_t tenths) { return missing_name(linuxcnc_missing_codes, tenths); }

const char* linuxcnc_missing_m(std::uint32_t number) {
  return missing_name(linuxcnc_missing_m_codes, number);
}

}  // namespace trunnion::language

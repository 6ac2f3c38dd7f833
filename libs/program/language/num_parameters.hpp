// SPDX-License-Identifier: Apache-2.0
// The external parameters (E) of the NUM dialect.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace trunnion::language {

/// Parameters of equal meaning with successive numbers, one for each spindle where there are four.
struct ExternalParameter {
  std::uint32_t first;
  std::uint8_t count;
  const char* mnemonic;  ///< four are MESPOSB1 .. MESPOSB4; empty: the manual at hand has none
  bool writable;         ///< a program may write it on a NUM control
  const char* unit;
  const char* meaning;
};

/// Programs store what they like in these; they are #900 .. #950.
inline constexpr std::uint32_t first_free_parameter = 80000, free_parameters = 51, first_free_variable = 900;

/// Axes in the order of their addresses on a NUM control, from 0: E91100 is that of X, L0 = 8 of 9990.9 is C.
inline constexpr std::string_view addressed_axes = "XYZUVWABC";

inline constexpr std::array external_parameters = {
    ExternalParameter{11012, 1, "", true, "", "1: high-speed machining"},
    ExternalParameter{35300, 32, "", true, "", "parameter sets of the drive: 0 spindle, 11 C axis"},
    ExternalParameter{79000, 1, "MESPOSBG", false, "", "measured position, spindle of the channel"},
    ExternalParameter{79001, 1, "REFVITBG", false, "", "speed reference, spindle of the channel"},
    ExternalParameter{80000, 51, "", true, "", "free for programs, whole numbers"},
    ExternalParameter{90100, 4, "MESPOSB", false, "1/100000", "measured position"},
    ExternalParameter{90110, 4, "MODULOB", false, "", "modulo of the position"},
    ExternalParameter{90124, 4, "ASS_B", true, "", "1: in position control"},
    ExternalParameter{90200, 4, "REFVITB", false, "", "speed reference"},
    ExternalParameter{90300, 4, "VITPALB", true, "", "highest speed when indexing"},
    ExternalParameter{90310, 4, "FENETRE", true, "rev/65536", "window of position and synchronization"},
    ExternalParameter{90320, 4, "GAINB", true, "1/min/rev", "gain of the position loop, K0"},
    ExternalParameter{90330, 4, "ACCB", true, "deg/s2", "largest acceleration"},
    ExternalParameter{90360, 4, "ACCKFNB", true, "1/1000", "acceleration by speed; of a slave phase lead"},
    ExternalParameter{90370, 4, "N_CMAXB", true, "1/min", "highest speed at the largest torque"},
    ExternalParameter{90380, 4, "N_PMAXB", true, "1/min", "highest speed at the largest power"},
    ExternalParameter{90390, 4, "MAXGANB", false, "1/min", "largest speed of the range"},
    ExternalParameter{91008, 1, "", true, "", "1: C axis in position control"},
    ExternalParameter{91024, 4, "", true, "", "0: speed control"},
    ExternalParameter{91100, 9, "", false, "", "1: axis not homed"},
    ExternalParameter{91124, 4, "POM_B", false, "", "1: not homed"},
    ExternalParameter{93524, 4, "POS_B", false, "", "1: synchronized"},
    ExternalParameter{94124, 4, "MASTERB", true, "", "address of the master, 24 to 27; -1: none"},
    ExternalParameter{94200, 32, "", true, "", "address of the measurement that belongs to a reference"},
    ExternalParameter{95024, 4, "REFPOSB", false, "", "position reference"},
    ExternalParameter{95224, 4, "ERRSYNB", false, "", "synchronization error"},
    ExternalParameter{98024, 4, "TIB", true, "ms", "integral time: 0 none, below 0 frozen"},
};

/// One parameter: its row, and its place in it from 0.
struct ExternalPlace {
  const ExternalParameter* row = nullptr;
  std::uint32_t index = 0;
  std::uint32_t number() const { return row->first + index; }
  bool is_free() const { return row->first == first_free_parameter; }
  /// "POM_B1 (E91124)"; empty without a mnemonic.
  const char* name() const;
};

std::optional<ExternalPlace> external_parameter(std::uint32_t number);
/// By its mnemonic in capitals.
std::optional<ExternalPlace> external_parameter(std::string_view mnemonic);

}  // namespace trunnion::language

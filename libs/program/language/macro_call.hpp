// SPDX-License-Identifier: Apache-2.0
// Calls of macros and cycles: what is called, and the variables its letters become.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "language/block.hpp"
#include "language/codes.hpp"
#include "language/environment.hpp"

namespace trunnion::language {

/// The program a Command, an alarm or a call names: 0 the started one, n the text O000n, and this one the
/// file of canned cycles.
inline constexpr std::uint32_t cycle_file = 1000000000;
/// The first of the files that the started program calls by a name (LinuxCNC): Interpreter::file_name().
inline constexpr std::uint32_t named_texts = 3000000000;

/// What each tenth adds to the number of a program of the NUM dialect: %9990.9 is 900009990.
inline constexpr std::uint32_t program_tenth = 100000000;

/// "O" and at least four digits, with a point and a digit of the NUM dialect ("O9990.9"), or "USERDEF.CYC".
class ProgramName {
 public:
  explicit ProgramName(std::uint32_t program);
  std::string_view view() const { return {text_.data(), size_}; }

 private:
  std::array<char, 16> text_{};
  std::size_t size_ = 0;
};

enum class CallKind : std::uint8_t {
  subprogram,    ///< M98: shares the variables of its caller
  macro,         ///< G65: a level of its own, letters after Fanuc's argument lists I and II
  modal_macro,   ///< G66: as macro, after each motion until G67
  block_macro,   ///< G66.1: instead of each block until G67, whose letters are the arguments
  modal_cancel,  ///< G67
  cycle,         ///< G1000..G1999 or a user M code: a level of its own, letter A is #0 .. Z is #25
  control,       ///< a macro of the control carries the code out: as macro, also with L, P and the code
  subroutine,    ///< o<name> call of LinuxCNC: a level of its own, #1 to #30 by their place
};

/// What G12 and G13, and G37 call: no number that part programs usually have.
inline constexpr std::uint32_t circular_pocket_macro = 90120, length_measuring_macro = 90370;
inline constexpr std::uint16_t length_measuring_code = 370;  // tenths

/// G codes that call programs; they are the only code of their block, but for G90 or G91 beside those of the
/// control.
struct CallCode {
  std::uint16_t first;  ///< tenths
  std::uint16_t last;
  CallKind kind;
  const char* meaning;
  Origin origin;
  const char* since;    ///< version of Trunnion
  const char* example;  ///< a program that shows the code
};
inline constexpr std::array call_codes = {
    CallCode{
        120, 120, CallKind::control,
        "circular pocket clockwise about the position or X Y: I its radius, or that of the first circle and "
        "K of the last with steps of Q; D cutter radius, Z depth, L passes of Z in G91, F",
        Origin::haas, "0.3", "G12 I20 D1 Z-2 F100\nM30\nO90120\nM99"},
    CallCode{130, 130, CallKind::control, "circular pocket counter-clockwise; words as G12", Origin::haas,
             "0.3", "G13 I20 D1 Z-2 F100\nM30\nO90120\nM99"},
    CallCode{
        370, 370, CallKind::control,
        "measures the length of the tool: contact is expected at Z; what it differs by is added to the wear "
        "of the active length H; R D F instead of parameters 04c767 to 04c769",
        Origin::fanuc, "0.3", "G90 G37 Z5\nM30\nO90370\nM99"},
    CallCode{650, 650, CallKind::macro, "macro call: P program, L repetitions, letters as arguments",
             Origin::fanuc, "0.2", "G65 P9010 A5\nM30\nO9010\nM99"},
    CallCode{660, 660, CallKind::modal_macro, "macro call as G65 behind each block that moves, until G67",
             Origin::fanuc, "0.2", "G66 P9010 A5\nG0 X1\nG67\nM30\nO9010\nM99"},
    CallCode{661, 661, CallKind::block_macro,
             "macro call instead of each block behind, whose letters are the arguments, until G67",
             Origin::fanuc, "0.2", "G66.1 P9010\nX1 Y2\nG67\nM30\nO9010\nG0 X#24 Y#25\nM99"},
    CallCode{670, 670, CallKind::modal_cancel, "end of the modal macro call", Origin::fanuc, "0.2", "G67"},
    CallCode{10000, 19990, CallKind::cycle,
             "user cycle: the program of that number in USERDEF.CYC, letters as arguments", Origin::hnc,
             "0.2", "G1007 X1"},
};

struct Call {
  CallKind kind = CallKind::subprogram;
  std::uint32_t number = 0;  ///< of the program
  std::uint64_t name = 0;    ///< of the subroutine, as Block::name
  std::uint32_t repetitions = 1;
  bool counted = true;               ///< L was given, or no number can hold the repetitions
  std::uint16_t code = 0;            ///< tenths, of kind control
  std::uint16_t offset = 0;          ///< of the code in its line
  std::uint16_t program_offset = 0;  ///< of the word that names the program
  bool by_code = false;              ///< by a code that is an ordinary one in the program
  bool from_label = false;           ///< begins at the sequence number `label`
  std::uint32_t label = 0;
  std::uint16_t label_offset = 0;
};

/// The M codes that call G1007 .. G1014, 0 for none (parameters 010170 .. 010177).
using CycleMCodes = std::array<std::uint16_t, 8>;

/// Whether `block` calls a macro or a cycle.
bool find_call(const Block& block, const CycleMCodes& cycle_m_codes, Call& call);

/// Whether a code of `block` calls a program because `calls` says so: a macro, or a subprogram, whose code is
/// then no longer in the block. `variable` is the common variable that gets the number behind T or S, and
/// `value` that number; 0 = none.
bool take_code_call(Block& block, const CodeCalls& calls, Call& call, std::uint32_t& variable, double& value);

/// The arguments of a macro that take_code_call has found: as those of G65, and P is #16.
Fault read_code_call(const Block& block, bool absolute, Call& call, Arguments& arguments);

/// Completes a call that find_call has found: P, L and that nothing else is in the block.
Fault read_call(const Block& block, Call& call);

/// The letters of the block as variables. Of a block that CallKind::block_macro has swallowed also G (the
/// last one), L, N and P: #10, #12, #14 and #16. Of kind control also L and P.
void read_arguments(const Block& block, CallKind kind, bool absolute, Arguments& arguments);

/// Fanuc's argument list I: the variable each letter becomes; letters that are no arguments are not in it.
struct ArgumentLetter {
  char letter;
  std::uint8_t variable;
};
inline constexpr std::array argument_letters = {
    ArgumentLetter{'A', 1},  ArgumentLetter{'B', 2},  ArgumentLetter{'C', 3},  ArgumentLetter{'D', 7},
    ArgumentLetter{'E', 8},  ArgumentLetter{'F', 9},  ArgumentLetter{'H', 11}, ArgumentLetter{'I', 4},
    ArgumentLetter{'J', 5},  ArgumentLetter{'K', 6},  ArgumentLetter{'M', 13}, ArgumentLetter{'Q', 17},
    ArgumentLetter{'R', 18}, ArgumentLetter{'S', 19}, ArgumentLetter{'T', 20}, ArgumentLetter{'U', 21},
    ArgumentLetter{'V', 22}, ArgumentLetter{'W', 23}, ArgumentLetter{'X', 24}, ArgumentLetter{'Y', 25},
    ArgumentLetter{'Z', 26},
};

}  // namespace trunnion::language

// SPDX-License-Identifier: Apache-2.0
// What a program uses and how far it goes: tools, times, speeds, offsets, calls.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/block_calls.hpp"
#include "analysis/motion_tracker.hpp"
#include "analysis/warnings.hpp"
#include "channel_setup/channel_setup.hpp"
#include "language/block_watch.hpp"

namespace trunnion::analysis {

struct Range {
  double low = 0, high = 0;
  bool any = false;
  void include(double value);
};

struct ToolFigures {
  std::uint16_t number = 0;  ///< 0: before the first tool change
  WarningPlace first;        ///< of its first change or move; the column is 1
  std::uint32_t changes = 0;
  std::vector<std::uint16_t> lengths, radii;  ///< H and D, each once, in the order of their use
  double cut = 0, rapid = 0;                  ///< s
  Range speed;                                ///< 1/min of moves at feed
  Range feed;                                 ///< mm/min, where only rotary axes move degrees/min
};

struct TimeFigures {
  double cut = 0, rapid = 0, dwell = 0, change = 0;  ///< s
  double total() const { return cut + rapid + dwell + change; }
};

/// Something that the program names, at the first place.
struct NamedFigure {
  std::string name;
  WarningPlace place;
  std::uint64_t blocks = 0;
  std::string text;  ///< what there is to say of it
};

/// A largest value and its line.
struct Highest {
  double value = 0;
  WarningPlace place;
};

/// Where the tool tip goes, workpiece coordinates: X Y Z, mm.
struct OffsetFigures {
  bool used = false;
  language::Vector3 low{}, high{};
};

class ProgramFigures {
 public:
  /// `machine` is null when none is named; then rapids have no time and axes no travel. `functions`: the M
  /// codes of its logic, or null. Both must outlive the figures.
  ProgramFigures(const language::Environment& environment, const channel_setup::ChannelSetup* machine,
                 const language::MFunctions* functions);

  void begin(const language::SeenBlock& seen);
  /// `move` is what motion gets of the command, `from` where it begins, in its frame; `interpreter` has just
  /// given the command.
  void see(const language::Command& command, const language::Command& move, const language::AxisValues& from,
           const std::optional<Motion>& motion, const language::Interpreter& interpreter);

  const std::vector<ToolFigures>& tools() const { return tools_; }
  const TimeFigures& time() const { return time_; }
  std::uint32_t changes() const { return changes_; }
  double rapid_length() const { return rapid_length_; }
  double cut_length() const { return cut_length_; }
  /// Lines of DPRNT.
  std::uint64_t printed() const { return printed_; }
  const std::array<OffsetFigures, language::work_offset_count>& offsets() const { return offsets_; }
  /// Machine coordinates of all moves; nothing without a machine or a move.
  const std::optional<channel_setup::AxisBox>& axes() const { return axes_; }
  /// How far the moves stay within the travel of `axis`, mm or degrees; nothing where there is none.
  std::optional<double> reserve(std::size_t axis) const;
  const std::vector<NamedFigure>& calls() const { return calls_; }
  const std::vector<NamedFigure>& cycles() const { return cycles_; }
  const std::vector<NamedFigure>& without_effect() const { return without_effect_; }
  const std::vector<NamedFigure>& unknown_m() const { return unknown_m_; }
  /// Where no machine is named: M codes that are in no table of the control.
  const std::vector<NamedFigure>& other_m() const { return other_m_; }
  const Highest& highest_speed() const { return highest_speed_; }
  const Highest& highest_feed() const { return highest_feed_; }
  const channel_setup::ChannelSetup* machine() const { return machine_; }

 private:
  ToolFigures& tool(const language::Command& command);
  /// Whether the letters of the block are arguments; else block_calls_.rest() is what it does besides.
  bool note_calls(const language::SeenBlock& seen);
  void note_subprograms(const language::SeenBlock& seen);
  void note_codes(const language::SeenBlock& seen);
  /// The logic of the machine must have it.
  bool is_unknown(std::uint16_t m) const;
  void note_rapid(const Motion& motion, ToolFigures& tool);
  void note_feed(const language::Command& command, const Motion& motion, ToolFigures& tool);
  void note_tip(const language::Command& command, const language::AxisValues& from,
                const language::Interpreter& interpreter);

  const channel_setup::ChannelSetup* machine_;
  const language::MFunctions* functions_;
  BlockCalls block_calls_;
  std::vector<ToolFigures> tools_;
  std::size_t tool_ = 0;  // of tools_, the newest one
  TimeFigures time_;
  std::uint32_t changes_ = 0;
  std::uint64_t printed_ = 0;
  double rapid_length_ = 0, cut_length_ = 0;
  std::array<OffsetFigures, language::work_offset_count> offsets_{};
  std::optional<channel_setup::AxisBox> axes_;
  std::vector<NamedFigure> calls_, cycles_, without_effect_, unknown_m_, other_m_;
  Highest highest_speed_, highest_feed_;
  std::uint32_t block_program_ = 0, block_line_ = 0;
  bool in_machine_coordinates_ = false;  // the block goes to a place of the machine: G53, G27, G28, G30
};

/// "G54" .. "G59", "G54.1 P1" .. of ModalState::work_offset.
std::string work_offset_name(std::size_t index);

}  // namespace trunnion::analysis

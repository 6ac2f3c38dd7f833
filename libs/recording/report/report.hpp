// SPDX-License-Identifier: Apache-2.0
// What a run was like: a pure function of its recording and its program.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "report/programmed_path.hpp"

namespace trunnion::report {

/// The tool tip in the workpiece frame, mm, as ProgrammedPath::path. `loads`: mm and deg, by axis letter;
/// `approach`: direction of the last motion of each (-1, 0 before the first, 1); `tool_length`: mm.
using TrueTip = std::function<Vec3(const language::AxisValues& loads, const std::array<int, 9>& approach,
                                   double tool_length)>;

/// What a recording may not contain. Empty tables are taken from the recording.
struct ReportInputs {
  std::string program_name;
  std::string program_text;
  std::uint16_t channel = 0;
  std::optional<machine::Parameters> parameters;  ///< used when the recording has none
  std::optional<idl::parameters::ToolTable> tools;
  std::optional<idl::parameters::WorkOffsets> offsets;
  TrueTip true_tip;  ///< of a machine whose true geometry is known; empty: the report does not state it
};

/// Distances of the tool tip from the programmed path, over the cycles of one kind of motion.
struct ContourError {
  std::uint64_t cycles = 0;
  double largest = 0;       ///< mm
  double rms = 0;           ///< mm
  std::uint64_t cycle = 0;  ///< of the largest
  std::uint32_t line = 0;   ///< program line of the largest
};

struct Latency {
  std::string from, to;
  std::uint64_t batches = 0;
  double median = 0, p99 = 0, largest = 0;  ///< s
};

/// One cycle of the motion, for the pictures.
struct Sample {
  std::uint64_t cycle = 0;
  std::uint32_t line = 0;
  bool rapid = false;
  bool has_actual = false;
  Vec3 commanded = Vec3::Zero(), actual = Vec3::Zero();            ///< tip, mm, as ProgrammedPath::path
  Vec3 commanded_foot = Vec3::Zero(), actual_foot = Vec3::Zero();  ///< nearest point of the programmed path
  double commanded_feed = 0, actual_feed = 0;                      ///< mm/min of the tip over the workpiece
};

struct Report {
  std::string recording, program, machine, version, contract;
  std::uint64_t messages = 0;
  std::string problem;  ///< of the recording or the program; empty when there is none

  ProgrammedPath programmed;
  std::vector<Sample> samples;
  double period = 0.001;       ///< s, of a cycle
  std::uint64_t cycles = 0;    ///< commanded
  std::uint64_t executed = 0;  ///< of them in the feedback
  double wall_seconds = 0;     ///< between the first and the last feedback of the motion
  double speed = 0;            ///< machine time over wall time; 0 when unknown

  /// The actual positions are those of the encoders, behind the play of the axes (10a910). Of an axis without
  /// play what compensation has added in the same cycle is taken off: they are compared with its command.
  ContourError commanded_feed, commanded_rapid, actual_feed, actual_rapid;
  /// The same positions by the true geometry (ReportInputs::true_tip) in the place of the control's chain.
  ContourError true_feed, true_rapid;
  /// Forward kinematics of the axes' setpoints against the tip they were made from: the kinematics' rounding,
  /// and the compensation's and gantry's corrections when these are on.
  std::uint64_t residual_cycles = 0;
  double residual_largest = 0, residual_rms = 0;  ///< mm
  double mean_feed = 0, largest_feed = 0;         ///< mm/min commanded on the lines at feed

  std::map<std::string, std::uint64_t> lost;  ///< cycles missing, by topic handle
  std::uint64_t late_batches = 0, repeated_batches = 0, starved = 0;
  std::vector<Latency> latencies;
  /// FNV-1a (64 bit) of the drive's commands: for every cycle of the motion the doubles of every axis as they
  /// are in memory. Two runs with the same hash moved the machine the same, bit for bit.
  std::uint64_t command_hash = 0;
};

/// `recording` is a file's path. Throws std::runtime_error when it cannot be read or when neither it nor the
/// inputs have parameters; anything missing is stated in Report::problem.
Report make_report(const std::string& recording, const ReportInputs& inputs);

/// Writes report.json, report.txt, path.svg and feed.svg into `directory`, which is made when it does not
/// exist. Throws std::runtime_error naming the file that cannot be written.
void write_report(const Report& report, const std::string& directory);

/// Some twenty lines with units.
std::string terminal_text(const Report& report);
std::string json_text(const Report& report);
/// Pictures as SVG documents.
std::string path_picture(const Report& report);
std::string feed_picture(const Report& report);

}  // namespace trunnion::report

// SPDX-License-Identifier: Apache-2.0
// The slave axes of a machine's gantries and the masters they follow (parameters 010050.., 10a062,
// 10a100..10a131, 10a940..10a944).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "machine/axes.hpp"
#include "machine/parameter_fault.hpp"

namespace trunnion::machine {

/// The function words of a servo drive for gantries, HNC-8 PB64 and PB65: a decimal digit each.
struct DriveSynchronization {
  bool on = false;              ///< PB64 units
  bool slave = false;           ///< PB64 tens
  bool torque_follow = false;   ///< PB64 hundreds
  bool current_checked = true;  ///< PB64 thousands are 0
  bool inverted = false;        ///< PB64 ten-thousands: the followed torque has the opposite sign
  bool compensates = false;     ///< PB65 units
  bool common_stop = false;     ///< PB65 tens
  double gain = 0;              ///< 1/s: PB66 counts 0.01 1/s
  static DriveSynchronization from(const Parameters& parameters, std::uint32_t axis);
};

struct GantryPair {
  std::uint16_t master = 0, slave = 0;           ///< logical axis numbers
  double sign = 1;                               ///< -1: the coordinates of the slave count the opposite way
  double zero_deviation = 0;                     ///< mm, slave position when the master is at zero
  bool aligns = false;                           ///< 10a062
  double alignment_limit = 0;                    ///< mm, largest error that is aligned
  double alignment_rate = 0;                     ///< mm in one cycle
  double limit = 0;                              ///< mm, 0 = off
  double speed_limit = 0;                        ///< mm/min, 0 = off
  double current_limit = 0;                      ///< A, 0 = off
  double master_current = 0, slave_current = 0;  ///< A at the rated torque
  int master_column = -1, slave_column = -1;     ///< in the drive's feedback

  /// Position of the slave that belongs to a position of the master, mm.
  double slave_position(double master_position) const { return sign * master_position + zero_deviation; }
  /// Synchronization error: position of the slave less the one that belongs to its master's, mm.
  double error(double master_position, double slave_position_now) const {
    return slave_position_now - slave_position(master_position);
  }
};

/// Whether `axis` of 010051.. follows a master (10a100).
bool is_gantry_slave(const Parameters& parameters, int axis);

/// What keeps `slave` from following its master: one of them does not exist, or they are the same. `axes` are
/// the drive_axes().
std::optional<ParameterFault> gantry_fault(const Parameters& parameters, const std::vector<AxisInfo>& axes,
                                           int slave);

/// Every pair of the machine. Throws std::runtime_error with the text of the first gantry_fault().
std::vector<GantryPair> gantry_pairs(const Parameters& parameters);

/// Those whose master is an axis of `channel`.
std::vector<GantryPair> gantry_pairs(const Parameters& parameters, std::uint16_t channel);

/// The parameter that makes the places where both sides are now belong together.
struct AutoOffset {
  std::uint32_t number = 0;
  double now = 0, proposal = 0;  ///< mm
};
/// `error` mm: GantryPair::error() without what compensation accounts for.
AutoOffset auto_offset(const Parameters& parameters, const GantryPair& pair, double error);

/// Whether `axis` moves with `channel`: it is an axis of the channel, or the slave of one. False when the
/// gantry parameters are not valid.
bool axis_moves_with(const Parameters& parameters, std::uint16_t axis, std::uint16_t channel);

}  // namespace trunnion::machine

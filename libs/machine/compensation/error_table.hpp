// SPDX-License-Identifier: Apache-2.0
// A table of compensation values over the machine coordinate of an axis (parameters 70xxxx).
#pragma once

#include <vector>

#include "machine/axes.hpp"

namespace trunnion::compensation {

/// Values at equal distances, interpolated linearly; outside the travel the boundary value holds unless the
/// table is modulo: one interval after the last value comes the first again.
struct ErrorTable {
  bool enabled = false;
  bool bidirectional = false;  ///< `negative` holds when the axis moves in negative direction
  bool modulo = false;
  double start = 0, interval = 1, factor = 1;
  std::vector<double> positive, negative;

  /// What to add at coordinate `x` (of the axis, or degrees Celsius), in the unit of the values.
  double at(double x, bool positive_direction) const;
};

/// The parameters that describe one table.
struct TableParameters {
  machine::IntegerParameter type;  ///< 0 off, 1 one direction, 2 both: the positive values first
  machine::NumericParameter start;
  machine::IntegerParameter points;
  machine::NumericParameter interval;
  const machine::IntegerParameter* modulo;
  const machine::NumericParameter* factor;
  machine::IntegerParameter table;
};

/// Reads the tables of one channel. Every function throws machine::KinematicsError that names the parameter
/// and its limit.
class TableReader {
 public:
  explicit TableReader(const machine::Parameters& parameters) : parameters_(parameters) {}

  /// Of axis `number`, whatever its type parameter says: `type` is 0, 1 or 2.
  ErrorTable read(const TableParameters& table, std::uint32_t number, int type);
  ErrorTable read(const TableParameters& table, std::uint32_t number) {
    return read(table, number, parameters_.integer(table.type, number));
  }
  /// Refuses a table over the axis `over` that does not hold at every turn of it.
  void check_turns(const ErrorTable& table, const TableParameters& read_from, std::uint32_t number,
                   std::uint16_t over) const;
  /// Counts values that are read elsewhere.
  void count(std::size_t values);
  const machine::Parameters& parameters() const { return parameters_; }

 private:
  const machine::Parameters& parameters_;
  std::size_t values_ = 0;
};

/// Fails with "parameter 300031 (name) <text>" as machine::KinematicsError.
[[noreturn]] void refuse(const machine::ParameterKey& parameter, std::uint32_t unit, const std::string& text);

}  // namespace trunnion::compensation

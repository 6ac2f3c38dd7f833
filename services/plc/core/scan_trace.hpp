// SPDX-License-Identifier: Apache-2.0
// Values of chosen variables after each of a number of scans.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "places.hpp"

namespace trunnion::plc {

inline constexpr std::size_t most_trace_cells = 1000000;
inline constexpr std::size_t trace_time_cells =
    2;  ///< before the values of a row: PLC time in ms, drive tick

class ScanTrace {
 public:
  struct Condition {
    idl::plc::TraceCondition kind = idl::plc::TraceCondition::AT_ONCE;
    ValuePlace place;  ///< of one cell
    idl::plc::ValueKind value_kind = idl::plc::ValueKind::SIGNED_VALUE;
    std::uint64_t value = 0;
  };
  /// Allocates all rows. `scans` times the cells of a row is at most most_trace_cells.
  ScanTrace(std::vector<ValuePlace> columns, std::uint32_t scans, Condition condition);

  /// After each scan: no allocation.
  void after_scan(const Memory& memory);
  std::uint32_t rows() const { return rows_; }
  bool complete() const { return rows_ == scans_; }
  /// Cells of one row.
  std::size_t width() const { return width_; }
  std::span<const std::uint64_t> row(std::uint32_t number) const {
    return std::span(cells_).subspan(number * width_, width_);
  }

 private:
  bool begins(const Memory& memory);

  std::vector<ValuePlace> columns_;
  std::uint32_t scans_, rows_ = 0;
  Condition condition_;
  std::optional<std::uint64_t> last_;  ///< of the condition's variable
  bool started_ = false;
  std::size_t width_ = trace_time_cells;
  std::vector<std::uint64_t> cells_;
};

}  // namespace trunnion::plc

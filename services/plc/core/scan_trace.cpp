// SPDX-License-Identifier: Apache-2.0
#include "scan_trace.hpp"

#include "plc/machine/arithmetic.hpp"

namespace trunnion::plc {
namespace {

bool is_less(idl::plc::ValueKind kind, std::uint64_t a, std::uint64_t b) {
  using enum idl::plc::ValueKind;
  switch (kind) {
    case REAL_VALUE:
      return st::as_float(a) < st::as_float(b);
    case LREAL_VALUE:
      return st::as_double(a) < st::as_double(b);
    case UNSIGNED_VALUE:
      return a < b;
    default:
      return st::as_signed(a) < st::as_signed(b);
  }
}

bool is_equal(idl::plc::ValueKind kind, std::uint64_t a, std::uint64_t b) {
  if (kind == idl::plc::ValueKind::REAL_VALUE) return st::as_float(a) == st::as_float(b);
  if (kind == idl::plc::ValueKind::LREAL_VALUE) return st::as_double(a) == st::as_double(b);
  return a == b;
}

}  // namespace

ScanTrace::ScanTrace(std::vector<ValuePlace> columns, std::uint32_t scans, Condition condition)
    : columns_(std::move(columns)), scans_(scans), condition_(condition) {
  for (const auto& column : columns_) width_ += column.cells;
  cells_.resize(width_ * scans_);
}

bool ScanTrace::begins(const Memory& memory) {
  using enum idl::plc::TraceCondition;
  if (condition_.kind == AT_ONCE) return true;
  std::uint64_t value = 0;
  copy_value(memory, condition_.place, std::span(&value, 1));
  const auto before = last_;
  last_ = value;
  switch (condition_.kind) {
    case EQUAL:
      return is_equal(condition_.value_kind, value, condition_.value);
    case NOT_EQUAL:
      return !is_equal(condition_.value_kind, value, condition_.value);
    case LESS:
      return is_less(condition_.value_kind, value, condition_.value);
    case GREATER:
      return is_less(condition_.value_kind, condition_.value, value);
    default:
      return before && *before != value;
  }
}

void ScanTrace::after_scan(const Memory& memory) {
  if (complete()) return;
  started_ = started_ || begins(memory);
  if (!started_) return;
  auto to = std::span(cells_).subspan(rows_ * width_, width_);
  to[0] = memory.scans, to[1] = memory.tick;
  to = to.subspan(trace_time_cells);
  for (const auto& column : columns_) {
    copy_value(memory, column, to);
    to = to.subspan(column.cells);
  }
  ++rows_;
}

}  // namespace trunnion::plc

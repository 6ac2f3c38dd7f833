// SPDX-License-Identifier: Apache-2.0
// What the words of canned cycles mean on Haas mills.
#include <cmath>
#include <cstdio>

#include "language/drilling_cycles.hpp"

namespace trunnion::language {
namespace {

constexpr double smallest_peck_of_haas = 0.001;  // mm
constexpr double highest_multiple = 9;

}  // namespace

// I J K of a pattern in the same block are those of the pattern.
Fault DrillingCycles::read_haas_words(CycleWords& words) {
  const std::uint8_t cycle = state_.modal.cycle;
  const bool pecks = cycle == 73 || cycle == 83;
  const bool taps = cycle == 74 || cycle == 84;
  if (words_.g().has(Group::one_block)) return {};
  if (pecks) return read_haas_pecks(words);
  if (!taps || !words_.has('J')) return {};
  words_.use('J');
  words.retract_multiple = words_.value('J');
  const bool good = words.retract_multiple >= 1 && words.retract_multiple <= highest_multiple;
  return good ? Fault{} : Fault{AlarmNumber::value_range, words_.offset('J'), "the multiple is 1 to 9"};
}

// With Q, K of G73 is the depth behind which the tool goes out to R. Without Q, I is the first peck, J what
// each is smaller than the one before, and K the least.
Fault DrillingCycles::read_haas_pecks(CycleWords& words) {
  HoleParameters& hole = words.hole;
  if (words_.has('Q')) {
    hole.reduction = hole.least_peck = hole.between_outs = 0;
    if (words_.has('K')) hole.between_outs = std::abs(words_.length('K'));
    return {};
  }
  if (!words_.has('I')) return {};
  hole.between_outs = 0;
  hole.peck = std::abs(words_.length('I'));
  hole.reduction = std::abs(words_.length('J'));
  hole.least_peck = std::abs(words_.length('K'));
  const double least = hole.reduction > 0 ? hole.least_peck : hole.peck;
  return least < smallest_peck_of_haas ? Fault{AlarmNumber::cycle_peck_missing, words_.offset('I')} : Fault{};
}

double DrillingCycles::retract_speed() const {
  const double multiple = state_.settings().cycle.retract_multiple;
  return multiple > 1 ? multiple * state_.modal.spindle_speed : 0;
}

Fault DrillingCycles::check_retract() {
  const bool taps = state_.modal.cycle == 74 || state_.modal.cycle == 84;
  const double highest = environment_.highest_spindle_speed();
  if (!taps || highest == 0 || retract_speed() <= highest) return {};
  FaultDetail& detail = context_.detail;
  detail.number = AlarmNumber::spindle_speed_above;
  std::snprintf(detail.text.data(), detail.text.size(), "S times J %.6g, at most %.6g 1/min (%s)",
                retract_speed(), highest, environment_.highest_speed_parameter());
  return {detail.number, words_.has('J') ? words_.offset('J') : words_.first_offset()};
}

}  // namespace trunnion::language

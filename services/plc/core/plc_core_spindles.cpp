// SPDX-License-Identifier: Apache-2.0
// The spindles: what the drive says of them into the image, and what the programs order out of it.
#include <algorithm>
#include <cmath>

#include "canonical/spindle_value.hpp"
#include "plc_core.hpp"

namespace trunnion::plc {
namespace {

using idl::stream::SpindleCondition;

constexpr double slowest_tolerance = 5;           // 1/min, for low speeds and standstill
constexpr std::uint64_t spindle_timeout = 30000;  // ms for which virtual time continues for a spindle
constexpr std::uint64_t coupling_delay = 100;  // ms in which the drive has taken another coupling or radius
constexpr std::size_t most_couplings = 7;      // idl/plc.idl
constexpr std::int32_t whole_turn = 36000;     // 0.01 deg

}  // namespace

std::int32_t hundredths(double degrees) {
  const auto value = std::llround(std::clamp(degrees, -360.0, 360.0) * 100) % whole_turn;
  return static_cast<std::int32_t>(value < 0 ? value + whole_turn : value);
}

SpindleOrder spindle_order(std::uint32_t code, double value) {
  constexpr std::int32_t master = 1, integral = 2, angle = 3;
  constexpr std::int32_t none = 0, active = 1, frozen = 2;
  if (code == canonical::order_angle) return {angle, 0, hundredths(value)};
  if (code >= canonical::order_master && code - canonical::order_master < canonical::most_spindles) {
    const double number = std::clamp(value - canonical::master_address + 1, 0.0, double{spindle_count});
    return {master, static_cast<std::int32_t>(code - canonical::order_master + 1),
            static_cast<std::int32_t>(std::lround(number))};
  }
  if (code >= canonical::order_integral && code - canonical::order_integral < canonical::most_spindles)
    return {integral, static_cast<std::int32_t>(code - canonical::order_integral + 1),
            value > 0   ? active
            : value < 0 ? frozen
                        : none};
  return {};
}

void PlcCore::find_spindles() {
  for (std::size_t s = 0; s < spindle_count; ++s) {
    const auto of = [s](const char* text) { return interface_address(text, s); };
    spindle_symbols_[s] = {
        of("spindle_at_speed"),       of("spindle_actual"),          of("spindle_oriented"),
        of("spindle_homed"),          of("spindle_synchronized"),    of("spindle_position"),
        of("spindle_speed"),          of("spindle_enable"),          of("spindle_counterclockwise"),
        of("spindle_orient"),         of("spindle_orient_by_angle"), of("spindle_orient_angle"),
        of("spindle_gear"),           of("spindle_master"),          of("spindle_master_angle"),
        of("spindle_reverse"),        of("spindle_integral"),        of("spindle_surface_speed"),
        of("spindle_surface_channel")};
  }
}

// An orientation of before may be reported until the drive has the new outputs. So the drive gives up the
// angle of before first, and what it reports of a coupling counts once it has said that it has another one.
void PlcCore::take_spindles(const idl::stream::Feedback& feedback) {
  const auto received = std::min(spindle_count, feedback.spindle_speed.size());
  view_.spindles_received = static_cast<std::uint32_t>(received);
  std::copy_n(feedback.spindle_speed.begin(), received, view_.spindle_actual.begin());
  for (std::size_t s = 0; s < spindle_count; ++s) {
    auto& spindle = view_.spindles[s];
    const auto* state = s < feedback.spindles.size() ? &feedback.spindles[s] : nullptr;
    const bool oriented = s < feedback.spindle_oriented.size() && feedback.spindle_oriented[s] != 0;
    const bool orients =
        oriented || (state != nullptr && (state->condition == SpindleCondition::SPINDLE_POSITIONING ||
                                          state->condition == SpindleCondition::SPINDLE_ORIENTED));
    spindle.releases = spindle.releases && orients;
    view_.oriented[s] = oriented && !spindle.releases;
    const bool synchronized = state != nullptr &&
                              state->condition == SpindleCondition::SPINDLE_SYNCHRONIZED &&
                              state->master + 1 == spindle.master;
    spindle.new_angle =
        spindle.new_angle && synchronized && memory_.scans - spindle.coupling_since < coupling_delay;
    spindle.synchronized = synchronized && !spindle.new_angle;
    const bool reached = state != nullptr && state->condition == SpindleCondition::SPINDLE_AT_SPEED;
    spindle.new_surface =
        spindle.new_surface && reached && memory_.scans - memory_.spindle_since[s] < coupling_delay;
    spindle.surface_reached = spindle.surface.speed != 0 && reached && !spindle.new_surface;
    spindle.homed = state != nullptr && state->homed;
    if (s >= std::min(spindles_, received)) continue;
    const auto& symbols = spindle_symbols_[s];
    input(symbols.actual, std::llround(std::abs(view_.spindle_actual[s])));
    input(symbols.homed, spindle.homed);
    // Of a turning spindle it is always another one: it waits for the next run of a task.
    if (state != nullptr)
      store(memory_.registers, symbols.position, hundredths((state->angle - std::floor(state->angle)) * 360));
  }
}

// The outputs order the same as before, and what the drive holds by them is no new order. What it has said of
// them is in the inputs.
void PlcCore::restore_spindles() {
  const auto& r = memory_.registers;
  for (std::size_t s = 0; s < spindle_count; ++s) {
    auto& spindle = view_.spindles[s];
    const auto& symbols = spindle_symbols_[s];
    spindle = {};
    spindle.orientation = ordered_orientation(s);
    const bool orients = plc::load(r, symbols.orient) != 0 && !emergency_stop();
    view_.orients[s] = orients;
    view_.oriented[s] = orients && plc::load(r, symbols.oriented) != 0;
    view_.orient_since[s] = orients ? memory_.scans : 0;
    if (const auto master = ordered_master(s); master != 0) {
      spindle.master = master;
      spindle.reverse = plc::load(r, symbols.reverse) != 0;
      spindle.coupling_angle = plc::load(r, symbols.master_angle);
      spindle.coupling_since = memory_.scans;
      spindle.synchronized = plc::load(r, symbols.synchronized) != 0;
      spindle.new_angle = !spindle.synchronized;
    }
    const bool on = plc::load(r, symbols.enable) != 0 && !orients && !emergency_stop();
    if (on) spindle.surface = ordered_surface_speed(s);
    if (spindle.surface.speed == 0) continue;
    spindle.surface_reached = plc::load(r, symbols.at_speed) != 0;
    spindle.new_surface = !spindle.surface_reached;
  }
}

std::int32_t PlcCore::ordered_orientation(std::size_t s) const {
  const auto& symbols = spindle_symbols_[s];
  const auto angle = plc::load(memory_.registers, symbols.orient_angle);
  if (plc::load(memory_.registers, symbols.orient_by_angle) == 0 || angle == no_angle) return -1;
  return angle % whole_turn;
}

// 0 also when the register names no other spindle.
std::uint8_t PlcCore::ordered_master(std::size_t s) const {
  const auto number = plc::load(memory_.registers, spindle_symbols_[s].master);
  const auto master = static_cast<std::size_t>(number);
  if (s >= spindles_ || number < 1 || master > spindles_ || master == s + 1) return 0;
  return static_cast<std::uint8_t>(number);
}

bool PlcCore::follows(std::size_t s) const { return view_.spindles[s].master != 0; }

// 1/min: what the drive makes of the command, within 10a948. A master turns no faster than its slaves may.
double PlcCore::reachable_speed(std::size_t s) const {
  double speed = memory_.spindle_command[s];
  const auto limit = [&](double highest) {
    if (highest > 0) speed = std::clamp(speed, -highest, highest);
  };
  limit(highest_speed_[s]);
  for (std::size_t k = 0; k < spindles_; ++k) {
    const auto& slave = view_.spindles[k];
    if (!slave.synchronized || std::size_t{slave.master} != s + 1) continue;
    limit(highest_speed_[k]);
    const auto gear = plc::load(memory_.registers, spindle_symbols_[k].gear);
    if (gear >= 1 && static_cast<std::size_t>(gear) <= gear_count)
      limit(gear_speeds_[k][static_cast<std::size_t>(gear) - 1]);
  }
  return speed;
}

bool PlcCore::at_speed(std::size_t s) const {
  if (s >= spindles_) return true;
  if (s >= view_.spindles_received) return view_.drive_seen;
  if (follows(s)) return view_.spindles[s].synchronized;
  if (view_.spindles[s].surface.speed != 0) return view_.spindles[s].surface_reached;
  const double command = reachable_speed(s);
  return std::abs(view_.spindle_actual[s] - command) <=
         std::max(speed_window_[s] * std::abs(command), slowest_tolerance);
}

bool PlcCore::check_orientation(std::size_t s) {
  auto& spindle = view_.spindles[s];
  const bool orients = plc::load(memory_.registers, spindle_symbols_[s].orient) != 0 && !emergency_stop();
  if (orients) {
    const auto angle = ordered_orientation(s);
    const bool another = angle != spindle.orientation;
    if (!view_.orients[s] || another) view_.orient_since[s] = memory_.scans, view_.oriented[s] = false;
    spindle.releases = spindle.releases || another;
    spindle.orientation = angle;
  }
  view_.orients[s] = orients;
  return orients;
}

void PlcCore::check_coupling(std::size_t s) {
  auto& spindle = view_.spindles[s];
  const auto& symbols = spindle_symbols_[s];
  const auto master = ordered_master(s);
  if (master == 0) {
    spindle.master = 0;
    spindle.synchronized = spindle.new_angle = false;
    return;
  }
  const bool reverse = plc::load(memory_.registers, symbols.reverse) != 0;
  const auto angle = plc::load(memory_.registers, symbols.master_angle);
  if (master == spindle.master && reverse == spindle.reverse && angle == spindle.coupling_angle) return;
  spindle.master = master, spindle.reverse = reverse, spindle.coupling_angle = angle;
  spindle.coupling_since = memory_.scans;
  spindle.new_angle = true;
  spindle.synchronized = false;
}

SurfaceOrder PlcCore::ordered_surface_speed(std::size_t s) const {
  const auto& r = memory_.registers;
  const auto& symbols = spindle_symbols_[s];
  const double speed = plc::load(r, symbols.surface_speed) / 10.0;
  const auto channel = static_cast<std::size_t>(plc::load(r, symbols.surface_channel));
  if (speed == 0 || s >= spindles_ || channel >= channel_count) return {};
  const bool reverse = plc::load(r, symbols.counterclockwise) != 0;
  return {reverse ? -speed : speed, static_cast<double>(plc::load(r, channel_symbols_[channel].s_limit)),
          plc::load(r, channel_symbols_[channel].s_radius) / 10.0, static_cast<std::uint8_t>(channel)};
}

void PlcCore::check_surface_speed(std::size_t s, bool on) {
  auto& spindle = view_.spindles[s];
  const auto order = on ? ordered_surface_speed(s) : SurfaceOrder{};
  if (order == spindle.surface) return;
  spindle.surface = order;
  spindle.new_surface = order.speed != 0;
  spindle.surface_reached = false;
  memory_.spindle_since[s] = memory_.scans;
}

void PlcCore::check_spindles() {
  auto& r = memory_.registers;
  for (std::size_t s = 0; s < spindle_count; ++s) {
    const auto& symbols = spindle_symbols_[s];
    const bool orients = check_orientation(s);
    check_coupling(s);
    const bool on = plc::load(r, symbols.enable) != 0 && !orients && !emergency_stop();
    check_surface_speed(s, on);
    const double speed = on && view_.spindles[s].surface.speed == 0 ? plc::load(r, symbols.speed) : 0;
    const double command = plc::load(r, symbols.counterclockwise) != 0 && speed > 0 ? -speed : speed;
    if (command != memory_.spindle_command[s]) {
      memory_.spindle_command[s] = command;
      memory_.spindle_since[s] = memory_.scans;
    }
    input(symbols.at_speed, at_speed(s));
    input(symbols.oriented, orients && (view_.oriented[s] || s >= spindles_));
    input(symbols.synchronized, view_.spindles[s].synchronized);
  }
}

// A slave follows what its master is ordered.
bool PlcCore::spindle_moves(std::size_t s) const {
  const auto& spindle = view_.spindles[s];
  auto since = memory_.spindle_since[s];
  if (follows(s)) since = std::max(spindle.coupling_since, memory_.spindle_since[spindle.master - 1u]);
  return (!at_speed(s) && memory_.scans - since < spindle_timeout) ||
         (view_.orients[s] && !view_.oriented[s] && memory_.scans - view_.orient_since[s] < spindle_timeout);
}

// What no spindle uses is empty.
void PlcCore::set_spindles(idl::plc::Outputs& outputs) const {
  const auto& r = memory_.registers;
  bool by_angle = false, geared = false;
  for (std::size_t s = 0; s < spindles_; ++s) {
    const auto& spindle = view_.spindles[s];
    outputs.spindle_speed.push_back(outputs.emergency_stop ? 0 : memory_.spindle_command[s]);
    outputs.spindle_orient.push_back(view_.orients[s] && !spindle.releases ? 1 : 0);
    by_angle = by_angle || (view_.orients[s] && spindle.orientation >= 0);
    geared = geared || plc::load(r, spindle_symbols_[s].gear) != 0;
  }
  for (std::size_t s = 0; s < spindles_; ++s) {
    const auto& spindle = view_.spindles[s];
    const auto& symbols = spindle_symbols_[s];
    if (by_angle)
      outputs.spindle_angle.push_back(
          view_.orients[s] && spindle.orientation >= 0 ? spindle.orientation / 100.0 : -1.0);
    if (geared)
      outputs.spindle_gear.push_back(static_cast<std::uint8_t>(std::min(plc::load(r, symbols.gear), 255)));
    if (spindle.surface.speed != 0 && !outputs.emergency_stop) {
      idl::plc::SurfaceSpeed surface;
      surface.spindle = static_cast<std::uint8_t>(s);
      surface.channel = spindle.surface.channel;
      surface.speed = spindle.surface.speed;
      surface.limit = spindle.surface.limit;
      surface.radius = spindle.surface.radius;
      outputs.surface_speeds.push_back(surface);
    }
    if (!follows(s) || outputs.spindle_couplings.size() == most_couplings) continue;
    using idl::plc::IntegralAction;
    const auto integral = plc::load(r, symbols.integral);
    idl::plc::SpindleCoupling coupling;
    coupling.slave = static_cast<std::uint8_t>(s);
    coupling.master = static_cast<std::uint8_t>(spindle.master - 1);
    coupling.reverse = spindle.reverse;
    coupling.angle = spindle.coupling_angle / 100.0;
    coupling.integral = integral == 1   ? IntegralAction::INTEGRAL_ACTIVE
                        : integral == 2 ? IntegralAction::INTEGRAL_FROZEN
                                        : IntegralAction::INTEGRAL_NONE;
    outputs.spindle_couplings.push_back(coupling);
  }
}

}  // namespace trunnion::plc

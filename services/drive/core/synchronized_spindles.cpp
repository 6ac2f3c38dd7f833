// SPDX-License-Identifier: Apache-2.0
#include "synchronized_spindles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "machine/alarm_constants.hpp"
#include "timeouts.hpp"

namespace trunnion::drive {
namespace {

constexpr std::size_t most_numbered_spindles = 8;  // that the PLC can name
constexpr double rest_speed = 5;                   // 1/min, at most, as SPINDLE_STOPPED has it

std::string name_of(std::size_t spindle, const std::vector<machine::AxisInfo>& spindles) {
  return spindle < spindles.size() ? "Spindle " + spindles[spindle].name
                                   : "Spindle " + std::to_string(spindle + 1);
}

std::uint32_t part_of(std::size_t spindle, const std::vector<machine::AxisInfo>& spindles) {
  return spindle < spindles.size() ? spindles[spindle].number : 0;
}

}  // namespace

DriveEvent event_of(const SynchronizationFinding& finding, const std::vector<machine::AxisInfo>& spindles) {
  const std::string slave = name_of(finding.slave, spindles), master = name_of(finding.master, spindles);
  const std::string cause = name_of(finding.cause, spindles);
  const std::string refused = slave + " is not synchronized with " + master + ": ";
  const std::string again = "; withdraw the request, then give it again";
  DriveEvent event{&alarm::synchronization_lost, part_of(finding.slave, spindles), ""};
  switch (finding.problem) {
    case SynchronizationProblem::none:
      break;
    case SynchronizationProblem::slave_missing:
    case SynchronizationProblem::master_missing:
      event.text = refused + cause + " does not exist; correct the PLC program";
      break;
    case SynchronizationProblem::own_master:
      event.text = refused + "a spindle cannot follow itself; correct the PLC program";
      break;
    case SynchronizationProblem::chain:
      event.text = refused + cause + " would be master and slave; name the same master for all slaves";
      break;
    case SynchronizationProblem::not_homed:
      event.alarm = &alarm::spindle_not_homed;
      event.part = part_of(finding.cause, spindles);
      event.text = refused + cause + " has not passed its index mark since the start; ";
      event.text += finding.kept_at_rest ? "both are kept at rest: open a chuck, withdraw the request, turn "
                                           "it, then give the request again"
                                         : "turn it" + again;
      break;
    case SynchronizationProblem::no_acceleration:
      event.text = refused + "the acceleration of " + cause + " cannot be computed (alarm 182)" + again;
      break;
    case SynchronizationProblem::follows_path:
      event.text = refused + cause + " follows the path (tapping)" + again;
      break;
    case SynchronizationProblem::lost: {
      char error[32];
      std::snprintf(error, sizeof error, "%.1f deg", finding.error * 360);
      event.text = slave + " is " + error + " from its angle to " + master +
                   ": stop both and look for slip, overload or a wrong gain";
      break;
    }
    case SynchronizationProblem::separated: {
      char speeds[2][32];
      std::snprintf(speeds[0], sizeof speeds[0], "%.0f 1/min", finding.speed);
      std::snprintf(speeds[1], sizeof speeds[1], "%.0f 1/min", finding.master_speed);
      event.text = slave + " turned at " + speeds[0] + " and its master " + master + " at " + speeds[1] +
                   " when their drives went off, and each ran down by itself: open a chuck and check the "
                   "part that both have held";
      break;
    }
  }
  return event;
}

void SynchronizedSpindles::configure(const machine::Parameters& parameters,
                                     const std::vector<machine::AxisInfo>& spindles, double period) {
  count_ = spindles.size();
  period_ = period;
  given_.resize(count_);
  ramps_.resize(count_);
  slaves_.resize(std::max(count_, most_numbered_spindles));
  masters_.resize(count_);
  findings_.reserve(2 * slaves_.size());
  for (std::size_t i = 0; i < count_; ++i) {
    const auto settings = synchronization_settings(parameters, spindles[i].number);
    given_[i] = settings.ramp;
    slaves_[i].control.configure(settings, period);
  }
  take_ramps();
}

bool SynchronizedSpindles::in_closed(std::size_t spindle) const {
  return slaves_[spindle].control.closed() ||
         std::any_of(slaves_.begin(), slaves_.end(),
                     [&](const auto& slave) { return slave.control.closed() && slave.master() == spindle; });
}

// Spindles that a part may hold keep the ramp by which they can come to rest together.
void SynchronizedSpindles::take_ramps() {
  for (std::size_t i = 0; i < count_; ++i)
    if (acceleration_at(given_[i], 0) > 0 || !in_closed(i)) ramps_[i] = given_[i];
}

void SynchronizedSpindles::couple(const std::vector<idl::plc::SpindleCoupling>& couplings) {
  for (std::size_t i = 0; i < slaves_.size(); ++i) {
    auto& slave = slaves_[i];
    const auto found = std::find_if(couplings.begin(), couplings.end(),
                                    [&](const auto& coupling) { return coupling.slave == i; });
    slave.requested = found != couplings.end();
    slave.request = slave.requested ? *found : idl::plc::SpindleCoupling{};
    slave.deferred = keeps(slave);
    if (!slave.deferred) take(slave);
  }
  if (!any()) forget_masters();
}

bool SynchronizedSpindles::ends(const Slave& slave) {
  return !slave.requested || slave.request.master != slave.order.master ||
         slave.request.reverse != slave.order.reverse;
}

void SynchronizedSpindles::take(Slave& slave) {
  slave.deferred = false;
  if (!slave.ordered || ends(slave)) {
    slave.control.end();
    slave.refused = slave.waits = false;
  }
  slave.ordered = slave.requested;
  slave.order = slave.request;
}

void SynchronizedSpindles::forget_masters() { std::fill(masters_.begin(), masters_.end(), Master{}); }

void SynchronizedSpindles::await_rest() {
  for (auto& slave : slaves_) {
    if (slave.deferred) take(slave);
    slave.refused = false;
    slave.waits = slave.ordered && !slave.control.active();
  }
  if (!any()) forget_masters();
}

bool SynchronizedSpindles::waits(std::size_t spindle) const {
  for (std::size_t i = 0; i < slaves_.size(); ++i)
    if (slaves_[i].waits && (i == spindle || slaves_[i].master() == spindle)) return true;
  return false;
}

bool SynchronizedSpindles::at_rest(std::size_t slave, const std::vector<SpindleStatus>& status) const {
  return std::abs(status[slave].speed) <= rest_speed &&
         std::abs(status[slaves_[slave].master()].speed) <= rest_speed;
}

bool SynchronizedSpindles::ramps() const {
  return std::any_of(slaves_.begin(), slaves_.end(), [&](const auto& slave) {
    return slave.control.closed() && masters_[slave.master()].reference != 0;
  });
}

bool SynchronizedSpindles::must_run_down(const std::vector<SpindleStatus>& status) const {
  if (settling_ * period_ >= spindle_rest_timeout) return false;
  if (ramps()) return true;
  for (std::size_t i = 0; i < count_; ++i)
    if (slaves_[i].control.closed() && !at_rest(i, status)) return true;
  return false;
}

bool SynchronizedSpindles::any() const {
  return std::any_of(slaves_.begin(), slaves_.end(), [](const auto& slave) { return slave.ordered; });
}

bool SynchronizedSpindles::follows(std::size_t spindle) const {
  return spindle < slaves_.size() && slaves_[spindle].control.active();
}

bool SynchronizedSpindles::leads(std::size_t spindle) const {
  return std::any_of(slaves_.begin(), slaves_.end(),
                     [&](const auto& slave) { return slave.control.active() && slave.master() == spindle; });
}

// Whether the request makes sense is asked as it begins; a path may come at any time, and other parameters
// before the loop is closed.
SynchronizationFinding SynchronizedSpindles::obstacle(std::size_t slave,
                                                      const std::vector<SpindleCoupling>& streams,
                                                      const std::vector<SpindleStatus>& status) const {
  using Problem = SynchronizationProblem;
  const std::size_t master = slaves_[slave].master();
  const auto because = [&](Problem problem, std::size_t cause) {
    return SynchronizationFinding{problem, slave, master, cause, 0};
  };
  if (slave >= count_) return because(Problem::slave_missing, slave);
  if (master >= count_) return because(Problem::master_missing, master);
  if (master == slave) return because(Problem::own_master, slave);
  for (const std::size_t spindle : {slave, master})
    if (streams[spindle].setpoint().coupled) return because(Problem::follows_path, spindle);
  for (const std::size_t spindle : {slave, master})
    if (!slaves_[slave].control.closed() && acceleration_at(given_[spindle], 0) <= 0)
      return because(Problem::no_acceleration, spindle);
  if (slaves_[slave].control.active()) return {};
  const auto& above = slaves_[master];
  if (above.ordered && (!above.refused || above.master() == slave)) return because(Problem::chain, master);
  if (leads(slave)) return because(Problem::chain, slave);
  for (const std::size_t spindle : {slave, master})
    if (!status[spindle].homed) return because(Problem::not_homed, spindle);
  return {};
}

void SynchronizedSpindles::judge(const std::vector<SpindleCoupling>& streams,
                                 const std::vector<SpindleStatus>& status, bool controlled,
                                 bool running_down) {
  findings_.clear();
  settling_ = running_down && !ramps() ? settling_ + 1 : 0;
  take_ramps();
  if (!any()) return;
  for (std::size_t i = 0; i < slaves_.size(); ++i) {
    auto& slave = slaves_[i];
    if (slave.deferred && (!keeps(slave) || (!run_down_ && at_rest(i, status)))) take(slave);
    if (!slave.ordered || slave.refused) continue;
    if (running_down ? !slave.control.closed() : !controlled) {
      if (slave.control.closed() && !at_rest(i, status))
        findings_.push_back({SynchronizationProblem::separated, i, slave.master(), i, 0, status[i].speed,
                             status[slave.master()].speed});
      slave.control.end();
      continue;
    }
    auto finding = obstacle(i, streams, status);
    if (finding.problem != SynchronizationProblem::none) {
      slave.control.end();
      slave.refused = true;
      // A part may hold both since the drive was restarted. Of other requests nothing was ever in force.
      slave.waits = slave.waits && finding.problem == SynchronizationProblem::not_homed;
      finding.kept_at_rest = slave.waits;
      findings_.push_back(finding);
    } else if (!slave.control.active() && (!slave.waits || at_rest(i, status))) {
      slave.waits = false;
      slave.control.begin(status[i].speed);
    }
  }
  if (!any()) forget_masters();
}

double SynchronizedSpindles::lowest_acceleration(std::size_t spindle, double speed) const {
  double lowest = acceleration_at(ramps_[spindle], speed);
  for (std::size_t i = 0; i < count_; ++i)
    if (slaves_[i].control.active() && slaves_[i].master() == spindle)
      lowest = std::min(lowest, acceleration_at(ramps_[i], speed));
  return lowest;
}

// One of its slaves waits for rest to be taken from it.
bool SynchronizedSpindles::must_rest(std::size_t master) const {
  return run_down_ || std::any_of(slaves_.begin(), slaves_.end(), [&](const auto& slave) {
           return slave.deferred && slave.control.active() && slave.master() == master;
         });
}

// 1/min in a period: 6 deg/s are 1 1/min.
double SynchronizedSpindles::change(std::size_t master, double speed) const {
  return lowest_acceleration(master, speed) / 6 * period_;
}

void SynchronizedSpindles::step_master(std::size_t spindle, const SpindleStatus& status,
                                       SpindleSetpoint& out) {
  auto& master = masters_[spindle];
  if (!leads(spindle)) {
    master = {};
    return;
  }
  if (out.coupled) {  // turns to its orientation angle
    master.reference = (out.angle - (master.positioned ? master.angle : status.angle)) / period_ * 60;
    master.angle = out.angle;
    master.positioned = master.active = true;
    return;
  }
  if (!master.active) {  // a speed that is almost the ordered one is left alone
    const bool near = std::abs(status.speed - out.speed) <= std::max(5.0, 0.05 * std::abs(out.speed));
    master.reference = near ? out.speed : status.speed;
  }
  master.active = true;
  master.positioned = false;
  const double demand = must_rest(spindle) ? 0 : out.speed;
  const double direction = demand < master.reference ? -1 : 1;
  // The midpoint, as SpindleRamp.
  const double most = change(spindle, master.reference + direction * change(spindle, master.reference) / 2);
  if (std::abs(demand - master.reference) <= most)
    master.reference = demand;
  else
    master.reference += direction * most;
  out.speed = master.reference;
}

void SynchronizedSpindles::step(const std::vector<SpindleStatus>& status, const std::vector<double>& highest,
                                std::vector<SpindleSetpoint>& out) {
  if (!any()) return;
  for (std::size_t i = 0; i < count_; ++i) step_master(i, status[i], out[i]);
  for (std::size_t i = 0; i < count_; ++i) {
    auto& slave = slaves_[i];
    if (!slave.control.active()) continue;
    const std::size_t master = slave.master();
    const SynchronizationOrder order{slave.order.reverse, slave.order.angle / 360, slave.order.integral,
                                     highest[i]};
    const MasterMotion motion{masters_[master].reference, status[master].speed, status[master].angle};
    slave.control.use_ramp(ramps_[i]);
    out[i].speed = slave.control.step(order, motion, status[i]);
    out[i].coupled = false;
    if (slave.control.take_lost())
      findings_.push_back({SynchronizationProblem::lost, i, master, i, slave.control.error()});
  }
}

void SynchronizedSpindles::fill(idl::stream::SpindleState& out, std::size_t spindle) const {
  out.master = -1;
  out.synchronization_error = out.correction = 0;
  if (!follows(spindle)) return;
  const auto& slave = slaves_[spindle];
  out.condition = slave.control.synchronized() ? idl::stream::SpindleCondition::SPINDLE_SYNCHRONIZED
                                               : idl::stream::SpindleCondition::SPINDLE_SYNCHRONIZING;
  out.reference = slave.control.reference();
  out.master = static_cast<std::int8_t>(slave.master());
  out.synchronization_error = slave.control.error();
  out.correction = slave.control.correction();
}

}  // namespace trunnion::drive

// SPDX-License-Identifier: Apache-2.0
#include "hal_hardware.hpp"
#include "machine/parameter_constants.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <thread>

namespace trunnion::drive {
namespace {

constexpr auto silence_timeout = std::chrono::seconds(1);  // without a sample: the servo thread does not run
// Rows without `enable` at first: HAL's watchdog, which tripped when the process before this one died, is
// armed again by them.
constexpr std::uint64_t rows_before_enable = 20;
constexpr std::uint32_t number_gap = 1u << 16;  // between the row numbers of two processes

}  // namespace

HalHardware::HalHardware(const HalSession::Options& session, std::uint32_t queue,
                         const std::string& state_directory)
    : session_(session),
      queue_(queue),
      file_(state_directory + "/references.bin", "references", sizeof(Memory)) {}

void HalHardware::end() {
  streams_.reset();
  session_.end();
}

void HalHardware::configure(const machine::Parameters& p, const std::vector<machine::AxisInfo>& axes,
                            const std::vector<machine::AxisInfo>& spindles, double period) {
  const bool first = streams_ == nullptr;
  period_ = period;
  if (first) {
    axes_.resize(axes.size());
    position_.resize(axes.size());
    spindles_.resize(spindles.size());
    angle_.resize(spindles.size());
  }
  for (std::size_t i = 0; i < axes.size(); ++i)
    axes_[i].needs_homing = p.integer(parameter::homing_direction, axes[i].number) != 0;
  if (first) attach();
  for (std::size_t i = 0; i < axes.size(); ++i)
    axes_[i].status.homed = !axes_[i].needs_homing || memory_.homed[i] != 0;
}

void HalHardware::attach() {
  streams_ = std::make_unique<HalStreams>();
  setpoint_columns_ = SetpointColumns::from(streams_->setpoint_types(), axes_.size(), spindles_.size());
  sample_columns_ = SampleColumns::from(streams_->encoder_types(), streams_->switch_types(), axes_.size(),
                                        spindles_.size());
  take_references();
  check_period();
  first_sample();
}

// A servo thread with another period than the interpolation cycle would move everything at another speed.
// HAL's counter of periods makes up for delays, so a fifth of a second tells a factor of 1.5.
void HalHardware::check_period() {
  using clock = std::chrono::steady_clock;
  const auto until = clock::now() + silence_timeout;
  std::optional<unsigned> first;
  int batches = 0;
  auto began = clock::now();
  for (;;) {
    bool any = false;
    while (streams_->read(sample_)) any = true;
    // At first comes what has waited in the FIFO, which is as old as HAL when it was full.
    if (any && ++batches == 2) {
      first = sample_.period;
      began = clock::now();
    }
    const double elapsed = std::chrono::duration<double>(clock::now() - began).count();
    if (first && elapsed > 0.2) {
      const double found = elapsed / std::max(1u, sample_.period - *first);
      if (found < 1.5 * period_ && found > period_ / 1.5) return;
      char text[160];
      std::snprintf(
          text, sizeof text,
          "HAL's servo thread has a period of about %.1f ms, parameter 000001 is %.2f ms: make them equal",
          found * 1000, period_ * 1000);
      throw std::runtime_error(text);
    }
    if (!first && clock::now() > until)
      throw std::runtime_error(
          "HAL's servo thread gives no samples: does the .hal file add the samplers to it?");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// Those of another session are void: its encoders began to count elsewhere. Those of damaged files are not
// used: the axes have no reference then.
void HalHardware::take_references() {
  const auto kept = file_.load();
  if (kept.state == storage::KeptState::good) std::memcpy(&memory_, kept.content.data(), sizeof memory_);
  std::array<char, 32> session{};
  session_.identity().copy(session.data(), session.size() - 1);
  if (memory_.session != session || memory_.axes != axes_.size()) memory_ = {};
  memory_.session = session;
  memory_.axes = static_cast<std::uint32_t>(axes_.size());
  file_.open({reinterpret_cast<const std::uint8_t*>(&memory_), sizeof memory_});
}

// Where the axes are, and behind which number the rows of this process come.
void HalHardware::first_sample() {
  const auto until = std::chrono::steady_clock::now() + silence_timeout;
  bool any = false;
  // What the process before this one has left in the FIFO comes into force first.
  while (!any || streams_->queued() > 0) {
    while (streams_->read(sample_)) any = true;
    if (std::chrono::steady_clock::now() > until)
      throw std::runtime_error(
          "HAL's servo thread gives no samples: does the .hal file add streamer and samplers?");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  first_number_ = sample_.encoders[SampleColumns::number].u + number_gap;
  last_period_ = sample_.period;
  take(sample_);
  sampled_ = std::chrono::steady_clock::now();
}

std::uint64_t HalHardware::number_of(std::uint32_t in_hal) const {
  // HAL counts in 32 bits; the row is one of the newest that were handed over.
  const auto behind =
      static_cast<std::uint32_t>(first_number_ + static_cast<std::uint32_t>(newest_)) - in_hal;
  return behind < newest_ ? newest_ - behind : 0;
}

void HalHardware::take(const HalSample& sample) {
  const auto& c = sample_columns_;
  in_force_ = number_of(sample.encoders[SampleColumns::number].u);
  const double elapsed = std::max(1u, sample.period - last_period_) * period_;
  last_period_ = sample.period;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    auto& axis = axes_[i];
    auto& status = axis.status;
    const auto* column = &sample.encoders[SampleColumns::first_axis + i * c.per_axis];
    const auto* bits = &sample.switches[3 * i];
    const double position = column[0].f + shift(i);
    status.velocity = c.per_axis > 1 ? column[1].f : (position - status.position) / elapsed;
    status.torque = c.per_axis > 2 ? column[2].f : 0;
    status.position = position_[i] = position;
    // The row before is the one whose period has just ended.
    const bool followed = controlled_ && in_force_ > 1 && axis.status.enabled;
    status.following_error = followed ? axis.setpoint[(in_force_ - 1) % kept_rows] - position : 0;
    status.enabled = bits[0].b;
    status.fault = bits[1].b;
    if (bits[2].b && !status.home_switch) status.home_latch = position;
    status.home_switch = bits[2].b;
  }
  for (std::size_t i = 0; i < spindles_.size(); ++i) {
    const auto* column = &sample.encoders[c.first_spindle + 2 * i];
    spindles_[i] = {column[1].f, column[0].f};
    angle_[i] = spindles_[i].angle;
  }
}

void HalHardware::report_skip_edges(const HalSample& sample, EncoderRowSink& rows) {
  const auto& c = sample_columns_;
  for (std::size_t k = 0; k < c.skip_inputs; ++k) {
    const bool on = sample.switches[c.first_skip_input + k].b;
    if (on && !skip_inputs_[k] && in_force_ > 0)
      rows.skip_edge(in_force_, {static_cast<std::uint8_t>(k + 1), 0, position_});
    skip_inputs_[k] = on;
  }
}

void HalHardware::write(const SetpointRow& row) {
  const auto& c = setpoint_columns_;
  newest_ = row.number;
  controlled_ = row.controls_spindles();  // the drives are on: axes are held at the newest setpoint
  const bool enable = row.enable && row.number > rows_before_enable;
  if (!enable)
    enabled_from_ = 0;
  else if (enabled_from_ == 0)
    enabled_from_ = row.number;
  row_[SetpointColumns::number].u = first_number_ + static_cast<std::uint32_t>(row.number);
  row_[SetpointColumns::enable].b = enable;
  row_[SetpointColumns::fault_reset].b = fault_reset_rows_ > 0;
  if (fault_reset_rows_ > 0) --fault_reset_rows_;
  row_[SetpointColumns::heartbeat].b = row.number % 2 != 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    auto* column = &row_[SetpointColumns::first_axis + i * c.per_axis];
    // An axis that is not controlled keeps its place when its drive is switched on.
    const double position = row.controlled || enable ? row.axes[i].position : axes_[i].status.position;
    axes_[i].setpoint[row.number % kept_rows] = position;
    axes_[i].status.hold_position = position;
    column[0].f = position - shift(i);
    if (c.per_axis > 1) column[1].f = row.axes[i].velocity;
    if (c.per_axis > 2) column[2].f = row.axes[i].acceleration;
  }
  for (std::size_t i = 0; i < spindles_.size(); ++i) {
    auto* column = &row_[c.first_spindle + 3 * i];
    const auto& spindle = row.spindles[i];
    column[0].f = row.controls_spindles() ? spindle.speed : 0;
    column[1].b = row.controls_spindles() && spindle.coupled;
    column[2].f = spindle.coupled ? spindle.angle : spindles_[i].angle;
  }
  streams_->write(row_);
}

std::uint64_t HalHardware::read(DriveStatus& out, EncoderRowSink& rows) {
  bool any = false;
  std::uint64_t starved = 0;
  while (streams_->read(sample_)) {
    any = true;
    const auto before = in_force_;
    take(sample_);
    report_skip_edges(sample_, rows);
    if (in_force_ == 0) continue;
    // A period in which the row of the one before is still in force was without a row.
    if (in_force_ == before) ++starved;
    rows.encoder_row({in_force_, position_, angle_});
  }
  if (any) sampled_ = std::chrono::steady_clock::now();
  status(out);
  return starved;
}

void HalHardware::exchange(const SetpointRow& row, DriveStatus& out, EncoderRowSink&) {
  write(row);
  status(out);
}

void HalHardware::status(DriveStatus& out) const {
  out.axes.resize(axes_.size());
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    out.axes[i] = axes_[i].status;
    if (!controlled_ && enabled_from_ == 0) out.axes[i].hold_position = axes_[i].status.position;
  }
  out.spindles = spindles_;
  unsigned on = 0;
  for (std::size_t k = 0; k < sample_columns_.skip_inputs; ++k) on |= skip_inputs_[k] ? 1u << k : 0u;
  out.skip_inputs = static_cast<std::uint8_t>(on);
}

bool HalHardware::enabled() const {
  if (enabled_from_ == 0 || in_force_ < enabled_from_ + 2) return false;
  return std::all_of(axes_.begin(), axes_.end(),
                     [](const Axis& axis) { return axis.status.enabled && !axis.status.fault; });
}

bool HalHardware::period_due() {
  if (const char* what = session_.ended()) give_up(what);
  if (streams_->queued() < queue_) return true;
  if (streams_->readable())
    sampled_ = std::chrono::steady_clock::now();
  else if (std::chrono::steady_clock::now() - sampled_ > silence_timeout)
    give_up("HAL's servo thread has stopped, it has given no sample for 1 s");
  return false;
}

// The next process loads HAL anew, whose encoders begin to count elsewhere.
void HalHardware::give_up(const char* what) {
  end();
  throw std::runtime_error(std::string(what) +
                           ": HAL is loaded again; axes with a home switch must be homed");
}

void HalHardware::set_reference(std::size_t i, double shift_by) {
  memory_.shift[i] += shift_by;
  memory_.homed[i] = 1;
  file_.save({reinterpret_cast<const std::uint8_t*>(&memory_), sizeof memory_});
  auto& axis = axes_[i];
  for (auto& setpoint : axis.setpoint) setpoint += shift_by;
  axis.status.position += shift_by;
  axis.status.hold_position += shift_by;
  axis.status.home_latch += shift_by;
  axis.status.homed = true;
}

}  // namespace trunnion::drive

// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/spindle_sync_evaluation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace trunnion::servo_analysis {
namespace {

constexpr double degrees_of_turn = 360;
constexpr double lost_error = 180;            // deg: alarm 184
constexpr double most_drift = 0.5;            // of the window, in the recording
constexpr double most_growth = 1.5;           // of the oscillation from one half to the other
constexpr double least_oscillation = 0.05;    // of the window: standard deviation; a smaller one may grow
constexpr double least_change = 1;            // 1/min: of the master's reference
constexpr double tolerated_difference = 0.1;  // of the window, of the drive's own error
constexpr double tolerated_override = 0.05;   // of the ordered speed

struct Line {
  double mean = 0, slope = 0;  // slope for each value
};

Line line_through(std::span<const double> values) {
  Line line;
  const auto count = static_cast<double>(values.size());
  for (const double v : values) line.mean += v / count;
  double above = 0, below = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = static_cast<double>(i) - (count - 1) / 2;
    above += x * values[i], below += x * x;
  }
  line.slope = below > 0 ? above / below : 0;
  return line;
}

double standard_deviation(std::span<const double> values) {
  double mean = 0, sum = 0;
  const auto count = static_cast<double>(values.size());
  for (const double v : values) mean += v / count;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / count);
}

double largest_of(std::span<const double> values) {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

// 1/min over `rows` of angles, at their interval.
double measured_speed(const SpindleSyncRecord& record, std::span<const std::size_t> rows,
                      double SpindleAngles::*angle) {
  if (rows.size() < 2) return 0;
  const double turns = record.angles[rows.back()].*angle - record.angles[rows.front()].*angle;
  return turns / (static_cast<double>(rows.size() - 1) * record.interval) * 60;
}

std::size_t cycles_in(double time, double interval) {
  return static_cast<std::size_t>(std::llround(time / interval));
}

// Where the parts of a record are, as indices of its angles.
struct Parts {
  std::size_t coupled = 0;         // angles at which the slave follows
  std::vector<std::size_t> rows;   // cycles since then
  std::size_t begin = 0, end = 0;  // of the recording, in `rows`
  std::span<const std::size_t> recorded() const { return std::span(rows).subspan(begin, end - begin); }
};

Parts parts_of(const SpindleSyncRecord& record, const SpindleSyncSettings& settings) {
  const auto first = std::find_if(record.reports.begin(), record.reports.end(),
                                  [](const auto& report) { return report.follows; });
  if (first == record.reports.end()) throw std::runtime_error("no spindle has followed another one");
  Parts parts;
  parts.coupled = first->at;
  for (std::size_t i = parts.coupled; i < record.angles.size(); ++i)
    if (record.angles[i].cycle) parts.rows.push_back(i);
  parts.begin = cycles_in(settings.settling, record.interval);
  parts.end = parts.begin + std::max<std::size_t>(2, cycles_in(settings.record, record.interval));
  if (parts.rows.size() < parts.end)
    throw std::runtime_error(fmt::format("the drive gave {} cycles of the two spindles, the test needs {}",
                                         parts.rows.size(), parts.end));
  return parts;
}

// The first angles of `from` .. `end` from which the error stays within the window; none when the last of
// them are outside.
std::optional<std::size_t> inside_from(const std::vector<double>& errors, double window, std::size_t from,
                                       std::size_t end) {
  std::size_t inside = from;
  for (std::size_t i = from; i < end; ++i)
    if (std::abs(errors[i]) > window) inside = i + 1;
  if (inside >= end) return {};
  return inside;
}

std::optional<double> growth_of(std::span<const double> values, const Line& line, double window) {
  std::vector<double> rest(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) rest[i] = values[i] - line.slope * static_cast<double>(i);
  const std::size_t half = rest.size() / 2;
  const double before = standard_deviation(std::span(rest).first(half));
  const double after = standard_deviation(std::span(rest).last(half));
  if (after < least_oscillation * window) return {};
  return after / std::max(before, 1e-9);
}

SteadySync steady_of(const SpindleSyncRecord& record, const SpindleSyncSettings& settings, const Parts& parts,
                     const std::vector<double>& errors) {
  const auto rows = parts.recorded();
  std::vector<double> values;
  for (const auto row : rows) values.push_back(errors[row]);
  const Line line = line_through(values);
  SteadySync out;
  out.master_speed = measured_speed(record, rows, &SpindleAngles::master);
  out.mean = line.mean;
  out.deviation = standard_deviation(values);
  out.peak = largest_of(values);
  out.drift = line.slope * static_cast<double>(values.size() - 1);
  out.growth = growth_of(values, line, settings.window);
  double reports = 0;
  for (const auto& report : record.reports) {
    if (report.at < rows.front() || report.at > rows.back()) continue;
    ++reports, out.correction += report.correction;
    // The drive has computed its error from the angles of the period before.
    const double own = report.error * degrees_of_turn;
    double difference = std::abs(own - errors[report.at]);
    if (report.at > 0) difference = std::min(difference, std::abs(own - errors[report.at - 1]));
    out.drive_difference = std::max(out.drive_difference, difference);
  }
  if (reports > 0) out.correction /= reports;
  const double added = settings.gain * out.mean / degrees_of_turn + out.correction;
  out.slow = measured_speed(record, rows, &SpindleAngles::slave) < 0 ? -added : added;
  out.lag_without_integral = std::abs(added) / settings.gain * degrees_of_turn;
  return out;
}

std::optional<SyncStep> step_of(const SpindleSyncRecord& record, const SpindleSyncSettings& settings,
                                const Parts& parts, const std::vector<double>& errors) {
  const std::size_t last = parts.rows.back(), recorded = parts.recorded().back();
  const SlaveReport* before = nullptr;
  const SlaveReport* changed = nullptr;
  double reference = 0;
  for (const auto& report : record.reports) {
    if (report.at <= recorded) reference = report.reference;
    changed = &report;
    if (report.at > recorded && std::abs(report.reference - reference) > least_change) break;
    before = changed;
    changed = nullptr;
  }
  if (before == nullptr || changed == nullptr || changed->at >= last) return {};
  const std::size_t from = before->at;
  SyncStep step;
  const auto after =
      std::find_if(parts.rows.begin(), parts.rows.end(), [&](std::size_t row) { return row > changed->at; });
  const auto dwell = std::span(parts.rows).last(static_cast<std::size_t>(parts.rows.end() - after));
  const auto tail = dwell.last(
      std::min(dwell.size(), std::max<std::size_t>(2, cycles_in(settings.settling / 2, record.interval))));
  step.speed = measured_speed(record, tail, &SpindleAngles::master);
  for (const auto row : tail) step.at_end = std::max(step.at_end, std::abs(errors[row]));
  step.largest = largest_of(std::span(errors).subspan(from, last + 1 - from));
  if (const auto inside = inside_from(errors, settings.window, from, last + 1))
    step.back = record.angles[*inside].time - record.angles[from].time;
  for (std::size_t i = from; i < last; ++i)
    step.resolution = std::max(step.resolution, record.angles[i + 1].time - record.angles[i].time);
  return step;
}

std::string advice(const SteadySync& steady, double window) {
  if (steady.growth && *steady.growth > most_growth)
    return "the oscillation grows: lower the gain (10a975), lengthen the integral action time (10a976)";
  if (std::abs(steady.drift) > most_drift * window)
    return "the error drifts: look for slip of an encoder or a belt, or record later (--settling)";
  if (std::abs(steady.mean) > steady.deviation)
    return "the slave lags steadily: let the PLC make the integral action active (spindle_integral 1), else "
           "raise the gain (10a975) or adjust the speed loop of the slave";
  return "the error oscillates: lower the gain (10a975), lengthen the integral action time (10a976), look at "
         "the phase lead (10a977)";
}

}  // namespace

std::vector<double> synchronization_errors(const std::vector<SpindleAngles>& angles,
                                           const SpindleSyncSettings& settings, std::size_t from) {
  const double sign = settings.reverse ? -1 : 1;
  std::vector<double> errors;
  errors.reserve(angles.size());
  for (const auto& a : angles)
    errors.push_back(sign * (a.master + settings.angle / degrees_of_turn) - a.slave);
  const double turns = from < errors.size() ? std::round(errors[from]) : 0;
  for (double& e : errors) e = (e - turns) * degrees_of_turn;
  return errors;
}

SpindleSyncFigures spindle_sync_figures(const SpindleSyncRecord& record,
                                        const SpindleSyncSettings& settings) {
  const auto parts = parts_of(record, settings);
  const auto errors = synchronization_errors(record.angles, settings, parts.recorded().front());
  SpindleSyncFigures out;
  const auto inside = inside_from(errors, settings.window, parts.coupled, parts.recorded().front() + 1);
  const double coupled = record.angles[parts.coupled].time;
  if (inside) out.synchronized = record.angles[*inside].time - coupled;
  out.steady = steady_of(record, settings, parts, errors);
  out.step = step_of(record, settings, parts, errors);
  for (std::size_t i = inside.value_or(parts.recorded().front()); i <= parts.rows.back(); ++i)
    out.course.push_back({record.angles[i].time - coupled, errors[i]});
  return out;
}

TestFindings spindle_sync_findings(double speed, double next, const SpindleSyncFigures& f,
                                   const SpindleSyncSettings& settings) {
  const auto& steady = f.steady;
  const std::string at = fmt::format("S{:g} ", speed);
  const double window = settings.window;
  TestFindings r;
  if (f.synchronized) r.figures.push_back({at + "time to synchronize", *f.synchronized, "s", {}, {}});
  const std::vector<TestFigure> figures = {
      {at + "mean error", steady.mean, "deg", {}, {}},
      {at + "standard deviation", steady.deviation, "deg", {}, {}},
      {at + "largest error", steady.peak, "deg", {}, window},
      {at + "drift in the recording", std::abs(steady.drift), "deg", {}, most_drift * window}};
  r.figures.insert(r.figures.end(), figures.begin(), figures.end());
  if (steady.growth)
    r.figures.push_back({at + "growth of the oscillation", *steady.growth, "", {}, most_growth});
  r.figures.push_back({at + "correction", steady.correction, "1/min", {}, {}});
  r.figures.push_back({at + "slave slow by", steady.slow, "1/min", {}, {}});
  r.figures.push_back({at + "lag without integral action", steady.lag_without_integral, "deg", {}, {}});
  r.figures.push_back({at + "difference of the drive's error", steady.drive_difference, "deg", {}, {}});
  if (!r.reached()) r.notes.push_back(at + "- " + advice(steady, window));
  if (!f.synchronized)
    r.notes.push_back(at + "- the slave did not stay within the window before the recording");
  if (steady.drive_difference > tolerated_difference * window)
    r.notes.push_back(
        fmt::format("{}- the error that the drive reports differs by up to {:.3f} deg from that "
                    "of the angles: a turn was slipped, or an encoder was homed again",
                    at, steady.drive_difference));
  if (std::abs(std::abs(steady.master_speed) - speed) > tolerated_override * speed)
    r.notes.push_back(
        fmt::format("{}- the master turned with {:.1f} 1/min: look at the spindle override and "
                    "the limits of the speed",
                    at, steady.master_speed));
  if (next <= 0) return r;
  if (!f.step) {
    r.notes.push_back(fmt::format("{}- no change of the master's speed to {:g} 1/min was seen", at, next));
    return r;
  }
  const std::string to = fmt::format("S{:g} to S{:g} ", speed, next);
  r.figures.push_back({to + "largest error", f.step->largest, "deg", {}, lost_error});
  if (f.step->back) r.figures.push_back({to + "back after", *f.step->back, "s", {}, {}});
  r.figures.push_back({to + "error at the end", f.step->at_end, "deg", {}, window});
  r.notes.push_back(
      fmt::format("{}- while the program waits for the speed the angles are read every {:.0f} ms "
                  "at most: a shorter peak is not seen",
                  to, f.step->resolution * 1e3));
  if (f.step->at_end > window)
    r.notes.push_back(to +
                      "- the slave does not come back: raise the gain (10a975), lower the acceleration of "
                      "the master (10a971 .. 10a973), then look at the phase lead (10a977)");
  return r;
}

Curve window_curve(double window, double time) {
  return {"window", {{0, window}, {time, window}, {time, -window}, {0, -window}, {0, window}}};
}

}  // namespace trunnion::servo_analysis

// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace trunnion::servo_analysis {
namespace {

using Complex = std::complex<double>;

struct Lines {
  std::size_t first = 1, last = 1;
};

Lines lines_of(double interval, const ResponseWindow& w) {
  if (w.period < 2 || w.periods < 1) throw std::runtime_error("a window of whole periods is needed");
  const double spacing = 1 / (static_cast<double>(w.period) * interval);
  Lines lines;
  lines.first = static_cast<std::size_t>(std::max(1.0, std::ceil(w.first / spacing - 1e-9)));
  lines.last = std::min(static_cast<std::size_t>(std::max(0.0, std::floor(w.last / spacing + 1e-9))),
                        (w.period - 1) / 2);
  if (lines.last < lines.first) throw std::runtime_error("no line of the chirp is between the frequencies");
  return lines;
}

// Discrete Fourier transform at the lines, of the mean of the periods.
std::vector<Complex> spectrum(const std::vector<double>& signal, const ResponseWindow& w,
                              const Lines& lines) {
  if (signal.size() < w.begin + w.period * w.periods)
    throw std::runtime_error("the trace is shorter than the window");
  std::vector<double> mean(w.period, 0.0);
  for (std::size_t k = 0; k < w.periods; ++k)
    for (std::size_t i = 0; i < w.period; ++i) mean[i] += signal[w.begin + k * w.period + i];
  std::vector<Complex> turn(w.period), out;
  for (std::size_t i = 0; i < w.period; ++i)
    turn[i] = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(w.period));
  for (std::size_t line = lines.first; line <= lines.last; ++line) {
    Complex sum = 0;
    std::size_t place = 0;
    for (std::size_t i = 0; i < w.period; ++i) {
      sum += mean[i] * turn[place];
      place += line;
      if (place >= w.period) place -= w.period;
    }
    out.push_back(sum);
  }
  return out;
}

Response quotient(const std::vector<Complex>& output, const std::vector<Complex>& input, double interval,
                  const ResponseWindow& w, const Lines& lines) {
  Response response;
  const double spacing = 1 / (static_cast<double>(w.period) * interval);
  for (std::size_t i = 0; i < output.size(); ++i) {
    if (!(std::abs(input[i]) > 0)) throw std::runtime_error("the input has no signal at a frequency");
    response.push_back({static_cast<double>(lines.first + i) * spacing, output[i] / input[i]});
  }
  return response;
}

}  // namespace

Response frequency_response(const std::vector<double>& input, const std::vector<double>& output,
                            double interval, const ResponseWindow& w) {
  const auto lines = lines_of(interval, w);
  return quotient(spectrum(output, w, lines), spectrum(input, w, lines), interval, w, lines);
}

LoopResponses loop_responses(const AxisTrace& t, const ResponseWindow& w) {
  const auto lines = lines_of(t.interval, w);
  const auto set = spectrum(t.speed_set, w, lines), speed = spectrum(t.speed, w, lines),
             torque = spectrum(t.torque, w, lines), excitation = spectrum(t.excitation, w, lines);
  std::vector<Complex> error(set.size()), returned(set.size());
  for (std::size_t i = 0; i < set.size(); ++i)
    error[i] = set[i] - speed[i], returned[i] = excitation[i] - set[i];
  LoopResponses r;
  r.speed_closed = quotient(speed, set, t.interval, w, lines);
  r.speed_open = quotient(speed, error, t.interval, w, lines);
  r.plant = quotient(speed, torque, t.interval, w, lines);
  // setpoint of the speed loop = excitation - L setpoint.
  r.position_open = quotient(returned, set, t.interval, w, lines);
  r.position_closed = quotient(returned, excitation, t.interval, w, lines);
  return r;
}

Margins margins(const Response& open_loop) {
  Margins m;
  for (std::size_t i = 0; i + 1 < open_loop.size(); ++i) {
    const auto &a = open_loop[i], &b = open_loop[i + 1];
    const double la = std::log(std::abs(a.value)), lb = std::log(std::abs(b.value));
    const double turn = std::arg(b.value / a.value);  // of the phase, continuous over -180 deg
    if ((la >= 0) != (lb >= 0)) {
      const double share = la / (la - lb);
      double margin = std::arg(-a.value) + share * turn;
      margin -= 2 * std::numbers::pi * std::round(margin / (2 * std::numbers::pi));
      if (la >= 0) m.crossover = a.frequency + share * (b.frequency - a.frequency);
      if (!m.phase_margin || margin * degrees < *m.phase_margin) m.phase_margin = margin * degrees;
    }
    const double pa = std::arg(-a.value), pb = pa + turn;
    if (std::abs(pa) < std::numbers::pi / 2 && (pa > 0) != (pb > 0)) {
      const double share = pa / (pa - pb);
      const double margin = std::exp(-(la + share * (lb - la)));
      // With a gain above 1 there the loop is stable by the phase between its crossings.
      if (margin > 1 && (!m.gain_margin || margin < *m.gain_margin))
        m.gain_margin = margin, m.phase_crossover = a.frequency + share * (b.frequency - a.frequency);
    }
  }
  return m;
}

std::optional<double> bandwidth(const Response& closed_loop) {
  const double limit = std::sqrt(0.5);
  for (std::size_t i = 0; i + 1 < closed_loop.size(); ++i) {
    const double a = std::abs(closed_loop[i].value), b = std::abs(closed_loop[i + 1].value);
    if (a >= limit && b < limit)
      return closed_loop[i].frequency +
             (a - limit) / (a - b) * (closed_loop[i + 1].frequency - closed_loop[i].frequency);
  }
  return std::nullopt;
}

double resonance_peak(const Response& closed_loop) {
  double peak = 0;
  for (const auto& p : closed_loop) peak = std::max(peak, std::abs(p.value));
  return peak;
}

}  // namespace trunnion::servo_analysis

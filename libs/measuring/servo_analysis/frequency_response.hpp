// SPDX-License-Identifier: Apache-2.0
// Frequency responses of servo loops by a chirp that repeats, their margins.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "servo_analysis/axis_trace.hpp"

namespace trunnion::servo_analysis {

struct ResponsePoint {
  double frequency = 0;  ///< Hz
  std::complex<double> value;
};
using Response = std::vector<ResponsePoint>;

/// Which samples of a trace are evaluated. A chirp with a period has a spectrum of lines at its multiples;
/// once the loops are in the steady state, whole periods have no leakage, so the response is exact at every
/// line.
struct ResponseWindow {
  std::size_t begin = 0;         ///< first sample, when the start has died away
  std::size_t period = 0;        ///< samples of a period
  std::size_t periods = 1;       ///< that are averaged
  double first = 1, last = 300;  ///< Hz
};

/// Output over input at the lines within first .. last. Throws std::runtime_error when the signals are
/// shorter than the window or the input has no such line.
Response frequency_response(const std::vector<double>& input, const std::vector<double>& output,
                            double interval, const ResponseWindow& window);

struct LoopResponses {
  Response speed_closed;   ///< speed over setpoint of the speed loop
  Response speed_open;     ///< speed over difference of setpoint and speed
  Response plant;          ///< speed over torque, mm/s or deg/s per share of the rated torque
  Response position_open;  ///< of the position loop; with an excitation of the speed loop only
  Response position_closed;
};
/// Of a trace whose excitation is that of the speed loop (mm/s or deg/s).
LoopResponses loop_responses(const AxisTrace& trace, const ResponseWindow& window);

struct Margins {
  std::optional<double> crossover;     ///< Hz: highest at which the open loop falls below 1
  std::optional<double> phase_margin;  ///< deg, the least of all crossings of 1
  std::optional<double> gain_margin;   ///< factor, the least of all crossings of -180 deg below a gain of 1
  std::optional<double> phase_crossover;  ///< Hz of it
};
Margins margins(const Response& open_loop);
/// Hz: first at which a closed loop falls below 0.707.
std::optional<double> bandwidth(const Response& closed_loop);
/// Largest magnitude of a closed loop.
double resonance_peak(const Response& closed_loop);

}  // namespace trunnion::servo_analysis

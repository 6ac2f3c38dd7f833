// SPDX-License-Identifier: Apache-2.0
#include "report/stream_timing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "bus/json.hpp"

namespace trunnion::report {
namespace {

constexpr std::uint64_t smallest_lead = 8;  // of parameter 000900

// Upper ends of the histogram's buckets, s.
const std::vector<double>& edges() {
  static const std::vector<double> values = {50e-6, 100e-6, 200e-6, 500e-6, 1e-3,
                                             2e-3,  5e-3,   10e-3,  20e-3,  50e-3};
  return values;
}

std::string edge_text(double seconds) {
  return seconds < 1e-3 ? fmt::format("{:.0f}us", seconds * 1e6) : fmt::format("{:.0f}ms", seconds * 1e3);
}

double seconds_between(std::int64_t from, std::int64_t to) { return 1e-9 * static_cast<double>(to - from); }

}  // namespace

double Delays::quantile(double share) const {
  if (seconds_.empty()) return 0;
  auto sorted = seconds_;
  const auto last = sorted.size() - 1;
  const auto place = std::ceil(share * static_cast<double>(sorted.size())) - 1;
  const auto at = sorted.begin() +
                  static_cast<std::ptrdiff_t>(std::min(last, static_cast<std::size_t>(std::max(0.0, place))));
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

std::vector<std::uint64_t> Delays::histogram(const std::vector<double>& upper) const {
  std::vector<std::uint64_t> counts(upper.size() + 1);
  for (const double s : seconds_)
    ++counts[static_cast<std::size_t>(std::upper_bound(upper.begin(), upper.end(), s) - upper.begin())];
  return counts;
}

StreamTiming::StreamTiming(std::uint64_t lead, double period) : lead_(lead), period_(period) {
  for (const char* stage : batch_stages) processes_.emplace_back(stage);
  processes_.emplace_back("drive");
  processes_.emplace_back("whole stream");
}

void StreamTiming::add(const Capture& capture) {
  starved_ += capture.starved;
  for (const auto& [topic, cycles] : capture.lost) lost_ += cycles;
  add_drive(capture);
  add_stream(capture);
}

// The feedback is published at the end of a period; it is late by what the periods since the one before took
// longer than they should.
void StreamTiming::add_drive(const Capture& capture) {
  auto& drive = processes_[batch_stages.size()];
  const FeedbackTime* before = nullptr;
  for (const auto& f : capture.feedback) {
    cycles_ += f.count;
    if (before != nullptr && f.tick > before->tick) {
      const auto periods = static_cast<double>(f.tick - before->tick);
      drive.add(std::max(0.0, seconds_between(before->written, f.written) - period_ * periods));
    }
    before = &f;
  }
}

void StreamTiming::add_stream(const Capture& capture) {
  std::uint64_t start = 0, next = 0;
  std::uint32_t epoch = 0;
  auto credit = capture.feedback.begin();
  for (const auto& [key, times] : capture.batches) {
    const auto [batch_epoch, first] = key;
    if (batch_epoch != epoch || first != next) start = first, epoch = batch_epoch;
    if (times.starts) start = first;
    next = times.last_cycle + 1;
    if (std::find(times.written.begin(), times.written.end(), 0) != times.written.end()) continue;
    for (std::size_t stage = 1; stage < batch_stages.size(); ++stage)
      processes_[stage].add(seconds_between(times.written[stage - 1], times.written[stage]));
    // The feedback that allowed the channel to write this batch.
    if (next < start + 2 * lead_) continue;
    const auto needed = next - lead_;
    while (credit != capture.feedback.end() && credit->first + credit->count < needed) ++credit;
    if (credit == capture.feedback.end()) continue;
    processes_.front().add(std::max(0.0, seconds_between(credit->written, times.written.front())));
    processes_.back().add(std::max(0.0, seconds_between(credit->written, times.written.back())));
  }
}

std::uint64_t StreamTiming::usable_lead() const {
  if (whole().count() == 0) return 0;
  const auto cycles = static_cast<std::uint64_t>(std::ceil(whole().largest() / period_));
  return std::max(smallest_lead, 2 * cycles);
}

std::string terminal_text(const StreamTiming& timing) {
  std::string out;
  out += fmt::format("{:<14} {:>9} {:>9} {:>9} {:>9}  counts below", "delay in us", "median", "99 %",
                     "99.9 %", "maximum");
  for (const double edge : edges()) out += fmt::format(" {:>7}", edge_text(edge));
  out += fmt::format(" {:>7}\n", "more");
  for (const auto& process : timing.processes()) {
    out += fmt::format("{:<14}", process.name());
    for (const double share : {0.5, 0.99, 0.999, 1.0})
      out += fmt::format(" {:>9.0f}", 1e6 * process.quantile(share));
    out += fmt::format("{:>14}", "");
    for (const auto count : process.histogram(edges())) out += fmt::format(" {:7}", count);
    out += '\n';
  }
  out += fmt::format("{} cycles, {} starved periods, {} cycles missing in the recordings\n", timing.cycles(),
                     timing.starved(), timing.lost());
  if (timing.usable_lead() > 0)
    out += fmt::format(
        "This computer could run with a lead (000900) of {} cycles: twice the longest delay of the stream\n",
        timing.usable_lead());
  return out;
}

std::string json_text(const StreamTiming& timing) {
  bus::Json processes = bus::Json::array();
  for (const auto& process : timing.processes())
    processes.push_back({{"process", process.name()},
                         {"count", process.count()},
                         {"median_us", 1e6 * process.quantile(0.5)},
                         {"p99_us", 1e6 * process.quantile(0.99)},
                         {"p999_us", 1e6 * process.quantile(0.999)},
                         {"maximum_us", 1e6 * process.largest()},
                         {"histogram", process.histogram(edges())}});
  bus::Json edges_us = bus::Json::array();
  for (const double edge : edges()) edges_us.push_back(1e6 * edge);
  return bus::Json{{"processes", processes},          {"histogram_edges_us", edges_us},
                   {"cycles", timing.cycles()},       {"starved_periods", timing.starved()},
                   {"missing_cycles", timing.lost()}, {"usable_lead_cycles", timing.usable_lead()}}
      .dump();
}

}  // namespace trunnion::report

// SPDX-License-Identifier: Apache-2.0
#include "report/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "machine/axes.hpp"
#include "machine/parameter_constants.hpp"
#include "recording/file_stream.hpp"
#include "report/capture.hpp"

namespace trunnion::report {
namespace {

using language::AxisValues;

class Fnv1a {
 public:
  void add(const double* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      unsigned char bytes[sizeof(double)];
      std::memcpy(bytes, &values[i], sizeof bytes);
      for (const auto byte : bytes) hash_ = (hash_ ^ byte) * 0x100000001b3u;
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

class ErrorSum {
 public:
  explicit ErrorSum(ContourError& out) : out_(out) {}
  void add(double distance, const Sample& sample) {
    ++out_.cycles;
    squares_ += distance * distance;
    if (distance >= out_.largest) {
      out_.largest = distance;
      out_.cycle = sample.cycle;
      out_.line = sample.line;
    }
    out_.rms = std::sqrt(squares_ / static_cast<double>(out_.cycles));
  }

 private:
  ContourError& out_;
  double squares_ = 0;
};

// Walks a table by ascending cycles.
class Cursor {
 public:
  explicit Cursor(const RowTable& table) : table_(table) {}
  const double* at(std::uint64_t cycle) {
    while (next_ < table_.cycles.size() && table_.cycles[next_] < cycle) ++next_;
    return next_ < table_.cycles.size() && table_.cycles[next_] == cycle ? table_.row(next_) : nullptr;
  }

 private:
  const RowTable& table_;
  std::size_t next_ = 0;
};

// mm or deg. In full closed loop (10a930) the encoder is that of the load.
double play_behind_encoder(const machine::Parameters& parameters, std::uint32_t axis) {
  const bool at_load = parameters.integer(parameter::full_closed_loop, axis) != 0;
  return at_load ? 0 : parameters.get(parameter::mechanical_backlash, axis);
}

// The loads behind the play of the axes (10a910), from the rows of the motor encoders: a load follows its
// motor when one flank or the other touches. It begins in the middle of the play.
class LoadRows {
 public:
  LoadRows(const RowTable& motor, const machine::Parameters& parameters) : motor_(motor) {
    for (const auto& axis : machine::drive_axes(parameters))
      half_.push_back(play_behind_encoder(parameters, axis.number) / 2);
    half_.resize(motor.width, 0);
    if (!motor.cycles.empty()) load_.assign(motor.row(0), motor.row(0) + motor.width);
  }
  /// `cycle` does not descend from call to call.
  const double* at(std::uint64_t cycle) {
    for (; next_ < motor_.cycles.size() && motor_.cycles[next_] <= cycle; ++next_)
      for (std::size_t i = 0; i < load_.size(); ++i) {
        const double motor = motor_.row(next_)[i];
        load_[i] = std::clamp(load_[i], motor - half_[i], motor + half_[i]);
      }
    return next_ > 0 && motor_.cycles[next_ - 1] == cycle ? load_.data() : nullptr;
  }

 private:
  const RowTable& motor_;
  std::vector<double> half_, load_;
  std::size_t next_ = 0;
};

class Evaluation {
 public:
  Evaluation(const Capture& capture, const TrueTip& true_tip, Report& report)
      : capture_(capture),
        true_tip_(true_tip),
        report_(report),
        chain_(machine::make_chain(capture.tables.parameters, capture.tables.channel)),
        axes_(machine::channel_axes(capture.tables.parameters, capture.tables.channel)) {
    const auto drive = machine::drive_axes(capture.tables.parameters);
    for (const auto number : axes_.number) {
      drive_columns_.push_back(machine::column_of(drive, number));
      const auto found = std::find(capture.gantry_axes.begin(), capture.gantry_axes.end(), number);
      gantry_columns_.push_back(
          found == capture.gantry_axes.end() ? -1 : static_cast<int>(found - capture.gantry_axes.begin()));
      has_play_.push_back(play_behind_encoder(capture.tables.parameters, number) > 0);
    }
  }

  // Machine coordinates of a path row: where the interpreter begins.
  AxisValues machine_position(const PathRow& row) const {
    AxisValues p = row.position;
    if (row.rtcp) {
      const Vec3 at =
          chain_.machine_from_tip({p[0], p[1], p[2]}, geometry::angles_of(p.data()), row.tool_length);
      std::copy_n(at.data(), 3, p.begin());
    }
    return p;
  }

  void run() {
    ErrorSum commanded_feed(report_.commanded_feed), commanded_rapid(report_.commanded_rapid),
        actual_feed(report_.actual_feed), actual_rapid(report_.actual_rapid), true_feed(report_.true_feed),
        true_rapid(report_.true_rapid);
    Cursor gantry(capture_.gantry), commanded(capture_.commanded);
    LoadRows actual(capture_.actual, capture_.tables.parameters);
    Fnv1a hash;
    const auto& programmed = report_.programmed;
    std::size_t guess = 0, actual_guess = 0, true_guess = 0;
    double residual_squares = 0, feed_sum = 0;
    std::uint64_t feed_cycles = 0;
    report_.samples.reserve(capture_.path.size());
    for (const auto& row : capture_.path) {
      Sample sample;
      sample.cycle = row.cycle;
      sample.line = row.line;
      // A line that is both is counted as what it is to the part: cutting.
      sample.rapid = !programmed.feed_lines.contains(row.line);
      sample.commanded = tip_of_row(row);
      const auto near = programmed.path.nearest(sample.commanded, guess);
      guess = near.piece;
      sample.commanded_foot = near.point;
      (sample.rapid ? commanded_rapid : commanded_feed).add(near.distance, sample);

      const double* joints = capture_.gantry_axes.empty() ? nullptr : gantry.at(row.cycle);
      if (joints != nullptr) {
        const double off = (tip_of(by_letter(joints, gantry_columns_), row) - sample.commanded).norm();
        residual_squares += off * off;
        ++report_.residual_cycles;
        report_.residual_largest = std::max(report_.residual_largest, off);
      }
      if (const double* command = commanded.at(row.cycle)) {
        hash.add(command, capture_.commanded.width);
        ++report_.executed;
      }
      if (const double* position = actual.at(row.cycle)) {
        sample.has_actual = true;
        sample.actual = actual_tip(position, joints, row);
        const auto close = programmed.path.nearest(sample.actual, actual_guess);
        actual_guess = close.piece;
        sample.actual_foot = close.point;
        (sample.rapid ? actual_rapid : actual_feed).add(close.distance, sample);
        if (true_tip_) {
          const auto at = programmed.path.nearest(true_tip_of(position, row), true_guess);
          true_guess = at.piece;
          (sample.rapid ? true_rapid : true_feed).add(at.distance, sample);
        }
      }
      const auto* before = report_.samples.empty() ? nullptr : &report_.samples.back();
      if (before != nullptr && before->cycle + 1 == sample.cycle &&
          capture_.path[report_.samples.size() - 1].tool_length == row.tool_length) {
        sample.commanded_feed = (sample.commanded - before->commanded).norm() / report_.period * 60;
        if (sample.has_actual && before->has_actual)
          sample.actual_feed = (sample.actual - before->actual).norm() / report_.period * 60;
        if (!sample.rapid) {
          feed_sum += sample.commanded_feed;
          ++feed_cycles;
          report_.largest_feed = std::max(report_.largest_feed, sample.commanded_feed);
        }
      }
      report_.samples.push_back(sample);
    }
    report_.cycles = capture_.path.size();
    report_.command_hash = hash.value();
    if (feed_cycles > 0) report_.mean_feed = feed_sum / static_cast<double>(feed_cycles);
    if (report_.residual_cycles > 0)
      report_.residual_rms = std::sqrt(residual_squares / static_cast<double>(report_.residual_cycles));
    measure_time();
  }

 private:
  Vec3 tip_of_row(const PathRow& row) const {
    const auto& p = row.position;
    if (row.rtcp) return {p[0], p[1], p[2]};
    return chain_.tip_from_machine({p[0], p[1], p[2]}, geometry::angles_of(p.data()), row.tool_length);
  }

  // Axes without a column are at zero, as in the setpoint batches.
  AxisValues by_letter(const double* joints, const std::vector<int>& columns) const {
    AxisValues p{};
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i] >= 0) p[axes_.index[i]] = joints[columns[i]];
    return p;
  }
  // Compensation moves the axes off the programmed path, so that the tip of the true machine is on it: what
  // it has added in this cycle is no error of the axes. Behind a play of 10a910 the load itself is where it
  // is to be, and keeps it. Without `joints` nothing is known to be added.
  Vec3 actual_tip(const double* loads, const double* joints, const PathRow& row) const {
    auto p = by_letter(loads, drive_columns_);
    if (joints == nullptr) return tip_of(p, row);
    const auto compensated = by_letter(joints, gantry_columns_), programmed = machine_position(row);
    for (std::size_t i = 0; i < axes_.index.size(); ++i) {
      const auto letter = axes_.index[i];
      if (gantry_columns_[i] >= 0 && !has_play_[i]) p[letter] -= compensated[letter] - programmed[letter];
    }
    return tip_of(p, row);
  }
  Vec3 tip_of(const AxisValues& p, const PathRow& row) const {
    return chain_.tip_from_machine({p[0], p[1], p[2]}, geometry::angles_of(p.data()), row.tool_length);
  }

  Vec3 true_tip_of(const double* loads, const PathRow& row) {
    const auto p = by_letter(loads, drive_columns_);
    if (loads_before_)
      for (std::size_t i = 0; i < p.size(); ++i)
        if (p[i] != (*loads_before_)[i]) approach_[i] = p[i] > (*loads_before_)[i] ? 1 : -1;
    loads_before_ = p;
    return true_tip_(p, approach_, row.tool_length);
  }

  static Latency latency(std::string from, std::string to, std::vector<double>& seconds) {
    Latency result{std::move(from), std::move(to), seconds.size()};
    if (seconds.empty()) return result;
    std::sort(seconds.begin(), seconds.end());
    const auto at = [&](double share) {
      return seconds[std::min(seconds.size() - 1,
                              static_cast<std::size_t>(share * static_cast<double>(seconds.size())))];
    };
    result.median = at(0.5);
    result.p99 = at(0.99);
    result.largest = seconds.back();
    return result;
  }

  void measure_time() {
    std::vector<double> seconds;
    for (std::size_t stage = 0; stage + 1 < batch_stages.size(); ++stage) {
      seconds.clear();
      for (const auto& [key, times] : capture_.batches)
        if (times.written[stage] != 0 && times.written[stage + 1] != 0)
          seconds.push_back(1e-9 * static_cast<double>(times.written[stage + 1] - times.written[stage]));
      report_.latencies.push_back(latency(batch_stages[stage], batch_stages[stage + 1], seconds));
    }
    // The drive's feedback with the last cycle of a batch; in real time this is mostly the lead.
    std::vector<const FeedbackTime*> feedback;
    for (const auto& f : capture_.feedback) feedback.push_back(&f);
    std::stable_sort(feedback.begin(), feedback.end(),
                     [](const auto* a, const auto* b) { return a->first < b->first; });
    seconds.clear();
    for (const auto& [key, times] : capture_.batches) {
      auto at = std::upper_bound(feedback.begin(), feedback.end(), times.last_cycle,
                                 [](std::uint64_t cycle, const auto* f) { return cycle < f->first; });
      if (at == feedback.begin() || times.written.back() == 0) continue;
      --at;
      if ((*at)->first + (*at)->count > times.last_cycle)
        seconds.push_back(1e-9 * static_cast<double>((*at)->written - times.written.back()));
    }
    report_.latencies.push_back(latency(batch_stages.back(), "drive feedback", seconds));

    if (capture_.path.empty()) return;
    const auto first_cycle = capture_.path.front().cycle, last_cycle = capture_.path.back().cycle;
    const FeedbackTime *first = nullptr, *last = nullptr;
    for (const auto* f : feedback) {
      if (f->first + f->count <= first_cycle || f->first > last_cycle) continue;
      if (first == nullptr) first = f;
      last = f;
    }
    if (first == nullptr || first == last) return;
    report_.wall_seconds = 1e-9 * static_cast<double>(last->written - first->written);
    // From the end of the first batch to the end of the last.
    const auto cycles = static_cast<double>(last->first + last->count - first->first - first->count);
    if (report_.wall_seconds > 0) report_.speed = cycles * report_.period / report_.wall_seconds;
  }

  const Capture& capture_;
  const TrueTip& true_tip_;
  Report& report_;
  geometry::Chain chain_;
  machine::ChannelAxes axes_;
  std::vector<int> drive_columns_, gantry_columns_;
  std::vector<bool> has_play_;
  std::optional<AxisValues> loads_before_;
  std::array<int, 9> approach_{};
};

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace

Report make_report(const std::string& recording, const ReportInputs& inputs) {
  recording::FileSource source(recording);
  Capture capture = read_capture(source, inputs.channel);
  if (!capture.has_parameters) {
    if (!inputs.parameters) throw std::runtime_error(recording + ": no parameters in the recording");
    capture.tables.parameters = *inputs.parameters;
  }
  if (!capture.has_tools && inputs.tools) capture.tables.tools = *inputs.tools;
  if (!capture.has_offsets && inputs.offsets) capture.tables.offsets = *inputs.offsets;

  Report report;
  report.recording = recording;
  report.program = inputs.program_name;
  report.machine = capture.metadata["machine"];
  report.version = capture.metadata["version"];
  report.contract = capture.metadata["contract"];
  report.messages = capture.messages;
  report.problem = capture.problem;
  report.lost = capture.lost;
  report.late_batches = capture.late_batches;
  report.repeated_batches = capture.repeated_batches;
  report.starved = capture.starved;
  report.period = capture.tables.parameters.get(parameter::interpolation_cycle) * 1e-6;
  Evaluation evaluation(capture, inputs.true_tip, report);
  report.programmed =
      programmed_path(inputs.program_text, capture.tables,
                      capture.path.empty() ? AxisValues{} : evaluation.machine_position(capture.path.front()),
                      inputs.program_name);
  if (report.problem.empty() && !report.programmed.problem.empty())
    report.problem = inputs.program_name + ":" + report.programmed.problem;
  if (report.problem.empty() && capture.path.empty())
    report.problem = "no motion of the channel in the recording";
  evaluation.run();
  return report;
}

void write_report(const Report& report, const std::string& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw std::runtime_error(directory + ": " + error.message());
  const std::filesystem::path base(directory);
  write_file(base / "report.json", json_text(report));
  write_file(base / "report.txt", terminal_text(report));
  write_file(base / "path.svg", path_picture(report));
  write_file(base / "feed.svg", feed_picture(report));
}

}  // namespace trunnion::report

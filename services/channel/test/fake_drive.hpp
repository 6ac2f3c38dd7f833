// SPDX-License-Identifier: Apache-2.0
// A drive that executes everything at once: the channel's counterpart in its unit tests.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "channel_core.hpp"

namespace trunnion::channel::testing {

using idl::stream::StreamRequestKind;

class FakeDrive {
 public:
  explicit FakeDrive(std::size_t axes) : position_(axes, 0.0) {}

  void request(const idl::stream::StreamRequest& request) {
    echo_.request = request.request;
    if (request.kind == StreamRequestKind::START || request.kind == StreamRequestKind::NEW_EPOCH) {
      echo_.epoch = request.epoch;
      if (request.kind == StreamRequestKind::NEW_EPOCH && mode == DriveMode::HELD)
        mode = DriveMode::FOLLOWING;  // a new epoch ends the hold of the old one
      echo_.active = mode == DriveMode::FOLLOWING;
      echo_.start = next;
      ++starts;
    } else if (request.kind == StreamRequestKind::RESUME) {
      if (!waits_for_others) mode = DriveMode::FOLLOWING;
      ++resumes;
    } else {
      echo_.active = false;
      queue_.clear();
      mode = DriveMode::FOLLOWING;
      if (request.kind == StreamRequestKind::HOME) echo_.search = idl::stream::ReferenceSearch::SEARCHES;
    }
  }
  /// It finds `axis` at `position`, or it does not.
  void end_search(bool found, std::size_t axis = 0, double position = 0) {
    mode = DriveMode::FOLLOWING;
    echo_.search =
        found ? idl::stream::ReferenceSearch::REFERENCE_FOUND : idl::stream::ReferenceSearch::SEARCH_FAILED;
    if (found) position_[axis] = position;
  }
  void put(const idl::stream::PathBatch& batch) { queue_.push_back(batch); }
  /// A skip input that axis `axis` switches on where it passes `position` upwards.
  struct Switch {
    std::uint8_t input = 1;
    std::size_t axis = 0;
    double position = 0;
  };
  std::optional<Switch> switch_;
  /// Following error of the first axis in a cycle, mm; empty: the axes follow without error.
  std::function<double(std::uint64_t cycle, const std::vector<double>& row)> lag;
  /// Angle of the encoder of a spindle in a cycle, rev; empty: there is none.
  std::function<double(std::uint64_t cycle)> spindle_angle;
  /// Speed of the first spindle now, 1/min; empty: it is not reported, or 0 with an angle.
  std::function<double()> spindle_speed;
  /// States of the spindles when all cycles below `next` are executed; empty: the machine has none.
  std::function<std::vector<idl::stream::SpindleState>(std::uint64_t next)> spindle_states;
  /// Executes batches, at most `cycles` setpoints' worth, and reports.
  idl::stream::Feedback run(std::uint64_t cycles = ~0ull) {
    std::uint64_t done = 0;
    idl::stream::Feedback feedback;
    while (mode == DriveMode::FOLLOWING && !queue_.empty() && done < cycles) {
      const auto& f = queue_.front();
      if (f.epoch == echo_.epoch) {
        for (std::uint32_t i = 0; i < f.count; ++i) {
          if (edge_) {
            edge_->cycle = f.first + i;
            feedback.skips.push_back(*std::exchange(edge_, std::nullopt));
          }
          rows.push_back({f.setpoints.begin() + 9 * i, f.setpoints.begin() + 9 * (i + 1)});
          look_at_switch();
          spindle.push_back(f.spindle.empty() ? std::nullopt : std::optional(f.spindle[i]));
          radius.push_back(f.turning_radius.empty() ? std::nullopt : std::optional(f.turning_radius[i]));
          feedback.commanded.insert(feedback.commanded.end(), rows.back().begin(),
                                    rows.back().begin() + static_cast<long>(position_.size()));
          for (std::size_t a = 0; a < position_.size(); ++a)
            actual_.push_back(rows.back()[a] - (a == 0 && lag ? lag(f.first + i, rows.back()) : 0));
          lines.push_back(f.lines[i]);
          follows.push_back(f.follows_spindle);
          if (spindle_angle) feedback.spindle_angle.push_back(spindle_angle(f.first + i));
        }
        for (std::size_t a = 0; a < position_.size(); ++a) position_[a] = rows.back()[a];
        next = f.first + f.count;
        done += f.count;
        echo_.snapshot = f.snapshot;
        echo_.states = f.states;
        if (f.ends) echo_.active = false;
      }
      queue_.pop_front();
    }
    feedback.count = static_cast<std::uint32_t>(feedback.commanded.size() / position_.size());
    feedback.actual.resize(feedback.commanded.size());
    std::copy(actual_.end() - static_cast<long>(feedback.actual.size()), actual_.end(),
              feedback.actual.begin());
    feedback.first = next - feedback.count;
    if (spindle_angle) feedback.spindle_speed = {0.0};
    if (spindle_speed) feedback.spindle_speed = {spindle_speed()};
    if (spindle_states) feedback.spindles = spindle_states(next);
    feedback.mode = mode;
    feedback.tick = tick += done;
    feedback.axis_count = static_cast<std::uint16_t>(position_.size());
    feedback.position = position_;
    feedback.enabled = enabled;
    echo_.next = next;
    feedback.channels = {echo_};
    return feedback;
  }
  /// As if its process had been killed and started again.
  void forget() {
    queue_.clear();
    echo_.active = false;
    echo_.request = 0;
  }
  /// Batches that are not executed are lost with their stage; the consistent cut stays.
  void lose_queue() { queue_.clear(); }

  DriveMode mode = DriveMode::FOLLOWING;
  std::vector<std::uint8_t> enabled;  // as in Feedback
  bool waits_for_others = false;      // another channel that it has stopped has not resumed yet
  int starts = 0, resumes = 0;
  std::uint64_t tick = 0;  // one for each setpoint; more pass in a hold
  std::uint64_t next = 0;
  std::vector<std::vector<double>> rows;
  std::vector<std::uint32_t> lines;
  std::vector<std::optional<double>> spindle;  // of each row, when one was coupled
  std::vector<bool> follows;  // of each row: the drive goes to the place of the measured angle
  std::vector<std::optional<double>> radius;  // of each row, with a constant surface speed

 private:
  // The axes follow without error: what a cycle commands is reached before the next one.
  void look_at_switch() {
    if (!switch_ || rows.size() < 2) return;
    const auto& before = rows[rows.size() - 2];
    const auto& now = rows.back();
    const std::size_t a = switch_->axis;
    if (!(before[a] < switch_->position && now[a] >= switch_->position)) return;
    const double share = (switch_->position - before[a]) / (now[a] - before[a]);
    edge_ = idl::stream::SkipEdge{switch_->input, 0, {}};
    for (std::size_t i = 0; i < position_.size(); ++i)
      edge_->position.push_back(before[i] + share * (now[i] - before[i]));
  }

  std::optional<idl::stream::SkipEdge> edge_;
  std::vector<double> position_, actual_;
  std::deque<idl::stream::PathBatch> queue_;
  idl::stream::ChannelEcho echo_;
};

}  // namespace trunnion::channel::testing

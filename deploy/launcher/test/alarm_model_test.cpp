// SPDX-License-Identifier: Apache-2.0
// Random sequences of start, swap, kill, stray and reset over the pure cores of the launcher: whatever has
// happened, every alarm can be reset once its cause is gone, and none can be before.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "contracts/topics.hpp"
#include "foreign_services.hpp"
#include "machine/alarm_constants.hpp"
#include "restart_policy.hpp"
#include "service_fault.hpp"
#include "swap_sequence.hpp"

namespace trunnion::launcher {
namespace {

using idl::service::Lifecycle;
using idl::service::StandbyState;
using Key = std::pair<std::uint32_t, std::uint32_t>;  // number, part

constexpr double step = 0.05;                // s between two looks of the launcher
constexpr double start_time = 0.2;           // s until a process that was started is active
constexpr std::uint32_t generation = 10000;  // cluster/instances.hpp

// Latches as service::AlarmBoard does.
class Board {
 public:
  void raise(const AlarmCause& cause) { alarms_[{cause.alarm->number, cause.part}] = true; }
  void end(const AlarmCauses::Ended& ended) {
    const Key key{ended.alarm->number, ended.part};
    if (ended.alarm == &alarm::redundancy_lost)
      alarms_.erase(key);
    else if (const auto found = alarms_.find(key); found != alarms_.end())
      found->second = false;
  }
  void reset() {
    std::erase_if(alarms_, [](const auto& entry) { return !entry.second; });
  }
  bool active(std::uint32_t number, std::uint32_t part) const { return alarms_.contains({number, part}); }
  std::string text() const {
    std::string all;
    for (const auto& [key, cause] : alarms_)
      all += std::to_string(key.first) + " of " + std::to_string(key.second) + "; ";
    return all;
  }
  bool empty() const { return alarms_.empty(); }

 private:
  std::map<Key, bool> alarms_;  // active ones, and whether their cause is there
};

struct Process {
  std::uint32_t instance = 0;
  bool runs = false, stays = true;  ///< `stays`: it does not end by itself
  double started = 0;
  RestartPolicy policy;
  ServiceFault fault;
  bool retiring = false;

  bool active(double now) const { return runs && now - started >= start_time; }
  void start(double now) {
    runs = true, started = now;
    policy.started(now);
  }
};

/// A launcher with three services, the first two replicas of a stage.
class Model {
 public:
  Model() {
    for (std::uint32_t i = 0; i < 3; ++i) {
      processes_[i].instance = i + 1;
      processes_[i].start(0);
    }
    run(1);
  }

  void kill(std::size_t i) {
    auto& process = processes_[i];
    if (!process.runs) return;
    process.runs = false;
    process.policy.ended(now_);
    if (process.retiring) return;
    const bool replica = i < 2 && processes_[1 - i].active(now_);
    process.fault.lose("killed", replica ? Loss::redundant : Loss::holds);
    if (process.policy.gave_up()) process.fault.give_up("does not stay up");
  }
  void crash_always(std::size_t i, bool always) { processes_[i].stays = !always; }
  void swap(std::size_t i) {
    if (swap_ || !processes_[i].active(now_)) return;
    swapped_ = i;
    fresh_ = {};
    fresh_.instance = processes_[i].instance % generation + ++generations_ * generation;
    fresh_.start(now_);
    swap_.emplace(i < 2 ? Comparison::batches : Comparison::once, 10, now_);
    promoted_ = false;
  }
  void kill_fresh() { fresh_.runs = false; }
  void stray(std::uint32_t instance) {
    idl::service::Announcement announcement;
    announcement.instance = instance, announcement.service = "drive", announcement.contract = "other";
    bus::WriterId writer{};
    writer[0] = static_cast<std::uint8_t>(++strays_made_), writer[1] = static_cast<std::uint8_t>(instance);
    foreign_.announced(announcement, writer);
    strays_.push_back({writer, "", "", ""});
    foreign_.discovered(strays_);
  }
  void strays_leave() {
    strays_.clear();
    foreign_.discovered(strays_);
  }
  void other_machine() { foreign_.heard(2, "another machine.yaml", now_); }
  void reset() {
    for (auto& process : processes_) process.policy.retry();
    board_.reset();
  }

  void run(double seconds) {
    for (const double until = now_ + seconds; now_ < until; now_ += step) look();
  }
  const Board& board() const { return board_; }
  bool all_active() const {
    return std::all_of(processes_.begin(), processes_.end(),
                       [&](const Process& process) { return process.active(now_); });
  }
  /// An alarm that is active has its cause, or can be reset.
  void check_causes() {
    auto after = board_;
    after.reset();
    for (const auto& process : processes_) {
      const auto place = process.instance;
      if (!process.fault.lost()) {
        EXPECT_FALSE(after.active(alarm::service_lost.number, place));
        EXPECT_FALSE(after.active(alarm::service_not_staying.number, place));
      }
    }
  }

 private:
  void look() {
    for (std::size_t i = 0; i < processes_.size(); ++i) {
      auto& process = processes_[i];
      if (process.runs && !process.stays && process.active(now_)) kill(i);
      if (process.retiring) continue;
      if (!process.runs && process.policy.due(now_)) process.start(now_);
      if (process.active(now_)) {
        process.policy.beat(now_);
        process.fault.active();
        process.fault.in_step();
      }
    }
    if (swap_) step_swap();
    std::vector<AlarmCause> causes;
    for (const auto& process : processes_) process.fault.add_causes(process.instance, causes);
    foreign_.add_causes(now_, causes);
    for (const auto& ended : causes_.update(causes)) board_.end(ended);
    for (const auto& cause : causes) board_.raise(cause);
  }

  void step_swap() {
    auto& old = processes_[swapped_];
    SwapView view;
    view.now = now_;
    view.new_runs = fresh_.runs, view.old_runs = old.runs;
    view.announced = fresh_.active(now_);
    view.standby = view.announced ? StandbyState::MATCHING : StandbyState::JOINING;
    view.lifecycle = promoted_ && fresh_.active(now_) ? Lifecycle::ACTIVE : Lifecycle::INACTIVE;
    view.in_step = promoted_;
    view.moved = 0;
    const auto next = swap_->step(view);
    switch (next.action) {
      case SwapAction::start_new:
        fresh_.start(now_);
        break;
      case SwapAction::promote_new:
        promoted_ = true;
        break;
      case SwapAction::end_old:
      case SwapAction::kill_old:
        old.retiring = true;
        old.runs = false;
        break;
      case SwapAction::kill_new:
        fresh_.runs = false;
        break;
      case SwapAction::start_old:
        old.retiring = false;
        old.start(now_);
        break;
      case SwapAction::succeed:
        fresh_.stays = true;
        old = fresh_;
        swap_.reset();
        break;
      case SwapAction::fail:
        fresh_.runs = false;
        swap_.reset();
        break;
      case SwapAction::wait:
        break;
    }
  }

  double now_ = 0;
  std::array<Process, 3> processes_;
  Process fresh_;
  std::optional<SwapSequence> swap_;
  std::size_t swapped_ = 0;
  bool promoted_ = false;
  std::uint32_t generations_ = 0, strays_made_ = 0;
  std::vector<bus::DiscoveredWriter> strays_;
  ForeignServices foreign_;
  AlarmCauses causes_;
  Board board_;
};

TEST(AlarmModel, AnOldProcessThatDiesDuringItsOwnSwapLeavesNoAlarmThatCannotBeReset) {
  Model model;
  model.swap(2);
  model.kill(2);
  model.run(0.05);
  EXPECT_TRUE(model.board().active(100, 3)) << model.board().text();
  model.run(10);
  ASSERT_TRUE(model.all_active());
  model.reset();
  EXPECT_TRUE(model.board().empty()) << model.board().text();
}

TEST(AlarmModel, AStrayOfAnotherContractIsAnAlarmWhileItIsThere) {
  Model model;
  model.stray(77);
  model.run(1);
  model.reset();
  EXPECT_TRUE(model.board().active(101, 77)) << "it is still there";
  model.strays_leave();
  model.run(1);
  EXPECT_TRUE(model.board().active(101, 77)) << "until it is reset";
  model.reset();
  EXPECT_TRUE(model.board().empty()) << model.board().text();
}

TEST(AlarmModel, AfterAnyHistoryEveryAlarmCanBeResetOnceItsCauseIsGone) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    Model model;
    std::string history;
    for (int event = 0; event < 40; ++event) {
      const auto i = random() % 3;
      const auto what = random() % 9;
      history += "\n  " + std::to_string(what) + " of " + std::to_string(i);
      switch (what) {
        case 0:
        case 1:
          model.kill(i);
          break;
        case 2:
        case 3:
          model.swap(i);
          break;
        case 4:
          model.kill_fresh();
          break;
        case 5:
          model.stray(i + 1 + (random() % 2) * 100);
          break;
        case 6:
          if (random() % 2 == 0)
            model.strays_leave();
          else
            model.other_machine();
          break;
        case 7:
          model.crash_always(i, random() % 3 == 0);
          break;
        case 8:
          model.reset();
          break;
      }
      model.run(step * static_cast<double>(random() % 30));
      model.check_causes();
    }
    // Every cause goes: processes stay, strays leave, the launcher has the time to start what it has given
    // up.
    for (std::size_t i = 0; i < 3; ++i) model.crash_always(i, false);
    model.strays_leave();
    model.reset();
    model.run(40);
    ASSERT_TRUE(model.all_active()) << "seed " << seed << history;
    model.reset();
    ASSERT_TRUE(model.board().empty()) << "seed " << seed << ": " << model.board().text() << history;
  }
}

}  // namespace
}  // namespace trunnion::launcher

// SPDX-License-Identifier: Apache-2.0
// Programs that are disturbed by a random fault every few seconds, in virtual time. TRUNNION_SOAK_SEED
// chooses the faults, TRUNNION_SOAK_SECONDS how long; `make soak` sets both.
#include <cstdlib>
#include <random>

#include "fault_matrix_rig.hpp"

namespace trunnion::integration {
namespace {

constexpr int rounds = 30;
constexpr unsigned first_line = 4, last_line = 7 + 2 * rounds - 4;  // of strikes: with a way ahead of them

double number_from(const char* name, double otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr && *text != 0 ? std::atof(text) : otherwise;
}

// One fault of the soak, drawn before it is known what the machine will be doing.
struct Stroke {
  std::string service;
  Fault fault = Fault::killed;
  unsigned line = 0;  // 0: at rest, before the program
};

class Soak {
 public:
  explicit Soak(std::uint64_t seed) : random_(seed), rig_("mixed", true, std::nullopt, Time::virtual_) {}

  void run(double seconds);
  const std::string& history() const { return history_; }

 private:
  std::uint64_t draw(std::uint64_t below) { return random_() % below; }
  Stroke draw_stroke(unsigned from);
  void prepare();
  void one_program();
  void strike(const Stroke& stroke);
  void strike_in_motion(const Stroke& stroke);
  void expect_on_path(bool whole);

  std::mt19937_64 random_;
  FaultRig rig_;
  Rows reference_;
  double begun_ = 0, finished_ = 0;
  int strokes_ = 0;
  double largest_ = 0, unseen_ = 0;
  bool begin_again_ = false;
  std::string history_;
};

Stroke Soak::draw_stroke(unsigned from) {
  const auto& services = matrix_services();
  // A restart loop takes as long as all others together.
  constexpr Fault faults[] = {Fault::killed,     Fault::killed,    Fault::killed,    Fault::killed,
                              Fault::terminated, Fault::suspended, Fault::suspended, Fault::restarts};
  Stroke stroke;
  stroke.service = services[draw(services.size())];
  stroke.fault = faults[draw(std::size(faults))];
  stroke.line = from == 0 ? 0 : from + static_cast<unsigned>(draw(last_line - from));
  return stroke;
}

void Soak::prepare() {
  rig_.store_keepsakes(rounds);
  reference_ = rig_.undisturbed(begun_);
  ASSERT_GT(reference_.size(), 10000u);
  finished_ = begun_;
}

void Soak::expect_on_path(bool whole) {
  const auto judgement = rig_.judge(reference_, whole);
  ASSERT_EQ(judgement.problem, "");
  largest_ = std::max(largest_, judgement.largest);
  unseen_ += static_cast<double>(judgement.unseen);
}

void Soak::strike(const Stroke& stroke) {
  history_ += std::to_string(++strokes_) + ": " + stroke.service + " " + name_of(stroke.fault) +
              (stroke.line == 0 ? " at rest" : " at line " + std::to_string(stroke.line)) + ", program " +
              std::to_string(static_cast<int>(begun_)) + "\n";
  if (stroke.service == "recorder") rig_.start_recorder();
  rig_.strike(stroke.service, stroke.fault);
}

void Soak::strike_in_motion(const Stroke& stroke) {
  // Until it moves, the channel shows the last line of the program before.
  auto& cluster = rig_.cluster();
  if (!cluster.until(
          [&] {
            return cluster.rows.size() > 500 &&
                   (cluster.channels[0].line >= stroke.line || cluster.state() == RunState::IDLE);
          },
          300))
    FAIL() << "line " << stroke.line << " is not reached; " << rig_.cluster().told();
  ASSERT_NO_FATAL_FAILURE(strike(stroke));
  const auto seen = rig_.await(stroke.service, stroke.fault, true);
  for (const auto number : seen.alarms)
    EXPECT_TRUE(number == 100 || number == 105 || number == 110 || number == 130 || number == 133 ||
                number == 144)
        << "alarm " << number;
  if (stroke.service == "recorder") {
    rig_.drop_recorder();
    return;
  }
  if (!seen.stopped) {
    rig_.reset_alarms();  // it had ended before the loss was known
    return;
  }
  if (rig_.go_on() == Way::begin_again) {
    ASSERT_NO_FATAL_FAILURE(expect_on_path(false));
    rig_.go_home();
    rig_.begin(), ++begun_;
    begin_again_ = true;
  }
}

void Soak::one_program() {
  if (draw(4) == 0) {
    const auto stroke = draw_stroke(0);
    ASSERT_NO_FATAL_FAILURE(strike(stroke));
    rig_.await(stroke.service, stroke.fault, false);
    if (stroke.service == "recorder") rig_.drop_recorder();
    rig_.reset_alarms();
  }
  rig_.begin(), ++begun_;
  unsigned line = first_line;
  for (auto left = 1 + draw(3); left > 0 && line < last_line; --left) {
    const auto stroke = draw_stroke(line);
    line = stroke.line + 1;
    ASSERT_NO_FATAL_FAILURE(strike_in_motion(stroke));
    if (std::exchange(begin_again_, false)) line = first_line;
  }
  ASSERT_TRUE(rig_.finish()) << rig_.cluster().told();
  ++finished_;
  ASSERT_NO_FATAL_FAILURE(expect_on_path(true));
  EXPECT_EQ(rig_.kept_variable(501), begun_) << "each program begun has counted once";
  rig_.check_keepsakes();
}

void Soak::run(double seconds) {
  const double end = service::monotonic_seconds() + seconds;
  ASSERT_NO_FATAL_FAILURE(prepare());
  while (service::monotonic_seconds() < end && !testing::Test::HasFailure())
    ASSERT_NO_FATAL_FAILURE(one_program()) << "after the last stroke";
  std::printf(
      "%d faults, %.0f programs finished of %.0f begun, largest deviation from the path %.6f mm, %.0f cycles "
      "unseen\n",
      strokes_, finished_, begun_, largest_, unseen_);
}

TEST(FaultSoak, NothingIsLostAndNoPositionIsWrong) {
  const auto seed = static_cast<std::uint64_t>(number_from("TRUNNION_SOAK_SEED", 1));
  const double seconds = number_from("TRUNNION_SOAK_SECONDS", 20);
  Soak soak(seed);
  soak.run(seconds);
  if (HasFailure())
    std::printf("seed %llu, faults:\n%s", static_cast<unsigned long long>(seed), soak.history().c_str());
}

}  // namespace
}  // namespace trunnion::integration

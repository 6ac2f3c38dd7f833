// SPDX-License-Identifier: Apache-2.0
// The blocks RTC and PID_CONTROL.
#include <algorithm>
#include <cmath>
#include <random>

#include "translated.hpp"

namespace trunnion::st {
namespace {

constexpr std::int64_t second = 1000000000;  // ns

TEST(Clock, BeginsWithEachRisingEdgeAndCountsTheTimeOfThePlc) {
  Translated program("VAR on : BOOL; clock : RTC; END_VAR",
                     "clock(IN := on, PDT := DT#2026-02-28-23:59:58);");
  std::string shown;
  for (const char c : std::string("0111011")) {
    program.set("on", std::string(1, c));
    ASSERT_EQ(program.scan(second), "");
    EXPECT_EQ(program.get("clock.Q"), c == '1' ? "TRUE" : "FALSE");
    shown += program.get("clock.CDT").substr(14) + " ";
  }
  // Kept while IN is FALSE; 2026 is no leap year.
  EXPECT_EQ(shown, "00:00:00 23:59:58 23:59:59 00:00:00 00:00:00 23:59:58 23:59:59 ");
  EXPECT_EQ(program.get("clock.CDT").substr(0, 14), "DT#2026-02-28-");
}

class Controller {
 public:
  explicit Controller(const std::string& parameters)
      : program_("VAR c : PID_CONTROL := (" + parameters + "); on : BOOL; sp, pv, manual : LREAL; END_VAR",
                 "c(AUTO := on, SP := sp, PV := pv, MANUAL := manual);") {}
  void set(const std::string& name, double value) {
    std::ostringstream text;
    text.precision(17);
    text << std::showpoint << value;
    program_.set(name, text.str());
  }
  void automatic(bool on) { program_.set("on", on ? "TRUE" : "FALSE"); }
  /// OUT after a scan, 10 ms later.
  double scan(std::int64_t period = 10000000) {
    EXPECT_EQ(program_.scan(period), "");
    return std::stod(program_.get("c.OUT"));
  }
  bool is(const std::string& flag) { return program_.get("c." + flag) == "TRUE"; }

 private:
  Translated program_;
};

TEST(PidControl, IntegratesAConstantDeviation) {
  Controller c("KP := 2.0, TI := LT#1s");
  c.automatic(true);
  EXPECT_EQ(c.scan(), 0);
  c.set("sp", 10);
  // KP e (1 + t / TI)
  for (int k = 1; k <= 50; ++k) EXPECT_NEAR(c.scan(), 2 * 10 * (1 + k * 0.01), 1e-9) << k;
}

TEST(PidControl, DifferentiatesTheFilteredMeasurementNotTheTarget) {
  Controller c("KP := 3.0, TD := LT#1s, TF := LT#100ms, OUT_MIN := -100.0");
  c.automatic(true);
  c.scan();
  c.set("sp", 4);
  EXPECT_NEAR(c.scan(), 12, 1e-12) << "a step of the target has no derivative";
  for (int k = 1; k <= 40; ++k) {
    // PV rises by 2/s and SP with it: P stays, D goes to -KP TD 2 with the time constant TF.
    c.set("pv", 0.02 * k), c.set("sp", 4 + 0.02 * k);
    EXPECT_NEAR(c.scan(), 12 - 6 * (1 - std::pow(0.1 / 0.11, k)), 1e-9) << k;
  }
}

TEST(PidControl, DoesNotWindUpAtALimit) {
  Controller c("TI := LT#70ms");
  c.automatic(true);
  c.scan();
  c.set("sp", 10);
  for (int k = 0; k < 1000; ++k) c.scan();
  EXPECT_EQ(c.scan(), 100);
  EXPECT_TRUE(c.is("LIMITED"));
  c.set("pv", 20);
  // I was within one step, 10 * 10 ms / 70 ms = 1.43, above 90; P is -10 now, and I falls by a step.
  const auto out = c.scan();
  EXPECT_GE(out, 90 - 10 - 1.43);
  EXPECT_LE(out, 90 - 10 + 1.43);
  EXPECT_FALSE(c.is("LIMITED"));
}

TEST(PidControl, ChangesBetweenManualAndAutomaticWithoutAStep) {
  Controller c("KP := 2.0, TI := LT#1s, TD := LT#50ms");
  c.set("manual", 30), c.set("sp", 5), c.set("pv", 1);
  EXPECT_EQ(c.scan(), 30);
  c.automatic(true);
  EXPECT_NEAR(c.scan(), 30, 1e-12) << "with a deviation of 4";
  double out = 0;
  for (int k = 0; k < 100; ++k) out = c.scan();
  EXPECT_NEAR(out, 30 + 2 * 4 * 1.0, 1e-9) << "one second of the integral";
  c.automatic(false);
  EXPECT_EQ(c.scan(), out) << "MANUAL is still 30";
  c.set("pv", 3);
  EXPECT_EQ(c.scan(), out);
  c.set("manual", 20);
  EXPECT_EQ(c.scan(), 20);
  c.automatic(true);
  EXPECT_NEAR(c.scan(), 20, 1e-12);
}

TEST(PidControl, RefusesLimitsAndTimesThatAreNone) {
  for (const auto* wrong :
       {"OUT_MIN := 5.0, OUT_MAX := 5.0", "TI := LT#-1ms", "TD := LT#-1ms", "TF := LT#-1ms"}) {
    Controller c(wrong);
    c.automatic(true), c.set("sp", 7);
    EXPECT_EQ(c.scan(), 0);
    EXPECT_TRUE(c.is("ERROR")) << wrong;
  }
}

// The same controller in other words: the state is the output before P and D, and the filter of D is that of
// the measurement, D = -gain TD (PV - filtered PV) / TF.
struct Reference {
  double kp, ti, td, tf, low, high;
  double rest = 0, filtered = 0, out = 0, manual = 0;
  bool started = false, was_automatic = false;
  double step(bool automatic, double sp, double pv, double by, double dt) {
    if (!started)
      rest = (out = std::clamp(by, low, high)) - kp * (sp - pv), filtered = pv, manual = by, started = true;
    filtered = (tf * filtered + dt * pv) / (tf + dt);
    const double pd = kp * (sp - pv) - kp * td * (pv - filtered) / tf;
    if (!automatic) {
      if (by != manual) out = by;
      rest = (out = std::clamp(out, low, high)) - pd;
    } else if (!was_automatic) {
      out = std::clamp((rest = out - pd) + pd, low, high);
    } else {
      const double more = kp * (sp - pv) * dt / ti, before = rest + pd;
      if (!((before >= high && more > 0) || (before <= low && more < 0))) rest += more;
      out = std::clamp(rest + pd, low, high);
    }
    manual = by, was_automatic = automatic;
    return out;
  }
};

TEST(PidControl, FollowsAnIndependentComputationForRandomInputs) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> one(-1, 1);
    Controller c(
        "KP := 1.5, TI := LT#300ms, TD := LT#80ms, TF := LT#20ms, OUT_MIN := -20.0, OUT_MAX := 25.0");
    Reference reference{1.5, 0.3, 0.08, 0.02, -20, 25};
    double sp = 0, pv = 0, manual = 3;
    bool automatic = false;
    for (int k = 0; k < 400; ++k) {
      if (random() % 40 == 0) sp = 10 * one(random);
      if (random() % 60 == 0) automatic = !automatic;
      if (random() % 30 == 0) manual = 30 * one(random);
      pv += 0.3 * one(random);
      c.automatic(automatic), c.set("sp", sp), c.set("pv", pv), c.set("manual", manual);
      const auto ms = k == 0 ? 0 : 1 + static_cast<int>(random() % 20);
      ASSERT_NEAR(c.scan(ms * 1000000), reference.step(automatic, sp, pv, manual, ms * 1e-3), 1e-8)
          << "seed " << seed << " scan " << k;
    }
  }
}

}  // namespace
}  // namespace trunnion::st

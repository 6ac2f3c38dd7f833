#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "../test/motion_fixture.hpp"

namespace trunnion::motion::test {
namespace {

using language::Transformation;

struct Cap {
  Limits limits = uniform_limits(300, 3000, 20);
  geometry::Chain chain = ac_table();
  AxisValues start{};
  std::vector<Command> program;
};

// A wavy cap of five axes in short segments, as a CAM system writes it.
Cap wavy_cap(int segments, double feed) {
  Cap cap;
  for (std::size_t i = 3; i < 6; ++i) cap.limits.axes[i] = {100, 200, 600};
  for (int i = 0; i <= segments; ++i) {
    const double f = i * 2 * std::numbers::pi / 1000;
    AxisValues p{30 * std::cos(f) + 5, 30 * std::sin(f) - 4, 2 * std::sin(6 * f)};
    p[language::A] = 20 + 8 * std::sin(6 * f);
    p[language::C] = 0.36 * i;
    if (i == 0) {
      cap.start = p;
    } else {
      cap.program.push_back(line_to(p, feed, static_cast<std::uint32_t>(i)));
    }
  }
  return cap;
}

// Setpoints per second with the planning paid beforehand: the segments are long against a cycle.
void step_rtcp_ac_table(benchmark::State& state) {
  const Cap cap = wavy_cap(2500, 1000);
  Trajectory t(cap.limits, &cap.chain, cycle);
  std::int64_t cycles = 0;
  for (auto _ : state) {
    if (t.at_rest()) {
      state.PauseTiming();
      t.start(cap.start, Transformation::rtcp, 100);
      for (const Command& c : cap.program) t.push(c);
      t.finish();
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(t.step(1, 1, false));
    ++cycles;
  }
  state.counters["setpoints"] = benchmark::Counter(static_cast<double>(cycles), benchmark::Counter::kIsRate);
}
BENCHMARK(step_rtcp_ac_table);

void plan_rtcp_ac_table(benchmark::State& state) {
  const Cap cap = wavy_cap(2500, static_cast<double>(state.range(0)));
  Trajectory t(cap.limits, &cap.chain, cycle);
  std::int64_t segments = 0;
  for (auto _ : state) {
    t.start(cap.start, Transformation::rtcp, 100);
    for (const Command& c : cap.program) t.push(c);
    t.finish();
    segments += static_cast<std::int64_t>(cap.program.size());
  }
  state.counters["segments"] = benchmark::Counter(static_cast<double>(segments), benchmark::Counter::kIsRate);
}
BENCHMARK(plan_rtcp_ac_table)->Arg(1000)->Arg(6000)->Unit(benchmark::kMillisecond);

// What is reported, not asserted: seconds of machining.
void machining_time(benchmark::State& state, const std::vector<Command>& program, const Limits& limits,
                    const geometry::Chain* chain, const AxisValues& start) {
  Trajectory t(limits, chain, cycle);
  std::size_t cycles = 0;
  for (auto _ : state) {
    t.start(start, chain != nullptr ? Transformation::rtcp : Transformation::none,
            chain != nullptr ? 100 : 0);
    cycles = run(t, program).setpoints.size();
  }
  state.counters["machining_seconds"] = static_cast<double>(cycles) * cycle;
}

void line_of_100_mm(benchmark::State& state) {  // V500 A3000, N 50: J = A / T = 60000
  machining_time(state, {line_to({100}, 30000)}, uniform_limits(500, 3000, 50), nullptr, {});
}
BENCHMARK(line_of_100_mm)->Unit(benchmark::kMillisecond);

void corner_of_50_and_50_mm(benchmark::State& state) {  // at 100 mm/s; the argument is the tolerance in um
  Limits limits = uniform_limits(500, 3000, 50);
  limits.contour_tolerance = static_cast<double>(state.range(0)) / 1000;
  machining_time(state, {line_to({50}, 6000), line_to({50, 50}, 6000)}, limits, nullptr, {});
}
BENCHMARK(corner_of_50_and_50_mm)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

void five_axis_cap_of_3000_segments(benchmark::State& state) {
  const Cap cap = wavy_cap(3000, 3000);
  machining_time(state, cap.program, cap.limits, &cap.chain, cap.start);
}
BENCHMARK(five_axis_cap_of_3000_segments)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trunnion::motion::test

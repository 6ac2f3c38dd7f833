// SPDX-License-Identifier: Apache-2.0
// A touch probe measures a sphere on a whole machine: examples/probe-sphere with a truth.yaml of the test.
#include <fstream>

#include "cluster_harness.hpp"

namespace trunnion::integration {
namespace {

// The ball has 3 mm and is 150 mm from the spindle face, the sphere 25 mm; its centre is at X120 Y60 Z-330 in
// the frame of the workpiece. So the machine is at X120 Y60 Z-180 with the ball in the centre.
constexpr double centre_x = 120, centre_y = 60, centre_z = -330 + 150;
constexpr double um = 1e-3;
const std::string sphere =
    "solids:\n  - {sphere: {diameter_mm: 25, shaft_diameter_mm: 10, shaft_length_mm: 60}, "
    "position_mm: [120, 60, -330]}\n";
const std::string ideal_probe = "probe: {ball_radius_mm: 3, length_mm: 150, pre_travel_um: 5, delay_ms: 1}\n";

struct TouchProbe : ::testing::Test {
  std::string directory = std::filesystem::temp_directory_path() / "touch_probe_XXXXXX";
  std::optional<Cluster> cluster;
  std::optional<bus::Reader<idl::channel::Variables>> reader;
  idl::channel::Variables variables;

  void start(const std::string& truth) {
    namespace fs = std::filesystem;
    ASSERT_NE(mkdtemp(directory.data()), nullptr);
    const auto machine = fs::path(directory) / "machine";
    fs::copy(TRUNNION_MACHINES "/ac-table", machine, fs::copy_options::recursive);
    for (const std::string from : {"probe-sphere", "calibration/programs"})
      for (const auto& file : fs::directory_iterator(std::string(TRUNNION_EXAMPLES "/") + from))
        if (file.path().extension() == ".nc") fs::copy(file.path(), machine / "programs");
    std::ofstream(machine / "truth.yaml") << truth;
    cluster.emplace(machine.string());
    reader.emplace(cluster->client().bus().reader(topics::variables));
    EXPECT_TRUE(cluster->until([&] { return reader->take_newest(variables); }));
  }
  /// #number as the newest program has left it; nothing when it is vacant.
  std::optional<double> variable(std::uint32_t number) {
    const auto at = std::find(variables.numbers.begin(), variables.numbers.end(), number);
    if (at == variables.numbers.end()) return std::nullopt;
    return variables.values[static_cast<std::size_t>(at - variables.numbers.begin())];
  }
  bool run(const std::string& program) {
    while (reader->take_newest(variables)) {
    }
    cluster->start(program);
    if (!cluster->finish() || !cluster->active_alarms().empty()) return false;
    return cluster->until([&] { return reader->take_newest(variables); });
  }
  void expect_centre(double x, double y, double z) {
    EXPECT_NEAR(variable(500).value_or(0), x, um);
    EXPECT_NEAR(variable(501).value_or(0), y, um);
    EXPECT_NEAR(variable(502).value_or(0), z, um);
  }
  void TearDown() override {
    reader.reset();
    cluster.reset();
    std::filesystem::remove_all(directory);
  }
};

TEST_F(TouchProbe, FindsTheCentreOfASphereAndTheSameInASecondRun) {
  start(ideal_probe + sphere);
  ASSERT_TRUE(run("measure_sphere.nc")) << cluster->told();
  expect_centre(centre_x, centre_y, centre_z);
  // All touches are at F50: the ball goes 5 um and 1 ms * 50 mm/min = 0.83 um into the surface.
  const double radius = 12.5 + 3 - 5 * um - 50.0 / 60 * 0.001;
  EXPECT_NEAR(variable(503).value_or(0), radius, um);
  const auto first = variables;
  ASSERT_TRUE(run("measure_sphere.nc")) << cluster->told();
  expect_centre(centre_x, centre_y, centre_z);
  // The encoders count 10 nm, and the servos are at rest at either start.
  EXPECT_NEAR(variable(500).value_or(0), first.values[10], 0.05 * um);
}

TEST_F(TouchProbe, FindsTheCentreWhereTheTrueAxisOfTheTablePutsIt) {
  start(ideal_probe + sphere + "axes: {C: {XOC_um: 50, YOC_um: -20}}\n");
  ASSERT_TRUE(run("measure_sphere.nc")) << cluster->told();
  expect_centre(centre_x, centre_y, centre_z);
  // By half a turn about the axis at X0.05 Y-0.02.
  std::ifstream file(TRUNNION_EXAMPLES "/probe-sphere/measure_sphere.nc");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto replace = [&](const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  replace("C0\n", "C180\n");
  replace("X120.4 Y59.7", "X-120.3 Y-60.2");
  cluster->client().upload("turned.nc", text);
  ASSERT_TRUE(run("turned.nc")) << cluster->told();
  expect_centre(2 * 0.05 - centre_x, 2 * -0.02 - centre_y, centre_z);
}

TEST_F(TouchProbe, AContactOutsideASkipMoveStopsTheAxesWithTheirPosition) {
  start(ideal_probe + sphere);
  // The probe is on and G1 goes 20 mm into the sphere: touch at Z -330 + 15.5 + 150 = -164.5.
  cluster->start_text("G90 G54 G49\nG0 G53 X120 Y60\nM40\nG1 G53 Z-184.5 F600\nM30\n");
  ASSERT_TRUE(cluster->until([&] { return cluster->has_alarm(117); })) << cluster->told();
  EXPECT_TRUE(cluster->has_alarm(117, "outside a skip move at X 120.0000 mm, Y 60.0000 mm, Z -164.5"))
      << cluster->told();
  EXPECT_TRUE(cluster->until([&] { return cluster->state() == RunState::INTERRUPTED; })) << cluster->told();
  EXPECT_TRUE(cluster->until([&] { return cluster->feedback.mode == DriveMode::HELD; }));
  // 10 mm/s at 4000 mm/s2: 13 um of braking, the pre-travel, the delay's 10 um, some periods of lag.
  EXPECT_GT(cluster->feedback.position[2], -164.5 - 0.15);
  // It can be retracted: after a reset the contact that is still there does not stop it again.
  cluster->client().channel(0, CommandKind::RESET);
  cluster->reset_alarms();
  ASSERT_TRUE(cluster->until([&] {
    return cluster->state() == RunState::IDLE && cluster->active_alarms().empty();
  })) << cluster->told();
  cluster->start_text("G90 G54 G49\nG1 G53 Z-150 F600\nM41\nM30\n");
  EXPECT_TRUE(cluster->finish()) << cluster->told();
  EXPECT_EQ(cluster->active_alarms(), "");
}

TEST_F(TouchProbe, ABrokenWireStopsTheMeasurementAndWritesNothing) {
  start("probe: {ball_radius_mm: 3, length_mm: 150, no_signal_from_touch: 4}\n" + sphere);
  EXPECT_FALSE(run("measure_sphere.nc"));
  EXPECT_TRUE(cluster->until([&] { return cluster->state() == RunState::IDLE; })) << cluster->told();
  EXPECT_NE(cluster->told().find("no contact of the probe"), std::string::npos) << cluster->told();
  while (reader->take_newest(variables)) {
  }
  EXPECT_FALSE(variable(500));
}

TEST_F(TouchProbe, AnEarlySignalIsFoundByTheRadiusAndWritesNothing) {
  // Every touch is two contacts: X is right, Y and the last one from above are 0.8 mm early.
  start("probe: {ball_radius_mm: 3, length_mm: 150, early_mm: 0.8, early_from_touch: 7}\n" + sphere);
  EXPECT_FALSE(run("measure_sphere.nc"));
  EXPECT_TRUE(cluster->until([&] { return cluster->state() == RunState::IDLE; })) << cluster->told();
  EXPECT_NE(cluster->told().find("differs by more than 0.5 mm"), std::string::npos) << cluster->told();
  while (reader->take_newest(variables)) {
  }
  EXPECT_FALSE(variable(500));
}

// Where the kill finds the machine is a matter of time. Elsewhere the measurement continues; in a touch the
// new process of the drive finds the contact open, and the program stops with an alarm. No wrong centre comes
// of it.
struct KilledTouchProbe : TouchProbe, ::testing::WithParamInterface<std::vector<std::string>> {};

TEST_P(KilledTouchProbe, MeasuresTheRightCentreOrStopsWithAnAlarmAndMeasuresItAnew) {
  start(ideal_probe + sphere);
  std::uint64_t touches = 0;
  cluster->on_batch = [&](const idl::stream::Feedback& batch) { touches += batch.skips.size(); };
  cluster->start("measure_sphere.nc");
  ASSERT_TRUE(cluster->until([&] { return touches >= 4; })) << cluster->told();
  std::map<std::string, std::uint32_t> restarts;
  for (const auto& name : GetParam()) {
    restarts[name] = cluster->service(name)->restarts;
    ::kill(cluster->service(name)->pid, SIGKILL);
  }
  ASSERT_TRUE(cluster->until([&] {
    return cluster->ready() && std::all_of(restarts.begin(), restarts.end(), [&](const auto& entry) {
             return cluster->service(entry.first)->restarts > entry.second;
           });
  })) << cluster->told();
  const auto stopped = [&] {
    return cluster->has_alarm(117) || cluster->has_alarm(1119) || cluster->has_alarm(1501, "no contact") ||
           cluster->has_alarm(173);
  };
  // A channel that was killed in motion may be continued before the drive has said that its setpoints ended
  // (110), which interrupts it once more.
  EXPECT_TRUE(cluster->until([&] {
    const auto state = cluster->state();
    if ((state == RunState::INTERRUPTED || state == RunState::HELD) && !stopped()) cluster->go_on();
    return cluster->state() == RunState::IDLE || stopped();
  })) << cluster->told();
  cluster->until([] { return false; }, 0.3);
  while (reader->take_newest(variables)) {
  }
  if (variable(500))
    expect_centre(centre_x, centre_y, centre_z);
  else
    EXPECT_TRUE(stopped()) << cluster->told();
  // Begun anew it measures the same.
  ASSERT_TRUE(cluster->begin_anew()) << cluster->told();
  ASSERT_TRUE(run("measure_sphere.nc")) << cluster->told();
  expect_centre(centre_x, centre_y, centre_z);
}

// The second measurement after a restart of the drive is the second one without: the machine is as warm, and
// the probe has as many touches behind it. Noise of 5 um a touch would put any other centre elsewhere.
TEST_F(TouchProbe, AMachineIsAsWarmAfterARestartOfItsDriveAndItsProbeGoesOnWithItsNoise) {
  const std::string truth =
      "probe: {ball_radius_mm: 3, length_mm: 150, pre_travel_um: 30, repeatability_um: 5, seed: 4}\n" +
      sphere;
  std::array<std::array<double, 4>, 2> found{};
  for (const bool killed : {false, true}) {
    start(truth);
    ASSERT_TRUE(run("measure_sphere.nc")) << cluster->told();
    if (killed) {
      const auto restarts = cluster->service("drive")->restarts;
      ::kill(cluster->service("drive")->pid, SIGKILL);
      ASSERT_TRUE(cluster->until([&] {
        return cluster->ready() && cluster->service("drive")->restarts > restarts;
      })) << cluster->told();
      ASSERT_TRUE(cluster->begin_anew()) << cluster->told();
    }
    const double first = variable(500).value_or(0);
    ASSERT_TRUE(run("measure_sphere.nc")) << cluster->told();
    for (std::uint32_t i = 0; i < 4; ++i) found[killed ? 1 : 0][i] = variable(500 + i).value_or(0);
    EXPECT_GT(std::abs(found[killed ? 1 : 0][0] - first), um) << "every measurement has its own noise";
    TearDown();
    directory = std::filesystem::temp_directory_path() / "touch_probe_XXXXXX";
  }
  // The encoders count 10 nm, and the servos are at rest at either start.
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(found[0][i], found[1][i], 0.1 * um) << i;
}

INSTANTIATE_TEST_SUITE_P(Of, KilledTouchProbe,
                         ::testing::Values(std::vector<std::string>{"drive"},
                                           std::vector<std::string>{"channel"},
                                           std::vector<std::string>{"drive", "channel"}),
                         [](const auto& killed) {
                           return killed.param.size() == 2 ? std::string("both") : killed.param.front();
                         });

}  // namespace
}  // namespace trunnion::integration

// SPDX-License-Identifier: Apache-2.0
#include "calibration/manual_calibration.hpp"

#include <gmock/gmock.h>

#include "calibration/virtual_dial.hpp"
#include "geometry/random_source.hpp"
#include "true_machine.hpp"

namespace trunnion::calibration {
namespace {

// Of each kind the offsets that the manual calibrates, wrong by up to 0.4 mm; the others are zero there.
ChainParameters real_of(ManualKind kind) {
  ChainParameters p;
  switch (kind) {
    case ManualKind::ac_table:
      p.table_1 = geometry::RotaryAxis{{-1, 0, 0}, {0, 0.1028, 0}, 0};
      p.table_2 = geometry::RotaryAxis{{0, 0, -1}, {-200.3605, -190.1897, -516.0118}, 2};
      break;
    case ManualKind::bc_head:
      p.head_1 = geometry::RotaryAxis{{0, 0, 1}, {1.5, -2.5, 0}, 2};
      p.head_2 = geometry::RotaryAxis{{0, 1, 0}, {0.2, 0, 251.3}, 1};
      break;
    case ManualKind::ac_head:
      p.head_1 = geometry::RotaryAxis{{0, 0, 1}, {0.4, 0.3, 0}, 2};
      p.head_2 = geometry::RotaryAxis{{1, 0, 0}, {0, -0.7, 230}, 0};
      break;
    case ManualKind::hybrid:
      p.head_2 = geometry::RotaryAxis{{0, 1, 0}, {0.3, 0, 180}, 1};
      p.table_2 = geometry::RotaryAxis{{0, 0, -1}, {10, 20, 0}, 2};
      break;
  }
  return p;
}

ChainParameters believed(ChainParameters p, geometry::RandomSource& random) {
  const auto wrong = [&] { return 0.8 * random.uniform() - 0.4; };
  const auto kind = *manual_kind(p);
  if (kind == ManualKind::ac_table) {
    p.table_1->offset.y() += wrong();
    p.table_2->offset += Vec3(wrong(), wrong(), wrong());
  } else if (kind == ManualKind::hybrid) {
    p.head_2->offset += Vec3(wrong(), 0, wrong());
    p.table_2->offset += Vec3(wrong(), wrong(), 0);
  } else {
    p.head_1->offset += Vec3(wrong(), wrong(), 0);
    p.head_2->offset += kind == ManualKind::bc_head ? Vec3(wrong(), 0, wrong()) : Vec3(0, wrong(), wrong());
  }
  return p;
}

double largest_difference(const ChainParameters& a, const ChainParameters& b) {
  double largest = 0;
  for (const auto slot : metrology::all_slots)
    if (const auto& axis = axis_at(a, slot))
      largest = std::max(largest, (axis->offset - axis_at(b, slot)->offset).cwiseAbs().maxCoeff());
  return largest;
}

class ManualCalibration : public testing::TestWithParam<ManualKind> {};

TEST_P(ManualCalibration, TheFormulasGiveTheVectorsOfTheMachine) {
  const auto real = real_of(GetParam());
  ASSERT_EQ(manual_kind(real), GetParam());
  geometry::RandomSource random(3);
  for (const double alpha : {90.0, 40.0, 30.0}) {
    const auto model = believed(real, random);
    const TrueMachine machine(real, model);
    ManualGauges gauges;
    gauges.alpha = alpha;
    const auto readings = read_virtually(GetParam(), machine.report, model, gauges);
    // The instruments are exact; positions to 1e-10 mm divided by the sine of alpha.
    EXPECT_LT(largest_difference(chain_of_readings(GetParam(), readings, model), real), 1e-8) << alpha;
  }
}

TEST_P(ManualCalibration, TheCorrectionsOfTheNinePoseCheckGiveThemToo) {
  const auto kind = GetParam();
  const auto real = real_of(kind);
  geometry::RandomSource random(4);
  const auto model = believed(real, random);
  const TrueMachine machine(real, model);
  const Vec3 place = kind == ManualKind::ac_table ? Vec3(-140, -150, -420) : Vec3(70, 90, -300);
  const auto poses = check_poses(kind, 30);
  ASSERT_EQ(poses.size(), 9u);
  const auto before = sphere_displacements(machine.report, model, place, 120, poses);
  EXPECT_FALSE(acceptance_of(kind, before).accepted());
  const auto after = corrected(kind, before, 30, model);
  // The displacement is linear in offsets: nothing of second order remains.
  EXPECT_LT(largest_difference(after, real), 1e-8);
  const auto acceptance = acceptance_of(kind, sphere_displacements(machine.report, after, place, 120, poses));
  EXPECT_TRUE(acceptance.accepted());
  for (const auto& line : acceptance.lines) EXPECT_LT(line.value, 1e-8) << line.name;
}

INSTANTIATE_TEST_SUITE_P(Kinds, ManualCalibration,
                         testing::Values(ManualKind::ac_table, ManualKind::bc_head, ManualKind::ac_head,
                                         ManualKind::hybrid),
                         [](const auto& kind) {
                           std::string name = to_string(kind.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// The manual's SPLEN = -(Z1 + d/2) - SPOFFBx is for a touch on top; its own text touches the lowest point.
std::vector<std::string> names_in(const ManualGuide& guide) {
  std::vector<std::string> names;
  for (const auto& step : guide.steps)
    for (const auto& [name, about] : step.readings) names.push_back(name);
  for (const auto& [name, about] : guide.values) names.push_back(name);
  return names;
}

TEST(ManualCalibration, EveryLanguageHasTheSameStepsAndReadings) {
  for (const auto kind :
       {ManualKind::ac_table, ManualKind::bc_head, ManualKind::ac_head, ManualKind::hybrid}) {
    const auto& english = guide_of(kind);
    EXPECT_GE(english.steps.size(), 4u);
    for (const auto language : {GuideLanguage::german, GuideLanguage::chinese}) {
      const auto& other = guide_of(kind, language);
      EXPECT_NE(other.title, english.title);
      EXPECT_EQ(other.checks.size(), english.checks.size());
      EXPECT_EQ(other.steps.size(), english.steps.size());
      EXPECT_EQ(names_in(other), names_in(english));
      EXPECT_EQ(other.optional, english.optional);
    }
  }
}

TEST(ManualFormula, TheHeadLengthTakesTheArborsRadiusOffWhenTheArborIsTouchedFromBelow) {
  const auto real = real_of(ManualKind::bc_head);
  const TrueMachine machine(real, real);
  const auto r = read_virtually(ManualKind::bc_head, machine.report, real, {});
  const double d = r.at("arbor_diameter"), x = r.at("b_z1") / 2;
  EXPECT_NEAR(-(r.at("length_z1") - d / 2) - x, 251.3, 1e-8);
  EXPECT_NEAR(-(r.at("length_z1") + d / 2) - x, 251.3 - d, 1e-8) << "as printed";
}

TEST(ManualFormula, ATableThatSwingsLessThan90DegreesDividesByTwoSines) {
  const auto real = real_of(ManualKind::ac_table);
  const TrueMachine machine(real, real);
  ManualGauges gauges;
  gauges.alpha = 40;
  const auto r = read_virtually(ManualKind::ac_table, machine.report, real, gauges);
  EXPECT_NEAR(r.at("offy_z1") / (2 * std::sin(40 * M_PI / 180)), 0.1028, 1e-8);
  EXPECT_NEAR(r.at("offy_z1") / 2, 0.1028 * std::sin(40 * M_PI / 180), 1e-8) << "as printed: 36 % less";
}

TEST(ManualReadings, EveryFaultIsOneLineWithItsPlace) {
  const auto fault = [](const std::string& text) {
    try {
      parse_readings(text, "r.yaml", ManualKind::bc_head);
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string("taken");
  };
  const std::string good = "b_z1: 0.4\nc_x1: -3.4\nc_y1: 5\nlength_z1: -236.5\narbor_diameter: 30\n";
  EXPECT_EQ(fault(good), "taken");
  EXPECT_THAT(fault(good + "x1: 3"),
              testing::StartsWith("r.yaml:6:1: error: unknown key 'x1'; the keys are b_z1"));
  EXPECT_THAT(fault("b_z1: wide\n"), testing::StartsWith("r.yaml:1:7: error: 'wide' is not a number"));
  EXPECT_THAT(fault("b_z1: 1\n"), testing::HasSubstr("c_x1 is missing"));
  EXPECT_THAT(fault(good + "arbor_diameter: 0"), testing::HasSubstr("there twice"));
  EXPECT_THAT(fault("arbor_diameter: 0\n"), testing::HasSubstr("0 is not within 0.001 .. 1000"));
}

TEST(ManualReadings, DisplacementsAreNineLines) {
  const auto fault = [](const std::string& text) {
    try {
      parse_displacements(text, "d.txt");
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string("taken");
  };
  std::string nine;
  for (int i = 0; i < 9; ++i) nine += "0.01 +0.02 -3e-3 # pose\n";
  EXPECT_EQ(fault("# x y z\n\n" + nine), "taken");
  EXPECT_EQ(fault(nine + "0 0 0\n"), "d.txt:10:1: error: more than the nine poses of the check");
  EXPECT_EQ(fault("0 0 0\n"), "d.txt:1:1: error: 1 displacements, the check has nine poses");
  EXPECT_EQ(fault("0 0\n"), "d.txt:1:1: error: expected x y z in mm");
  EXPECT_EQ(fault("0 q 0\n"), "d.txt:1:3: error: 'q' is not a displacement within -100 .. 100 mm");
}

// Swung about X, a surface across X stays where it is; every other one moves.
TEST(ManualGuide, ARotaryAxisIsCheckedOnASurfaceAcrossIt) {
  const std::map<char, std::string> across{{'A', "YZ"}, {'B', "XZ"}, {'C', "XY"}};
  for (const auto kind :
       {ManualKind::ac_table, ManualKind::bc_head, ManualKind::ac_head, ManualKind::hybrid}) {
    for (const auto language : {GuideLanguage::english, GuideLanguage::german, GuideLanguage::chinese}) {
      for (const auto& check : guide_of(kind, language).checks) {
        for (const char* plane : {"XY", "XZ", "YZ"}) {
          const bool other = check.find(plane) != std::string::npos && across.at(check.front()) != plane;
          EXPECT_FALSE(other) << check;
        }
      }
    }
  }
}

TEST(ManualGuide, HasStepsWithReadingsForEveryKind) {
  for (const auto kind :
       {ManualKind::ac_table, ManualKind::bc_head, ManualKind::ac_head, ManualKind::hybrid}) {
    const auto& guide = guide_of(kind);
    EXPECT_GE(guide.steps.size(), 4u);
    EXPECT_GE(guide.checks.size(), 6u);
    const auto real = real_of(kind);
    const auto readings = read_virtually(kind, TrueMachine(real, real).report, real, {});
    std::size_t named = guide.values.size();
    for (const auto& step : guide.steps) {
      named += step.readings.size();
      for (const auto& [name, about] : step.readings) EXPECT_TRUE(readings.contains(name)) << name;
    }
    EXPECT_EQ(readings.size(), named);
  }
}

}  // namespace
}  // namespace trunnion::calibration

// Input nobody should write. Cases that are short text are in golden/alarms.nc.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;

TEST(BadInput, ALoneCarriageReturnEndsALine) {
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, "G0 X1\rX2\rM30\r")), ElementsAre("rapid X1", "rapid X2", "end 30"));
}

TEST(BadInput, BytesThatAreNoUtf8AreAnAlarmButInComments) {
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, "G0 X1\nX2 \xff\n")), ElementsAre("rapid X1", "alarm 1002 2:4"));
  EXPECT_THAT(stream(run(machine, "G0 X1 (\xd6\xd0)\n")), ElementsAre("rapid X1", "end 0"));
}

TEST(BadInput, ALineOfAMegabyteIsAnAlarmWhateverIsInIt) {
  TestMachine machine;
  for (const char filling : {' ', 'X', '(', '1', '\xff'}) {
    const std::string line(std::size_t{1} << 20, filling);
    EXPECT_THAT(stream(run(machine, "G0 X1\n" + line + "\nX2\n")), ElementsAre("rapid X1", "alarm 1001 2:1"));
  }
}

TEST(BadInput, NumbersBeyondAllMeasureAreAlarmsAndNeverInfinite) {
  TestMachine machine;
  const std::string digits(300, '9');
  EXPECT_EQ(run(machine, "G0 X" + digits + "\n").alarm.number, AlarmNumber::number_range);
  EXPECT_EQ(run(machine, "#1=" + digits + digits + "\n").alarm.number, AlarmNumber::number_range);
  EXPECT_EQ(run(machine, "G0 X[POW[10,300]]\n").alarm.number, AlarmNumber::number_range);
  EXPECT_EQ(run(machine, "#1=POW[10,300]*POW[10,300]\n").alarm.number, AlarmNumber::result_too_large);
  // E is a letter, not an exponent.
  EXPECT_EQ(run(machine, "G0 X1e300\n").alarm.number, AlarmNumber::unused_word);
}

}  // namespace
}  // namespace trunnion::language::test

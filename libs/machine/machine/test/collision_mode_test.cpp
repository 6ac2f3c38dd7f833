// SPDX-License-Identifier: Apache-2.0
#include "machine/collision_mode.hpp"

#include <gtest/gtest.h>

#include "machine/yaml.hpp"

namespace trunnion::machine::collision_mode_test {
namespace {

CollisionMode read(const std::string& text) {
  return read_collision_mode(parse_yaml(text, "machine.yaml"), "machine.yaml");
}

TEST(CollisionMode, IsOffUnlessMachineYamlSaysOtherwise) {
  EXPECT_EQ(read("name: mill"), CollisionMode::off);
  EXPECT_EQ(read("collision: off"), CollisionMode::off);
  EXPECT_EQ(read("collision: warn"), CollisionMode::warn);
  EXPECT_EQ(read("collision: stop"), CollisionMode::stop);
}

TEST(CollisionMode, AnotherWordIsAnErrorWithItsPlace) {
  for (const char* text : {"collision: on", "collision: [stop]", "collision: {stop: on}", "collision:"}) try {
      read(text);
      ADD_FAILURE() << text;
    } catch (const std::runtime_error& e) {
      EXPECT_EQ(std::string(e.what()).rfind("machine.yaml:1:", 0), 0u) << e.what();
    }
}

}  // namespace
}  // namespace trunnion::machine::collision_mode_test

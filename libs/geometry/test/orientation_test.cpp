#include "geometry/orientation.hpp"

#include <gtest/gtest.h>
TEST(x, y) {}

// SPDX-License-Identifier: Apache-2.0
#pragma once

/// One degree.
constexpr double radians = 3.14159265358979323846 / 180;

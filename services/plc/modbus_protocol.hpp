// SPDX-License-Identifier: Apache-2.0
// libmodbus without its macros, which are names of ours.
#pragma once

#include <modbus/modbus.h>

#undef ON
#undef OFF
#undef TRUE
#undef FALSE

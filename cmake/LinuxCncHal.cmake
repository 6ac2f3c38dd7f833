# SPDX-License-Identifier: Apache-2.0
# LinuxCNC's HAL: LINUXCNC_INCLUDE, LINUXCNC_HAL, LINUXCNC_HALCMD, and LINUXCNC_HAL_IS_HERE when all of them are.
find_path(LINUXCNC_INCLUDE hal.h PATH_SUFFIXES linuxcnc)
find_library(LINUXCNC_HAL linuxcnchal)
find_program(LINUXCNC_HALCMD halcmd)
if(LINUXCNC_INCLUDE AND LINUXCNC_HAL AND LINUXCNC_HALCMD)
  set(LINUXCNC_HAL_IS_HERE ON)
else()
  set(LINUXCNC_HAL_IS_HERE OFF)
endif()

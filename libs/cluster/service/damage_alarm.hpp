// SPDX-License-Identifier: Apache-2.0
// Alarms about damaged files of the state directory.
#pragma once

#include <string>

#include "service/alarm_board.hpp"
#include "storage/kept_file.hpp"

namespace trunnion::service {

/// Alarm 153 when the previous generation of a file is used, 154 when nothing of it can be used; nothing
/// otherwise. It stays until the operator resets it. `part` tells the files of one service apart; `loss`
/// names their content.
void report_damage(AlarmBoard& alarms, std::uint32_t part, const std::string& path, const storage::Kept& kept,
                   const std::string& loss);

}  // namespace trunnion::service

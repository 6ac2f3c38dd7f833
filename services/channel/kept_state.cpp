// SPDX-License-Identifier: Apache-2.0
// What a channel keeps in the state directory: the program under way, what the next process takes over, and
// the macro variables.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "machine/alarm_constants.hpp"
#include "service.hpp"
#include "service/damage_alarm.hpp"
#include "storage/file.hpp"
#include "storage/kept_file.hpp"
#include "variable_message.hpp"
#include "variable_text.hpp"

namespace trunnion::channel {
namespace {
constexpr double record_seconds = 0.2;  // between two records of the executed line
}  // namespace

// A kept text of this channel; damage is an alarm. `part` tells its files apart.
std::optional<std::string> ChannelService::read_file(const std::string& file, std::uint32_t part,
                                                     const std::string& loss) {
  using storage::KeptState;
  const auto kept = storage::read_kept(file);
  service::report_damage(node_.alarms(), part, file, kept, loss);
  if (kept.state == KeptState::previous) storage::repair_kept(file, kept);
  if (kept.state == KeptState::absent || kept.state == KeptState::unusable) return std::nullopt;
  return kept.content;
}

// A file that cannot be understood is put aside and named by an alarm.
void ChannelService::put_aside(const std::string& file, const std::string& problem) {
  const auto channel = static_cast<std::uint32_t>(node_.options().channel);
  node_.alarms().raise(alarm::storage_failed, channel, problem);
  node_.alarms().release(alarm::storage_failed, channel);
  for (const auto& generation : {file, file + storage::previous_suffix})
    std::rename(generation.c_str(), (generation + storage::damaged_suffix).c_str());
}

void ChannelService::read_record() {
  const auto text = read_file(record_file_, 0, "interrupted program and its line");
  if (!text) return;
  try {
    kept_ = channel::read_record(*text, record_file_);
    core_.set_interrupted(kept_);
  } catch (const std::exception& e) {
    put_aside(record_file_, e.what());
  }
}

// The line is written now and then, the beginning and the end of a program and of a tap, and what it has
// printed, at once.
void ChannelService::keep_record() {
  const double now = service::monotonic_seconds();
  if (core_.program_under_way() == (kept_.line != 0) && core_.parts() == kept_.parts &&
      core_.tool() == kept_.tool && core_.tap() == kept_.tap && core_.printed() == kept_.printed &&
      now - kept_at_ < record_seconds)
    return;
  const auto program = core_.running_program();
  if (program == kept_) return;
  record_.put(write_record(program));
  kept_ = program;
  kept_at_ = now;
  const auto error = record_.error();
  const auto channel = static_cast<std::uint32_t>(node_.options().channel);
  if (!error.empty())
    node_.alarms().raise(alarm::storage_failed, channel, error);
  else if (record_failed_)
    node_.alarms().release(alarm::storage_failed, channel);
  record_failed_ = !error.empty();
}

// It serves one process only: one that is killed leaves none, and the drive's cut is valid then. It has a
// checksum and no generations.
void ChannelService::read_hand_over() {
  std::ifstream in(hand_over_file_, std::ios::binary);
  if (!in) return;
  std::ostringstream text;
  text << in.rdbuf();
  std::remove(hand_over_file_.c_str());
  const auto name = std::filesystem::path(hand_over_file_).filename().string();
  storage::Kept kept{storage::KeptState::unusable, "", 0, ""};
  const auto whole = storage::unseal(name, text.str(), kept.problem);
  HandOver from;
  try {
    if (whole && channel::read_hand_over(whole->content, hand_over_file_, boot_, from))
      hand_over_ = std::move(from);
  } catch (const std::exception& e) {
    kept.problem = e.what();
  }
  if (!kept.problem.empty())
    service::report_damage(node_.alarms(), 2, hand_over_file_, kept,
                           "mode, modal codes, selected program, overrides and switches");
}

void ChannelService::end() {
  if (!core_.recovered()) return;
  const auto left = core_.hand_over();
  if (!left) return;
  try {
    const auto name = std::filesystem::path(hand_over_file_).filename().string();
    storage::replace_file(hand_over_file_, storage::seal(name, 1, write_hand_over(*left, boot_)));
  } catch (const storage::StorageError& e) {
    std::fprintf(stderr, "%s\n", e.what());
  }
}

// Vacant variables are safer than wrong ones.
void ChannelService::read_variables() {
  const auto text = read_file(variables_file_, 1, "macro variables");
  auto variables = std::make_unique<language::VariableStore>();
  if (text) try {
      channel::read_variables(*text, variables_file_, boot_, *variables);
      core_.set_variables(*variables);
    } catch (const std::exception& e) {
      *variables = {};
      put_aside(variables_file_, e.what());
    }
  publish_variables(*variables);
}

void ChannelService::publish_variables(const language::VariableStore& variables) {
  variables_writer_.write(variable_message(variables, static_cast<std::uint16_t>(node_.options().channel)));
}

void ChannelService::save_variables() {
  const auto* variables = core_.take_variables();
  if (variables == nullptr) return;
  const auto channel = static_cast<std::uint32_t>(node_.options().channel);
  try {
    const auto text = write_variables(*variables, boot_);
    if (text != saved_variables_) {
      storage::write_kept(variables_file_, text);
      saved_variables_ = text;
      node_.alarms().release(alarm::storage_failed, channel);
    }
  } catch (const storage::StorageError& e) {
    node_.alarms().raise(alarm::storage_failed, channel, e.what());
  }
  publish_variables(*variables);  // what is published survives a kill
}

}  // namespace trunnion::channel

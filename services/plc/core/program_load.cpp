// SPDX-License-Identifier: Apache-2.0
#include "program_load.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "plc/source_files.hpp"
#include "text/utf8.hpp"

namespace trunnion::plc {
namespace {

constexpr std::size_t most_messages = 128, longest_message = 240;

}  // namespace

void ProgramLoad::begin() {
  end();
  phase_ = Phase::WRITING;
}

std::string ProgramLoad::write(const std::string& name, std::string_view data) {
  if (phase_ != Phase::WRITING) return "no load has started, or its sources are complete; start a load";
  if (!st::is_source(name) || name.find('/') != std::string::npos)
    return "'" + name +
           "': sources are .st files (not *_test.st), .exp and .xml files, fast.il, main.il, "
           "devices.yaml, messages.yaml and modbus.yaml";
  auto found =
      std::find_if(files_.begin(), files_.end(), [&](const auto& file) { return file.name == name; });
  if (found == files_.end()) {
    if (files_.size() == most_source_files)
      return "there are more than " + std::to_string(most_source_files) + " files";
    found = files_.insert(files_.end(), {name, ""});
  }
  if (bytes_ + data.size() > most_source_bytes)
    return "the sources have more than " + std::to_string(most_source_bytes) + " bytes";
  bytes_ += data.size();
  found->text += data;
  return "";
}

std::string ProgramLoad::start_compiling() {
  if (phase_ != Phase::WRITING) return "no load has started, or its sources are complete; start a load";
  phase_ = Phase::COMPILING;
  return "";
}

void ProgramLoad::translated(Translated result) {
  result_ = std::move(result);
  phase_ = result_.programs ? Phase::COMPILED : Phase::WITH_ERRORS;
}

std::string ProgramLoad::start_comparing(const PlcCore& running) {
  if (phase_ == Phase::WITH_ERRORS) return "the programs have errors";
  if (phase_ != Phase::COMPILED && phase_ != Phase::COMPARING) return "no programs are ready to be compared";
  comparison_ = std::make_unique<OnlineComparison>(running, programs(), change());
  phase_ = Phase::COMPARING;
  return "";
}

std::string ProgramLoad::may_take_over(bool accept_differences) const {
  if (phase_ == Phase::WITH_ERRORS) return "the programs have errors";
  if (phase_ != Phase::COMPILED && phase_ != Phase::COMPARING) return "no programs are ready to take over";
  if (accept_differences) return "";
  if (!comparison_) return "the programs have not been compared";
  if (comparison_->differences() == 0) return "";
  return std::to_string(comparison_->differences()) +
         " registers or variables differ, the running one's value first; " + comparison_->lines().front();
}

void ProgramLoad::end() {
  phase_ = Phase::NO_LOAD;
  files_.clear();
  bytes_ = 0;
  result_ = {};
  comparison_.reset();
}

idl::plc::OnlineReply ProgramLoad::status(std::uint32_t first) const {
  idl::plc::OnlineReply reply;
  reply.accepted = true;
  reply.phase = phase_;
  std::vector<std::string> all = result_.messages;
  if (comparison_) {
    reply.compared = comparison_->scans();
    reply.differences = comparison_->differences();
    all.insert(all.end(), comparison_->lines().begin(), comparison_->lines().end());
  }
  reply.total = static_cast<std::uint32_t>(all.size());
  for (std::size_t i = first; i < all.size() && reply.messages.size() < most_messages; ++i)
    reply.messages.push_back(text::shortened(all[i], longest_message));
  return reply;
}

Translated translated(const SourceFiles& files, bool simulated, const RunningSources& running) {
  Translated result;
  try {
    auto programs = translate(files, simulated);
    result.modbus = modbus_of(files);
    result.change = st::Changeover(running.variables, programs.variables);
    result.messages = programs.warnings;
    result.messages.insert(result.messages.end(), result.change.losses().begin(),
                           result.change.losses().end());
    for (auto& line : st::changes_of(running.modbus, result.modbus))
      result.messages.push_back(std::move(line));
    result.programs = std::move(programs);
  } catch (const std::runtime_error& e) {
    std::istringstream lines(e.what());
    for (std::string line; std::getline(lines, line);) result.messages.push_back(line);
  }
  return result;
}

}  // namespace trunnion::plc

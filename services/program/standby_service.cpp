// SPDX-License-Identifier: Apache-2.0
#include "standby_service.hpp"

#include <algorithm>
#include <filesystem>

#include "private_files.hpp"
#include "program_store.hpp"

namespace trunnion::program {

StandbyService::StandbyService(service::Node& node)
    : node_(node),
      programs_(node.options().state_directory + "/programs"),
      state_(node.options().state_directory),
      list_reader_(node.bus().reader(topics::program_list)) {}

void StandbyService::pump() {
  idl::program::ProgramList list;
  const bool news = list_reader_.take_newest(list);
  if (news) list_ = std::move(list);
  if (list_) clock_.poll(news, service::monotonic_seconds(), [this] { return difference(); });
}

std::string StandbyService::difference() {
  PrivateFiles programs(programs_), state(state_);
  ProgramStore own(programs, state);
  const auto delivered = node_.options().machine.programs_directory();
  if (std::filesystem::is_directory(delivered)) {
    DirectoryFiles files(delivered);
    own.install(files);
  }
  const auto& running = list_->programs;
  const auto list = own.list();
  const auto [here, there] =
      std::mismatch(running.begin(), running.end(), list.programs.begin(), list.programs.end());
  if (here != running.end() && there != list.programs.end())
    return "program " + std::min(here->name, there->name);
  if (here != running.end() || there != list.programs.end())
    return "program " + (here != running.end() ? here->name : there->name);
  return list_->revision == list.revision ? "" : "the revision of the list";
}

}  // namespace trunnion::program

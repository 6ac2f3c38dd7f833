// SPDX-License-Identifier: Apache-2.0
#include "loaded_programs.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "bus/json.hpp"
#include "storage/file.hpp"

namespace trunnion::plc {
namespace {

bus::Json json_of(const SourceFiles& files) {
  auto json = bus::Json::array();
  for (const auto& file : files) json.push_back({{"name", file.name}, {"text", file.text}});
  return json;
}

SourceFiles files_of(const bus::Json& json) {
  SourceFiles files;
  for (const auto& file : json)
    files.push_back({file.at("name").get<std::string>(), file.at("text").get<std::string>()});
  return files;
}

}  // namespace

std::optional<StoredPrograms> LoadedPrograms::load(storage::Kept& found) const {
  found = storage::read_kept(path_);
  if (found.content.empty()) return std::nullopt;
  try {
    const auto json = bus::Json::parse(found.content);
    return StoredPrograms{json.at("boot").get<std::string>(), json.at("delivered").get<std::uint32_t>(),
                          json.at("changes").get<std::uint32_t>(), files_of(json.at("active")),
                          files_of(json.at("previous"))};
  } catch (const bus::Json::exception& e) {
    found.state = storage::KeptState::unusable;
    found.problem = e.what();
    return std::nullopt;
  }
}

void LoadedPrograms::prepare(const StoredPrograms& programs) const {
  const bus::Json json = {{"boot", programs.boot},
                          {"delivered", programs.delivered},
                          {"changes", programs.changes},
                          {"active", json_of(programs.active)},
                          {"previous", json_of(programs.previous)}};
  storage::prepare_kept(path_, json.dump(1, ' ', false, bus::Json::error_handler_t::replace) + "\n");
}

void LoadedPrograms::publish() const { storage::publish_kept(path_); }

void LoadedPrograms::synchronize() const {
  storage::sync_directory(std::filesystem::path(path_).parent_path().string());
}

void LoadedPrograms::discard() const { storage::discard_kept(path_); }

}  // namespace trunnion::plc

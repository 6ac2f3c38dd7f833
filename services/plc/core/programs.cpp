// SPDX-License-Identifier: Apache-2.0
#include "programs.hpp"

#include <algorithm>

#include "storage/crc32.hpp"

namespace trunnion::plc {

std::uint32_t crc32_of(SourceFiles files) {
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  std::string all;
  for (const auto& file : files)
    all += file.name + '\0' + std::to_string(file.text.size()) + '\0' + file.text;
  return storage::crc32(all);
}

Programs translate(SourceFiles files, bool simulated, const std::string& directory) {
  auto made = st::translate_sources(std::move(files), simulated, directory);
  return {StructuredText({made.code, made.layout, made.entries}),
          std::move(made.switches),
          std::move(made.messages),
          std::move(made.variables),
          std::move(made.uses),
          std::move(made.warnings)};
}

}  // namespace trunnion::plc

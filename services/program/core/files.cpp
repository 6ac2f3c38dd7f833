// SPDX-License-Identifier: Apache-2.0
#include "files.hpp"

#include <algorithm>

namespace trunnion::program {

storage::Kept Files::read_kept(const std::string& name) {
  const auto names = list();
  if (std::find(names.begin(), names.end(), name) == names.end()) return {};
  storage::Kept kept{storage::KeptState::good, "", 0, ""};
  std::vector<std::uint8_t> piece(65536);
  for (std::size_t n = piece.size(); n == piece.size();) {
    n = read(name, kept.content.size(), piece);
    kept.content.append(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(n));
  }
  return kept;
}

void Files::write_kept(const std::string& name, const std::string& text) {
  const auto fresh = name + ".new";
  create(fresh);
  append(fresh, 0, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  publish(fresh, name);
}

}  // namespace trunnion::program

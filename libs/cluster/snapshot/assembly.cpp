// SPDX-License-Identifier: Apache-2.0
#include "snapshot/assembly.hpp"

#include <algorithm>

#include "storage/crc32.hpp"

namespace trunnion::snapshot {
namespace {
constexpr std::size_t most_bytes = 60000;  // of `state`, as in idl/service.idl
}

std::vector<ServiceSnapshot> parts_of(const ServiceSnapshot& head, const std::string& state) {
  const auto parts = std::max<std::size_t>(1, (state.size() + most_bytes - 1) / most_bytes);
  const auto crc = storage::crc32(state);
  std::vector<ServiceSnapshot> result(parts, head);
  for (std::size_t i = 0; i < parts; ++i) {
    auto& part = result[i];
    if (i > 0) part.taken.clear();
    part.part = static_cast<std::uint32_t>(i);
    part.parts = static_cast<std::uint32_t>(parts);
    part.crc32 = crc;
    const auto piece = std::string_view(state).substr(i * most_bytes, most_bytes);
    part.state.assign(piece.begin(), piece.end());
  }
  return result;
}

std::optional<Snapshot> Assembly::add(const ServiceSnapshot& part) {
  if (part.part == 0) {
    snapshot_.head = part;
    snapshot_.head.state.clear();
    snapshot_.state.clear();
    next_ = 0;
  }
  if (part.part != next_ || part.number != snapshot_.head.number || part.pid != snapshot_.head.pid)
    return std::nullopt;
  snapshot_.state.append(part.state.begin(), part.state.end());
  if (++next_ < part.parts || storage::crc32(snapshot_.state) != part.crc32) return std::nullopt;
  return snapshot_;
}

}  // namespace trunnion::snapshot

#include "channel_snapshot.hpp"

#include <algorithm>

#include "stream/stage_core.hpp"

namespace trunnion::channel {
namespace {
enum Index {
  running,
  crc,
  revision,
  sequence,
  fraction,
  line,
  transformation,
  tool_length,
  tool,
  position,
  start = position + 9,
  offset_on = start + 9,
  offset,
  dry_run = offset + 9,
  auxiliary_lock,
  block_skip,
  size  // then the results of the skip moves
};
constexpr std::size_t skip_values = 18, most_skips = 24;  // of the 512 values a state may have
}  // namespace

void store(const ChannelSnapshot& s, const std::vector<SkipResult>& skips, std::vector<double>& v) {
  v.resize(size);
  v[running] = s.running ? 1 : 0;
  v[crc] = s.crc;
  v[revision] = static_cast<double>(s.revision);
  v[sequence] = s.sequence;
  v[fraction] = s.fraction;
  v[line] = s.line;
  v[transformation] = s.transformation == language::Transformation::rtcp ? 1 : 0;
  v[tool_length] = s.tool_length;
  v[tool] = s.tool;
  std::copy(s.position.begin(), s.position.end(), v.begin() + position);
  std::copy(s.start.begin(), s.start.end(), v.begin() + start);
  v[offset_on] = s.offset_on ? 1 : 0;
  std::copy(s.offset.begin(), s.offset.end(), v.begin() + offset);
  v[dry_run] = s.dry_run ? 1 : 0;
  v[auxiliary_lock] = s.auxiliary_lock ? 1 : 0;
  v[block_skip] = s.block_skip;
  if (skips.size() > most_skips) return;
  for (const auto& skip : skips) {
    v.insert(v.end(), skip.stopped.begin(), skip.stopped.end());
    v.insert(v.end(), skip.touched.begin(), skip.touched.end());
  }
}

std::optional<ChannelSnapshot> snapshot_of(const std::vector<idl::stream::StageState>& states) {
  const auto* own = stream::find_state(states, stream::stage_channel);
  if (own == nullptr || own->values.size() < size) return std::nullopt;
  const auto& v = own->values;
  ChannelSnapshot s;
  s.running = v[running] != 0;
  s.crc = static_cast<std::uint32_t>(v[crc]);
  s.revision = static_cast<std::uint64_t>(v[revision]);
  s.sequence = static_cast<std::uint32_t>(v[sequence]);
  s.fraction = v[fraction];
  s.line = static_cast<std::uint32_t>(v[line]);
  s.transformation = v[transformation] != 0 ? language::Transformation::rtcp : language::Transformation::none;
  s.tool_length = v[tool_length];
  s.tool = static_cast<std::uint32_t>(v[tool]);
  std::copy_n(v.begin() + position, 9, s.position.begin());
  std::copy_n(v.begin() + start, 9, s.start.begin());
  s.offset_on = v[offset_on] != 0;
  std::copy_n(v.begin() + offset, 9, s.offset.begin());
  s.dry_run = v[dry_run] != 0;
  s.auxiliary_lock = v[auxiliary_lock] != 0;
  s.block_skip = static_cast<std::uint16_t>(v[block_skip]);
  s.skips.resize((v.size() - size) / skip_values);
  auto from = v.begin() + size;
  for (auto& skip : s.skips) {
    std::copy_n(from, 9, skip.stopped.begin());
    std::copy_n(from + 9, 9, skip.touched.begin());
    from += skip_values;
  }
  return s;
}

}  // namespace trunnion::channel

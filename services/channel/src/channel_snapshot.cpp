#include "channel_snapshot.hpp"

#include <algorithm>
#include <bit>

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
  size  // then, behind skip moves, a bit for each axis they concern, and of those axes what each move gave
};
constexpr std::size_t most_values = 512;  // a state may have

// The others are 0 in every result, as those a channel does not have always are.
std::uint16_t axes_of(const std::vector<SkipResult>& skips) {
  std::uint16_t axes = 0;
  for (const auto& skip : skips)
    for (std::size_t i = 0; i < skip.stopped.size(); ++i)
      if (skip.stopped[i] != 0 || skip.touched[i] != 0) axes = static_cast<std::uint16_t>(axes | 1u << i);
  return axes;
}

// Calls visit(value) for everything that is stored of the results, in its order.
template <class Skips, class Visit>
void visit_values(Skips& skips, std::uint16_t axes, Visit&& visit) {
  for (auto& skip : skips)
    for (auto* values : {&skip.stopped, &skip.touched})
      for (std::size_t i = 0; i < values->size(); ++i)
        if ((axes >> i & 1u) != 0) visit((*values)[i]);
}
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
  if (skips.empty()) return;
  // A result of nothing but zeros is one, too.
  const auto axes = std::max<std::uint16_t>(axes_of(skips), 1);
  if (size + 1 + skips.size() * 2 * static_cast<std::size_t>(std::popcount(axes)) > most_values) return;
  v.push_back(axes);
  visit_values(skips, axes, [&](double value) { v.push_back(value); });
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
  if (v.size() == size) return s;
  const auto axes = static_cast<std::uint16_t>(v[size]);
  const auto each = 2 * static_cast<std::size_t>(std::popcount(axes));
  if (each == 0) return s;
  s.skips.resize((v.size() - size - 1) / each);
  auto from = v.begin() + size + 1;
  visit_values(s.skips, axes, [&](double& value) { value = *from++; });
  return s;
}

}  // namespace trunnion::channel

// SPDX-License-Identifier: Apache-2.0
#include "channel_snapshot.hpp"

#include <algorithm>
#include <bit>

namespace trunnion::channel {
namespace {

constexpr std::size_t most_values = 234;  // of skip_stopped and of skip_touched, as in idl/stream.idl

// Those in which a result is not 0, as those a channel does not have always are.
std::uint16_t axes_of(const std::vector<SkipResult>& skips) {
  std::uint16_t axes = 0;
  for (const auto& skip : skips)
    for (std::size_t i = 0; i < skip.stopped.size(); ++i)
      if (skip.stopped[i] != 0 || skip.touched[i] != 0) axes = static_cast<std::uint16_t>(axes | 1u << i);
  return axes;
}

void store_skips(const std::vector<SkipResult>& skips, idl::stream::ChannelSnapshot& out) {
  out.skip_axes = 0;
  out.skip_stopped.clear();
  out.skip_touched.clear();
  if (skips.empty()) return;
  // A result of nothing but zeros is one, too.
  const auto axes = std::max<std::uint16_t>(axes_of(skips), 1);
  if (skips.size() * static_cast<std::size_t>(std::popcount(axes)) > most_values) return;
  out.skip_axes = axes;
  for (const auto& skip : skips)
    for (std::size_t i = 0; i < skip.stopped.size(); ++i) {
      if ((axes >> i & 1u) == 0) continue;
      out.skip_stopped.push_back(skip.stopped[i]);
      out.skip_touched.push_back(skip.touched[i]);
    }
}

std::vector<SkipResult> skips_of(const idl::stream::ChannelSnapshot& stored) {
  const auto width = static_cast<std::size_t>(std::popcount(stored.skip_axes));
  if (width == 0) return {};
  const auto values = std::min(stored.skip_stopped.size(), stored.skip_touched.size());
  std::vector<SkipResult> skips(values / width);
  std::size_t at = 0;
  for (auto& skip : skips)
    for (std::size_t i = 0; i < skip.stopped.size(); ++i) {
      if ((stored.skip_axes >> i & 1u) == 0) continue;
      skip.stopped[i] = stored.skip_stopped[at];
      skip.touched[i] = stored.skip_touched[at++];
    }
  return skips;
}

void store_axes(const AxisValues& values, std::vector<double>& out) {
  out.assign(values.begin(), values.end());
}

AxisValues axes_of(const std::vector<double>& stored) {
  AxisValues values{};
  std::copy_n(stored.begin(), std::min(stored.size(), values.size()), values.begin());
  return values;
}

}  // namespace

idl::stream::Transformation idl_of(language::Transformation transformation) {
  return transformation == language::Transformation::rtcp ? idl::stream::Transformation::RTCP
                                                          : idl::stream::Transformation::NO_TRANSFORMATION;
}

language::Transformation transformation_of(idl::stream::Transformation transformation) {
  return transformation == idl::stream::Transformation::RTCP ? language::Transformation::rtcp
                                                             : language::Transformation::none;
}

void store(const ChannelSnapshot& s, const std::vector<SkipResult>& skips,
           idl::stream::ChannelSnapshot& out) {
  out.valid = true;
  out.running = s.running;
  out.program_crc32 = s.crc;
  out.program_revision = s.revision;
  out.command = s.sequence;
  out.fraction = s.fraction;
  out.line = s.line;
  out.transformation = idl_of(s.transformation);
  out.tool_length = s.tool_length;
  out.tool = s.tool;
  store_axes(s.position, out.position);
  store_axes(s.start, out.start);
  out.handwheel_offset_on = s.offset_on;
  store_axes(s.offset, out.handwheel_offset);
  out.dry_run = s.dry_run;
  out.auxiliary_lock = s.auxiliary_lock;
  out.block_skip = s.block_skip;
  out.in_thread = s.in_thread;
  out.thread_origin = s.thread_origin;
  store_skips(skips, out);
}

std::optional<ChannelSnapshot> snapshot_of(const idl::stream::ChannelSnapshot& stored) {
  if (!stored.valid) return std::nullopt;
  ChannelSnapshot s;
  s.running = stored.running;
  s.crc = stored.program_crc32;
  s.revision = stored.program_revision;
  s.sequence = stored.command;
  s.fraction = stored.fraction;
  s.line = stored.line;
  s.transformation = transformation_of(stored.transformation);
  s.tool_length = stored.tool_length;
  s.tool = stored.tool;
  s.position = axes_of(stored.position);
  s.start = axes_of(stored.start);
  s.offset_on = stored.handwheel_offset_on;
  s.offset = axes_of(stored.handwheel_offset);
  s.dry_run = stored.dry_run;
  s.auxiliary_lock = stored.auxiliary_lock;
  s.block_skip = stored.block_skip;
  s.in_thread = stored.in_thread;
  s.thread_origin = stored.thread_origin;
  s.skips = skips_of(stored);
  return s;
}

}  // namespace trunnion::channel

// SPDX-License-Identifier: Apache-2.0
#include "round.hpp"

#include <type_traits>

namespace trunnion::plc {
namespace {

template <class Values>
void compare(Area area, const Values& before, const Values& after, Changes& changes) {
  for (std::size_t i = 0; i < after.size(); ++i)
    if (before[i] != after[i])
      changes.push_back({static_cast<idl::plc::RegisterArea>(area), static_cast<std::uint16_t>(i), after[i]});
}

// FNV-1a over the values: what lies between them in memory does not count.
class Digest {
 public:
  template <class T>
  void add(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_same_v<T, double>);
    const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
    for (std::size_t i = 0; i < sizeof(T); ++i) hash_ = (hash_ ^ bytes[i]) * 1099511628211u;
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037u;
};

}  // namespace

Changes changes(const Registers& before, const Registers& after) {
  Changes result;
  compare(Area::x, before.x, after.x, result);
  compare(Area::y, before.y, after.y, result);
  compare(Area::f, before.f, after.f, result);
  compare(Area::g, before.g, after.g, result);
  compare(Area::r, before.r, after.r, result);
  compare(Area::b, before.b, after.b, result);
  compare(Area::w, before.w, after.w, result);
  compare(Area::d, before.d, after.d, result);
  compare(Area::t, before.t, after.t, result);
  compare(Area::c, before.c, after.c, result);
  compare(Area::k, before.k, after.k, result);
  compare(Area::p, before.p, after.p, result);
  return result;
}

std::string register_name(const RegisterValue& value) {
  return bus::to_string(value.area) + std::to_string(value.index);
}

std::uint64_t state_digest(const PlcState& state) {
  Digest digest;
  const auto& m = state.memory;
  for (const auto& h : m.handshakes) {
    digest.add(h.state), digest.add(h.number), digest.add(h.kind), digest.add(h.code);
    digest.add(h.value), digest.add(h.cycle), digest.add(h.failed), digest.add(h.has_value);
  }
  digest.add(m.now_us), digest.add(m.scans), digest.add(m.tick);
  for (const double command : m.spindle_command) digest.add(command);
  digest.add(m.spindle_since);
  const auto& program = m.program;
  digest.add(program.layout), digest.add(program.fault), digest.add(program.cells);
  digest.add(program.main);
  for (std::uint32_t i = 0; i < program.cells; ++i) digest.add(program.values[i]);
  const auto& view = state.view;
  for (const auto& channel : view.channels)
    digest.add(channel.seen), digest.add(channel.active), digest.add(channel.resets);
  for (const double speed : view.spindle_actual) digest.add(speed);
  digest.add(view.orients), digest.add(view.oriented), digest.add(view.orient_since);
  for (const auto& spindle : view.spindles) {
    digest.add(spindle.homed), digest.add(spindle.synchronized), digest.add(spindle.releases);
    digest.add(spindle.new_angle), digest.add(spindle.reverse), digest.add(spindle.master);
    digest.add(spindle.orientation), digest.add(spindle.coupling_angle), digest.add(spindle.coupling_since);
    const auto& surface = spindle.surface;
    digest.add(surface.speed), digest.add(surface.limit), digest.add(surface.radius);
    digest.add(surface.channel), digest.add(spindle.new_surface), digest.add(spindle.surface_reached);
  }
  digest.add(view.spindles_received), digest.add(view.executed), digest.add(view.drive_seen);
  digest.add(view.stopped_waiting), digest.add(view.changed);
  return digest.value();
}

}  // namespace trunnion::plc

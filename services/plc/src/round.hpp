// One round of a running PLC for the one that is to replace it: its inputs, in their order, and the results.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "address.hpp"
#include "bus/cdr.hpp"
#include "contracts/types.hpp"

namespace trunnion::plc {

/// The calls of PlcCore that change it, and what `value` or `sample` of the step is with each.
enum class StepKind : std::uint8_t {
  parameters,  ///< the revision
  feedback,    ///< a FeedbackFrame without its rows
  channel,     ///< a ChannelState
  request,     ///< an AuxiliaryRequest
  alarms,      ///< bit 0 any, bit 1 one that stops
  panel,       ///< a PanelRequest
  reset,       ///< nothing
  give_up,     ///< nothing
  advance,     ///< the tick
};

struct Step {
  std::uint8_t kind = 0;
  std::uint64_t value = 0;
  bus::Bytes sample;
};

/// A register that a round has changed. A bit area counts its bytes.
struct RegisterValue {
  std::uint8_t area = 0;
  std::uint16_t index = 0;
  std::int32_t value = 0;
  bool operator==(const RegisterValue&) const = default;
};
using Changes = std::vector<RegisterValue>;

struct Round {
  std::uint32_t generation = 0;  ///< counts the requests for a new start
  std::uint64_t number = 0;      ///< from 0, the one that only starts
  bus::Bytes start;              ///< of number 0: the Snapshot; its layout is that of one build
  std::uint64_t revision = 0;    ///< of number 0: of the parameters
  Changes rescanned;             ///< of number 0: changes of one more scan of the main task
  std::vector<Step> steps;
  std::uint64_t tick = 0;  ///< after the round
  Changes changed;
  idl::plc::Outputs outputs;
  std::vector<idl::plc::AuxiliaryDone> done;
  std::uint64_t state = 0;  ///< state_digest() after the round
};

/// Registers of `after` that differ from `before`, area by area.
Changes changes(const Registers& before, const Registers& after);
/// R12, B7.
std::string register_name(const RegisterValue& value);
/// A number that differs when any timer, counter, edge, handshake or time differs.
std::uint64_t state_digest(const Snapshot& snapshot);
/// Identifies the layout of a snapshot's bytes.
inline constexpr std::uint64_t snapshot_layout = (std::uint64_t{1} << 32) | sizeof(Snapshot);

}  // namespace trunnion::plc

namespace trunnion::bus {

template <>
struct Fields<plc::Step> {
  static constexpr const char* name = "trunnion::plc::Step";
  static constexpr bool keyed = false;
  template <class T, class V>
  static void visit(T& t, V&& v) {
    v("kind", t.kind, 0), v("value", t.value, 0), v("sample", t.sample, 0);
  }
};
template <>
struct Fields<plc::RegisterValue> {
  static constexpr const char* name = "trunnion::plc::RegisterValue";
  static constexpr bool keyed = false;
  template <class T, class V>
  static void visit(T& t, V&& v) {
    v("area", t.area, 0), v("index", t.index, 0), v("value", t.value, 0);
  }
};
template <>
struct Fields<plc::Round> {
  static constexpr const char* name = "trunnion::plc::Round";
  static constexpr bool keyed = false;
  template <class T, class V>
  static void visit(T& t, V&& v) {
    v("generation", t.generation, 0), v("number", t.number, 0), v("start", t.start, 0);
    v("revision", t.revision, 0), v("rescanned", t.rescanned, 0), v("steps", t.steps, 0);
    v("tick", t.tick, 0), v("changed", t.changed, 0), v("outputs", t.outputs, 0);
    v("done", t.done, 0), v("state", t.state, 0);
  }
};

}  // namespace trunnion::bus

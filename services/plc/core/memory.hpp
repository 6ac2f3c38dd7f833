// SPDX-License-Identifier: Apache-2.0
// The retained state of the PLC: plain data, so that it can be in a mapped file and survive the process.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "canonical/macro_signal.hpp"
#include "contracts/types.hpp"
#include "plc/machine/machine.hpp"
#include "plc/translation.hpp"

namespace trunnion::plc {

using idl::channel::AuxiliaryKind;

inline constexpr std::size_t register_count = 512, block_register_count = 3360;
inline constexpr std::size_t channel_count = 8, spindle_count = 8;

/// The register image; idl/plc.idl defines the areas, libs/plc/plc/machine/register_area.hpp their sizes.
struct Registers {
  std::array<std::uint8_t, register_count> x{}, y{}, r{}, k{};
  std::array<std::uint16_t, block_register_count> f{}, g{};
  std::array<std::uint16_t, register_count> w{};
  std::array<std::int32_t, register_count> b{}, d{}, t{}, c{}, p{};
  bool operator==(const Registers&) const = default;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("x", self.x), visit("y", self.y), visit("r", self.r), visit("f", self.f), visit("g", self.g);
    visit("b", self.b), visit("w", self.w), visit("d", self.d), visit("t", self.t), visit("c", self.c);
    visit("k", self.k), visit("p", self.p);
  }
};

enum class HandshakeState : std::uint32_t { none, waiting, strobe, done };

/// A pending M, S, T or E of one channel.
struct Handshake {
  HandshakeState state = HandshakeState::none;
  std::uint32_t number = 0;
  AuxiliaryKind kind = AuxiliaryKind::NO_AUXILIARY;
  std::uint32_t code = 0;
  double value = 0;
  std::uint64_t cycle = 0;
  std::uint32_t failed = 0;
  std::uint32_t has_value = 0;  ///< 1: an M with an angle, an S that is a surface speed, a signal that is set
                                ///< and not read. Older files have nothing at its place

  /// An E that is no order for a spindle; when it has read a signal, `value` is the signal's.
  bool is_signal() const { return kind == AuxiliaryKind::E && canonical::is_macro_signal(code); }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("state", self.state), visit("number", self.number), visit("kind", self.kind);
    visit("code", self.code), visit("value", self.value), visit("cycle", self.cycle);
    visit("failed", self.failed);
    if (!std::is_const_v<Self> || self.has_value != 0) visit("has_value", self.has_value);
  }
};
static_assert(sizeof(Handshake) == 40, "retained files keep it");

using st::program_cells;

/// The variables of the programs and the fault that has stopped them. All zero without programs.
struct ProgramVariables {
  struct Fault {
    std::uint32_t kind = 0;  ///< st::FaultKind
    std::uint32_t task = 0, instruction = 0;
    std::uint32_t reserved = 0;  // no field
    std::int64_t value = 0, low = 0, high = 0;
    bool operator==(const Fault&) const = default;

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("kind", self.kind), visit("task", self.task), visit("instruction", self.instruction);
      visit("value", self.value), visit("low", self.low), visit("high", self.high);
    }
  };
  std::uint64_t layout = 0;    ///< identifies names, types and addresses
  std::uint64_t identity = 0;  ///< of the code
  Fault fault;
  std::uint32_t cells = 0;  ///< of `values` that are used
  std::uint32_t reserved = 0;
  st::Progress main;  ///< of the main task, which is spread over scans
  std::array<std::uint64_t, program_cells> values{};

  /// Only the cells that are used: what an assignment copies besides counts for nothing.
  void assign(const ProgramVariables& other) {
    std::memcpy(static_cast<void*>(this), &other,
                offsetof(ProgramVariables, values) + other.cells * sizeof(std::uint64_t));
  }
  bool operator==(const ProgramVariables& other) const {
    return layout == other.layout && identity == other.identity && fault == other.fault &&
           cells == other.cells && main == other.main &&
           std::equal(values.begin(), values.begin() + cells, other.values.begin());
  }
};

inline constexpr std::size_t most_forces = 64;

/// A register, a bit of one or an elementary variable that keeps a value whatever the programs write.
struct Force {
  std::uint32_t cell = 0;  ///< of the memory of the programs: below st::image_cells a register
  std::int32_t bit = -1;   ///< of a register
  std::uint64_t value = 0;
  std::uint32_t permanent = 0;  ///< 1: also after a new start of the cluster
  std::uint32_t reserved = 0;   // no field
  bool operator==(const Force&) const = default;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("cell", self.cell), visit("bit", self.bit), visit("value", self.value);
    visit("permanent", self.permanent);
  }
};

/// In the order in which they were made; one place is forced once.
struct Forces {
  std::array<Force, most_forces> values{};
  std::uint32_t count = 0;
  std::uint32_t reserved = 0;  // no field

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("values", self.values), visit("count", self.count);
  }
};

struct Memory {
  Registers registers;
  std::array<Handshake, channel_count> handshakes{};
  std::uint64_t now_us = 0;                             ///< PLC time: how long it has run, over all starts
  std::uint64_t scans = 0;                              ///< whole milliseconds of it that were scanned
  std::uint64_t tick = 0;                               ///< drive tick that belongs to now_us; 0: none yet
  std::array<double, spindle_count> spindle_command{};  ///< 1/min, signed
  std::array<std::uint64_t, spindle_count>
      spindle_since{};  ///< PLC time in ms of the last change of the command
  Forces forces;
  /// The last member: files without programs end before it. No field, the service writes the cells that
  /// are used: program.
  ProgramVariables program;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("registers", self.registers), visit("handshakes", self.handshakes);
    visit("now_us", self.now_us), visit("scans", self.scans), visit("tick", self.tick);
    visit("spindle_command", self.spindle_command), visit("spindle_since", self.spindle_since);
    visit("forces", self.forces);
  }
};
static_assert(std::is_trivially_copyable_v<Memory>);

/// A constant surface speed of a spindle.
struct SurfaceOrder {
  double speed = 0;          ///< m/min, signed; 0: none
  double limit = 0;          ///< 1/min
  double radius = 0;         ///< mm
  std::uint8_t channel = 0;  ///< whose X it follows
  bool operator==(const SurfaceOrder&) const = default;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("speed", self.speed), visit("limit", self.limit), visit("radius", self.radius);
    visit("channel", self.channel);
  }
};

/// The received state of the machine, which is not retained: a restarted process receives it again.
struct View {
  struct Channel {
    bool seen = false, active = false;
    std::uint32_t resets = 0;

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("seen", self.seen), visit("active", self.active), visit("resets", self.resets);
    }
  };
  struct Press {
    std::uint64_t client = 0, number = 0;
    bool operator==(const Press&) const = default;

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("client", self.client), visit("number", self.number);
    }
  };
  /// What the drive says of a spindle beside its speed, and what it was ordered last.
  struct Spindle {
    bool homed = false, synchronized = false;
    bool releases = false;    ///< the drive is to give up the angle of before, so that it reports the new one
    bool new_angle = false;   ///< `synchronized` may still be of the coupling of before
    bool reverse = false;     ///< of the coupling
    std::uint8_t master = 0;  ///< from 1; 0: it follows none
    std::int32_t orientation = -1;     ///< 0.01 deg, that was ordered last; -1: 10a945
    std::int32_t coupling_angle = 0;   ///< 0.01 deg
    std::uint64_t coupling_since = 0;  ///< PLC time in ms at which the coupling was ordered
    SurfaceOrder surface;              ///< in place of a speed
    bool new_surface = false;          ///< what the drive says may be of the speed of before
    bool surface_reached = false;      ///< the drive has the surface speed
    bool operator==(const Spindle&) const = default;

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("homed", self.homed), visit("synchronized", self.synchronized);
      visit("releases", self.releases), visit("new_angle", self.new_angle), visit("reverse", self.reverse);
      visit("master", self.master), visit("orientation", self.orientation);
      visit("coupling_angle", self.coupling_angle), visit("coupling_since", self.coupling_since);
      if (!std::is_const_v<Self> || self.surface != SurfaceOrder{}) {
        visit("surface", self.surface), visit("new_surface", self.new_surface);
        visit("surface_reached", self.surface_reached);
      }
    }
  };
  std::array<Channel, channel_count> channels{};
  std::array<Spindle, spindle_count> spindles{};
  std::array<Press, 8>
      presses{};  ///< of the emergency stop that were taken, the newest first; number 0: none
  std::array<double, spindle_count> spindle_actual{};     ///< 1/min
  std::uint32_t spindles_received = 0;                    ///< entries of spindle_actual
  std::array<bool, spindle_count> orients{}, oriented{};  ///< an orientation is demanded; the drive holds it
  std::array<std::uint64_t, spindle_count> orient_since{};  ///< PLC time in ms at which it was demanded
  std::uint64_t executed = 0;                               ///< cycles of the stream
  bool drive_seen = false;
  bool stopped_waiting = false;  ///< waiting for the drive's confirmation of a standstill
  bool changed = true;           ///< an input, since the image was stable
  bool press_acted =
      true;  ///< the programs have stopped the machine since the newest press, or it was released

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("channels", self.channels), visit("presses", self.presses);
    visit("spindle_actual", self.spindle_actual);
    visit("orients", self.orients), visit("oriented", self.oriented);
    visit("orient_since", self.orient_since);
    visit("spindles_received", self.spindles_received), visit("executed", self.executed);
    visit("drive_seen", self.drive_seen), visit("stopped_waiting", self.stopped_waiting);
    visit("changed", self.changed), visit("press_acted", self.press_acted);
    if (!std::is_const_v<Self> || self.spindles != std::array<Spindle, spindle_count>{})
      visit("spindles", self.spindles);
  }
};

/// Everything that determines the next step of the PLC, besides its programs and parameters.
struct PlcState {
  Memory memory;
  View view;

  /// For libs/cluster/snapshot, as in the structs above.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("memory", self.memory), visit("view", self.view);
  }
};
static_assert(std::is_trivially_copyable_v<PlcState>);
static_assert(sizeof(PlcState) <= 131072, "Round.start of idl/plc.idl has it");

}  // namespace trunnion::plc

// What one block means: modal state, position and the commands it makes. Knows neither lines nor subprograms.
#pragma once

#include <array>
#include <cstdint>

#include "language/block.hpp"
#include "language/canonical.hpp"
#include "language/codes.hpp"
#include "language/command_queue.hpp"
#include "language/environment.hpp"

namespace trunnion::language {

/// Where the program goes on after a block.
struct Flow {
  enum class Kind : std::uint8_t { next, call, go_back, end };
  Kind kind = Kind::next;
  bool to_label = false;          ///< go_back to the sequence number `subprogram`
  std::uint32_t subprogram = 0;   ///< of call
  std::uint32_t repetitions = 1;  ///< of call
  std::uint16_t offset = 0;       ///< of the M word in its line
};

/// Executes blocks one after the other. Order within a block, which is not the order of its words:
///  1. units, feed mode, F            2. S                    3. T
///  4. M that act before the motion   5. plane, distance, path control, work offset
///  6. tool length, tool tip control  7. dwell, reference return or motion
///  8. M that act after the motion    9. call, return or end
/// A block with a fault makes no command and leaves modal state and position as they were; start() comes
/// next.
///
/// Feeds: F is mm (inch) of the path of the linear axes per minute or revolution; a line of rotary axes alone
/// takes the number as degrees, in G20 too. A change of G93 G94 G95 forgets F.
class BlockExecutor {
 public:
  explicit BlockExecutor(Environment& environment) : environment_(environment) {}

  /// Begins a program at `position`, in the frame `modal.transformation` says, and fetches the tables.
  void start(const AxisValues& position, const ModalState& modal);

  /// Appends the block's commands to `out`, which must be empty; sequence numbers go on from start().
  Fault execute(const Block& block, std::uint32_t program, std::uint32_t line, CommandQueue& out, Flow& flow);

  /// Appends the end of the program; `number` as Command::number.
  void end_program(std::uint32_t number, std::uint32_t program, std::uint32_t line, CommandQueue& out);

  /// Appends message `number`, whose text is the comment of its line, and the program stop that lets it be
  /// read.
  void message(std::uint32_t number, std::uint32_t program, std::uint32_t line, CommandQueue& out);

  const ModalState& modal() const { return modal_; }
  const AxisValues& position() const { return position_; }
  void set_position(const AxisValues& position) { position_ = position; }

 private:
  struct Codes {
    std::array<std::uint16_t, group_count> tenths{};
    std::array<std::uint16_t, group_count> offsets{};
    std::uint32_t present = 0;  // bit of each Group
    bool has(Group group) const { return ((present >> static_cast<unsigned>(group)) & 1u) != 0; }
    std::uint16_t code(Group group) const { return tenths[static_cast<std::size_t>(group)]; }
    std::uint16_t offset(Group group) const { return offsets[static_cast<std::size_t>(group)]; }
  };
  struct MCodes {
    std::array<MCode, max_m_codes> codes{};
    std::array<std::uint16_t, max_m_codes> offsets{};
    std::uint8_t count = 0;
  };

  Fault collect_g(const Block& block, Codes& codes) const;
  Fault collect_m(const Block& block, MCodes& codes) const;
  Fault run(const Block& block, const Codes& codes, const MCodes& m, CommandQueue& out, Flow& flow);

  Fault set_units_and_feed(const Block& block, const Codes& codes);
  Fault select_spindle_and_tool(const Block& block, CommandQueue& out);
  void set_modal_codes(const Codes& codes);
  Fault set_tool_length(const Block& block, const Codes& codes, CommandQueue& out);
  Fault move_or_dwell(const Block& block, const Codes& codes, CommandQueue& out);
  void auxiliary(const MCodes& codes, When when, CommandQueue& out);
  Fault set_flow(const Block& block, const MCodes& codes, Flow& flow);

  Fault find_axes(const Block& block, std::uint32_t& axes) const;
  AxisValues programmed_target(const Block& block, std::uint32_t axes) const;
  Fault dwell(const Block& block, const Codes& codes, CommandQueue& out);
  Fault return_to_reference(const Block& block, const Codes& codes, CommandQueue& out);
  Fault move_in_machine_coordinates(const Block& block, const Codes& codes, CommandQueue& out);
  Fault move(const Block& block, CommandQueue& out);
  Fault move_on_arc(const Block& block, const AxisValues& target, std::uint16_t at, CommandQueue& out);
  Fault check_feed(const Block& block, std::uint16_t at) const;
  void move_straight(CommandKind kind, const AxisValues& target, CommandQueue& out);

  /// A whole number in [low, high] from a word, which counts as used.
  Fault whole_number(const Block& block, char letter, std::uint32_t low, std::uint32_t high,
                     std::uint32_t& value);
  void use(char letter) { used_ |= Block::bit(letter); }
  Command& push(CommandKind kind, CommandQueue& out);
  double length_scale() const { return modal_.metric ? 1.0 : 25.4; }

  Environment& environment_;
  ModalState modal_{};
  AxisValues position_{};
  AxisValues work_offset_{};
  double radius_deviation_ = 0;
  std::uint16_t channel_axes_ = 0;
  std::uint32_t program_ = 0;
  std::uint32_t line_ = 0;
  std::uint32_t sequence_ = 0;
  std::uint32_t used_ = 0;  // letters of the block that had a meaning so far
};

}  // namespace trunnion::language

// What one block means: modal state, position and the commands it makes. Knows neither lines nor subprograms.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "language/block.hpp"
#include "language/canonical.hpp"
#include "language/codes.hpp"
#include "language/command_queue.hpp"
#include "language/cutter_compensation.hpp"
#include "language/environment.hpp"
#include "language/hole_cycle.hpp"
#include "language/hole_pattern.hpp"
#include "language/nurbs_curve.hpp"
#include "language/offset_tables.hpp"
#include "language/program_frame.hpp"

namespace trunnion::language {

/// How much of what was before a text begins is still there.
enum class Beginning : std::uint8_t {
  program,  ///< only the modal state handed over: a program means the same whatever was before it
  line,     ///< everything but cutter radius compensation: a further line of manual data input
};

/// Where the program goes on after a block.
struct Flow {
  enum class Kind : std::uint8_t { next, call, go_back, end };
  Kind kind = Kind::next;
  bool to_label = false;          ///< go_back to the sequence number `subprogram`
  std::uint32_t subprogram = 0;   ///< of call
  std::uint32_t repetitions = 1;  ///< of call
  bool counted = false;           ///< the repetitions were given
  std::uint16_t offset = 0;       ///< of the M word in its line
};

/// Executes blocks one after the other. Order within a block, which is not the order of its words:
///  1. units, feed mode, F            2. S                    3. T
///  4. M that act before the motion   5. plane, distance, path control, work offset, polar, G98 G99, G5.1
///  6. tool length, tool tip control, cutter radius compensation, cycle off
///  7. scaling, mirror, rotation, tilted plane
///  8. dwell, table, offset, positioning, cycle or motion
///  9. M that act after the motion   10. call, return or end
/// A block with a fault makes no command and leaves modal state and position as they were; start() comes
/// next. Codes of 7 and 8 that take axis words exclude each other in one block.
///
/// A block may mean more commands than fit into a queue, or than anybody could count (a cycle with pecks, a
/// curve): busy() then asks for resume() until it is false.
///
/// Feeds: F is mm (inch) of the path of the linear axes per minute or revolution; a line of rotary axes alone
/// takes the number as degrees, in G20 too. A change of G93 G94 G95 forgets F.
class BlockExecutor {
 public:
  explicit BlockExecutor(Environment& environment) : environment_(environment) {}

  /// Begins a text at `position`, in the frame `modal.transformation` says, and fetches the tables. In a
  /// program the frames but the work offset and the tilted plane, and cycles, begin switched off; in a line
  /// `modal` must be what modal() was at the end of the line before.
  void start(const AxisValues& position, const ModalState& modal, Beginning beginning = Beginning::program);

  /// Appends the block's commands to `out`, which must be empty; sequence numbers go on from start().
  Fault execute(const Block& block, std::uint32_t program, std::uint32_t line, CommandQueue& out, Flow& flow);

  /// The last block moves the axes, or has a cycle do so.
  bool moves() const { return moves_ || activity_ != Activity::none; }

  /// The last block has more commands: resume() appends some of them to `out`, which must be empty.
  bool busy() const { return activity_ != Activity::none || draining_; }
  Fault resume(CommandQueue& out);

  /// A skip move (G31) was given out: nothing can be executed before set_position() says where it ended.
  bool needs_position() const { return needs_position_; }

  /// Appends the end of the program; `number` as Command::number.
  Fault end_program(std::uint32_t number, std::uint32_t program, std::uint32_t line, CommandQueue& out);

  /// What the last fault of a block says beyond its number; empty when that is not `number`.
  std::string_view fault_detail(AlarmNumber number) const {
    return number == detail_number_ ? std::string_view(detail_.data()) : std::string_view{};
  }

  /// Change a table as G10 does, `value` in mm or degrees in place of the old.
  Fault write_work_offset(std::uint8_t index, std::size_t axis, double value, std::uint32_t program,
                          std::uint32_t line, CommandQueue& out);
  Fault write_tool(Table table, std::uint16_t number, double value, std::uint32_t program, std::uint32_t line,
                   CommandQueue& out);

  /// Appends message `number`, whose text is the comment of its line, and the program stop that lets it be
  /// read.
  Fault message(std::uint32_t number, std::uint32_t program, std::uint32_t line, CommandQueue& out);

  const ModalState& modal() const { return modal_; }
  /// Where the last move that was read ends, in the frame of its commands. With cutter compensation this is
  /// the contour, not the centre of the tool.
  const AxisValues& position() const { return position_; }
  /// The same in program coordinates, as a word would give it: what G90 refers to.
  const AxisValues& program_position() const { return program_position_; }
  /// The same as coordinates of the machine's control point.
  AxisValues machine_position() const;
  /// The same in the workpiece frame, without rotation, scaling, mirror or tilted plane.
  AxisValues workpiece_position() const;
  void set_position(const AxisValues& position);

  const ProgramFrame& frame() const { return frame_; }
  /// That of a command, by its ModalState::frame, while no more than frames_kept others came behind it.
  /// Enough for every command that has not been taken yet.
  const ProgramFrame& frame_of(std::uint32_t number) const { return kept_[number % frames_kept]; }
  const OffsetTables& tables() const { return tables_; }

  static constexpr std::size_t frames_kept = 128;

 private:
  struct Codes {
    std::array<std::uint16_t, group_count> tenths{};
    std::array<std::uint16_t, group_count> offsets{};
    std::uint32_t present = 0;  // bit of each Group
    bool has(Group group) const { return ((present >> static_cast<unsigned>(group)) & 1u) != 0; }
    std::uint16_t code(Group group) const { return tenths[static_cast<std::size_t>(group)]; }
    std::uint16_t offset(Group group) const { return offsets[static_cast<std::size_t>(group)]; }
    bool is(Group group, std::uint16_t tenth) const { return has(group) && code(group) == tenth; }
  };
  struct MCodes {
    std::array<MCode, max_m_codes> codes{};
    std::array<std::uint16_t, max_m_codes> offsets{};
    std::uint8_t count = 0;
  };
  enum class Activity : std::uint8_t { none, holes, curve, vector };

  // The order of a block: block_executor.cpp
  Fault collect_g(const Block& block, Codes& codes) const;
  Fault collect_m(const Block& block, MCodes& codes) const;
  Fault check_numbers(const Block& block) const;
  /// A swing is due, a curve or the parameter input is open: they decide what the block may hold.
  Fault check_context(const Block& block, const Codes& codes) const;
  Fault run(const Block& block, const Codes& codes, const MCodes& m, CommandQueue& out, Flow& flow);
  Fault act(const Block& block, const Codes& codes, CommandQueue& out);
  Fault finish_block(const MCodes& m, CommandQueue& out);
  Fault auxiliary(const MCodes& codes, When when, CommandQueue& out);
  bool takes_axis_words(const Block& block, const Codes& codes, std::uint16_t& at, int& takers) const;
  Fault set_flow(const Block& block, const MCodes& codes, Flow& flow);
  Fault report_unused(const Block& block) const;

  // Modal codes: block_modal.cpp
  Fault set_units_and_feed(const Block& block, const Codes& codes);
  Fault select_spindle_and_tool(const Block& block, const Codes& codes, CommandQueue& out);
  Fault set_spindle(const Block& block, const Codes& codes, CommandQueue& out);
  Fault set_modal_codes(const Block& block, const Codes& codes);
  Fault set_plane(const Codes& codes);
  Fault set_work_offset(const Block& block, const Codes& codes);
  Fault set_path_control(const Block& block, const Codes& codes);
  Fault set_polar(const Codes& codes);
  Fault set_tool_length(const Block& block, const Codes& codes, CommandQueue& out);
  Fault change_tool_length(Transformation transformation, bool vector, std::uint16_t h, double length,
                           CommandQueue& out);
  Fault set_cutter_compensation(const Block& block, const Codes& codes);
  void read_wall(const Block& block, const AxisValues& here);

  // Frames: block_frames.cpp and block_tilt.cpp
  Fault set_frames(const Block& block, const Codes& codes, CommandQueue& out);
  Fault set_scaling(const Block& block, const Codes& codes);
  Fault set_mirror(const Block& block, const Codes& codes);
  Fault set_rotation(const Block& block, const Codes& codes);
  Fault set_local_offset(const Block& block, const Codes& codes);
  Fault shift_coordinates(const Block& block, const Codes& codes);
  Fault clear_shift(const Codes& codes);
  Fault set_tilt(const Block& block, const Codes& codes, CommandQueue& out);
  Fault clear_rotation(std::uint16_t at, CommandQueue& out);
  Fault swing(const Codes& codes, CommandQueue& out);
  Fault move_along_tool(const Block& block, const Codes& codes, CommandQueue& out);
  Vector3 tool_direction() const;

  // Tables: block_tables.cpp
  Fault change_table(const Block& block, const Codes& codes, CommandQueue& out);
  Fault change_work_offset(const Block& block, const Codes& codes, std::uint32_t l, CommandQueue& out);
  Fault change_tool(const Block& block, const Codes& codes, std::uint32_t l, CommandQueue& out);
  void store_work_offset(std::uint8_t index, const AxisValues& values, CommandQueue& out);
  Fault store_tool(Table table, std::uint16_t number, double value, bool adds, std::uint16_t at,
                   CommandQueue& out);
  Fault define_tool(const Block& block, std::uint16_t at, CommandQueue& out);
  Fault change_parameter(const Block& block, char number_letter, CommandQueue& out);

  // Positioning and dwell: block_positioning.cpp
  Fault dwell(const Block& block, const Codes& codes, CommandQueue& out);
  Fault return_to_reference(const Block& block, const Codes& codes, CommandQueue& out);
  Fault return_from_reference(const Block& block, const Codes& codes, CommandQueue& out);
  Fault move_in_machine_coordinates(const Block& block, const Codes& codes, CommandQueue& out);
  Fault approach_from_one_side(const Block& block, const Codes& codes, CommandQueue& out);
  Fault move_until_skip(const Block& block, const Codes& codes, CommandQueue& out);

  // Motion: block_motion.cpp
  Fault find_axes(const Block& block, std::uint32_t& axes) const;
  /// The axes named, at least one, all of them used.
  Fault take_axes(const Block& block, std::uint16_t at, std::uint32_t& axes);
  double axis_word(const Block& block, std::size_t axis) const;
  AxisValues programmed_target(const Block& block, std::uint32_t axes);
  void apply_polar(const Block& block, std::uint32_t axes, AxisValues& target);
  Fault move(const Block& block, CommandQueue& out);
  Fault find_arc(const Block& block, const AxisValues& target, std::uint16_t at, Arc& arc);
  /// `arc` in contour coordinates.
  Fault move_on_arc(const Arc& arc, const AxisValues& target, CommandQueue& out);
  Fault set_turns(const Block& block, const AxisValues& target, std::uint16_t at, Arc& arc);
  Fault read_tool_vector(const Block& block, std::optional<Vector3>& direction, std::uint16_t& at);
  Fault point_tool(const Vector3& direction, std::uint16_t at, AxisValues& target);
  Fault lead_tool(CommandKind kind, const Arc& arc, const Vector3& direction, std::uint16_t at,
                  const AxisValues& end, CommandQueue& out);
  Fault next_vector_piece(CommandQueue& out);
  Fault refuse_orientation(const Vector3& direction, std::uint16_t at);
  Fault refuse_direction(AlarmNumber number, const Vector3& nearest, std::uint16_t at);
  Fault check_feed(const Block& block, std::uint16_t at) const;
  Fault start_curve(const Block& block, const Codes& codes);
  Fault continue_curve(const Block& block);
  Fault add_curve_block(const Block& block);
  /// Moves the axes to `program` (program coordinates) or `command` (frame of the commands), unless they are
  /// there already.
  Fault move_straight(CommandKind kind, const AxisValues& program, CommandQueue& out);
  Fault move_straight_in_command_frame(CommandKind kind, const AxisValues& command, CommandQueue& out);
  bool moves_to(const AxisValues& command, bool& linear) const;
  /// Hands a move to `program` to the compensation.
  Fault push_move(const Command& move, const AxisValues& program);

  // Cycles: block_cycles.cpp
  Fault run_cycle(const Block& block, const Codes& codes, CommandQueue& out);
  Fault read_cycle_words(const Block& block, const Codes& codes);
  Fault check_cycle(std::uint16_t at) const;
  Fault run_pattern(const Block& block, const Codes& codes, CommandQueue& out);
  Fault begin_holes(CommandQueue& out);
  void turn_spindle_again(const MCodes& codes, CommandQueue& out);
  Fault next_hole_step(CommandQueue& out);
  Fault hole_step(const HoleStep& step, CommandQueue& out);

  /// A whole number in [low, high] from a word, which counts as used.
  Fault whole_number(const Block& block, char letter, std::uint32_t low, std::uint32_t high,
                     std::uint32_t& value);
  void use(char letter) { used_ |= Block::bit(letter); }
  /// The word in mm, 0 when absent; counts as used.
  double length_word(const Block& block, char letter);
  Fault refuse_in_compensation(std::uint16_t at) const;
  // Output: block_output.cpp
  Command& push(CommandKind kind, CommandQueue& out);
  /// The state of a command that is made now; its frame is kept.
  ModalState command_modal();
  Fault push_end(std::uint32_t number, CommandQueue& out);
  /// The end of what pushed commands outside a block.
  Fault settle(CommandQueue& out);
  Fault drain_compensation(CommandQueue& out);
  void to_command_frame(Command& command) const;
  /// Makes program coordinates of a position in the frame of the commands, after a change of frames.
  void locate(const AxisValues& position);
  AxisValues command_from_program(const AxisValues& program) const;
  double length_scale() const { return modal_.metric ? 1.0 : 25.4; }
  double tool_length_in_z() const {
    return modal_.transformation == Transformation::none ? modal_.tool_length : 0.0;
  }

  Environment& environment_;
  ModalState modal_{};
  AxisValues position_{};
  AxisValues program_position_{};
  ProgramFrame frame_;
  std::array<ProgramFrame, frames_kept> kept_;  // by number, those that commands were made in
  std::uint32_t frame_number_ = 0;              // the newest of them
  std::optional<std::uint32_t> kept_revision_;  // of frame_
  OffsetTables tables_;
  CutterCompensation compensation_;
  double radius_deviation_ = 0;
  bool diameter_ = false;
  std::uint16_t channel_axes_ = 0;
  Beginning beginning_ = Beginning::program;
  std::uint32_t program_ = 0;
  std::uint32_t line_ = 0;
  std::uint32_t sequence_ = 0;
  std::uint32_t used_ = 0;        // letters of the block that had a meaning so far
  bool exact_stop_once_ = false;  // G9 in this block

  double polar_radius_ = 0;  // mm, of the last polar words
  double polar_angle_ = 0;   // degrees
  std::array<double, 2> polar_centre_{};

  std::optional<AxisValues> intermediate_;  // program coordinates, of the last G28 or G30
  bool needs_position_ = false;
  bool moves_ = false;
  std::uint32_t skip_input_ = 1;
  bool draining_ = false;       // the compensation has settled commands that found no place in the queue
  bool held_too_many_ = false;  // a command found no place in the compensation
  Command scratch_;
  bool parameter_input_ = false;  // between G10 L50 and G11
  bool swing_due_ = false;        // G68.1..3 was the block before
  RotaryChoice swing_choice_ = RotaryChoice::shortest;

  Activity activity_ = Activity::none;
  MCodes later_;  // M codes that act when the activity has ended
  HoleParameters cycle_;
  bool cycle_has_depth_ = false;
  bool cycle_has_r_ = false;
  std::array<double, 2> shift_{};  // of G76 and G87, mm in the plane
  double lead_ = 0;                // mm, of tapping, positive right-hand
  std::uint32_t tapping_axis_ = 0;
  SpindleDirection parked_ = SpindleDirection::stopped;  // how it turned before tapping stopped it
  HolePattern pattern_;
  HoleCycle hole_;
  HolePattern::Point hole_place_{};
  struct VectorMove {
    CommandKind kind = CommandKind::line;
    AxisValues start{}, end{};  // frame of the commands; of `end` all but the rotary axes
    Arc arc{};                  // the whole one
    Vector3 direction{};        // workpiece frame
    std::uint32_t piece = 0, pieces = 1;
  };
  VectorMove vector_move_;
  AlarmNumber detail_number_ = AlarmNumber::none;
  std::array<char, 64> detail_{};
  NurbsCurve curve_;
  Vector3 control_point_{};  // program coordinates, the last one of the curve
};

}  // namespace trunnion::language

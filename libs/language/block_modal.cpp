// The part of BlockExecutor that sets modal state: units, feed, spindle, tool, planes, offsets.
#include <cmath>

#include "language/block_executor.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint32_t highest_tool = 65535;
constexpr double metres_per_foot = 0.3048;

}  // namespace

Fault BlockExecutor::set_units_and_feed(const Block& block, const Codes& codes) {
  if (codes.has(Group::units)) modal_.metric = codes.code(Group::units) == 210;
  if (codes.has(Group::feed_mode)) {
    const std::uint16_t code = codes.code(Group::feed_mode);
    const FeedMode mode = code == 930   ? FeedMode::inverse_time
                          : code == 950 ? FeedMode::per_revolution
                                        : FeedMode::per_minute;
    // A number of one mode is nonsense in another.
    if (mode != modal_.feed_mode) modal_.feed = 0;
    modal_.feed_mode = mode;
  }
  if (block.has('F')) {
    use('F');
    const double feed = block.value('F');
    if (!(feed > 0)) return {AlarmNumber::feed_not_positive, block.offset('F')};
    modal_.feed = modal_.feed_mode == FeedMode::inverse_time ? feed : feed * length_scale();
  }
  return {};
}

Fault BlockExecutor::select_spindle_and_tool(const Block& block, const Codes& codes, CommandQueue& out) {
  if (const Fault fault = set_spindle(block, codes, out)) return fault;
  // In a G10 without L the tool is the one the entry is for; nothing is selected.
  if (!block.has('T') || (codes.is(Group::one_block, 100) && !block.has('L'))) return {};
  std::uint32_t tool = 0;
  if (const Fault fault = whole_number(block, 'T', 0, highest_tool, tool)) return fault;
  modal_.selected_tool = static_cast<std::uint16_t>(tool);
  push(CommandKind::tool, out).number = tool;
  return {};
}

Fault BlockExecutor::set_spindle(const Block& block, const Codes& codes, CommandQueue& out) {
  const SpindleMode before = modal_.spindle_mode;
  if (codes.has(Group::spindle_mode)) {
    modal_.spindle_mode = codes.code(Group::spindle_mode) == 960 ? SpindleMode::surface : SpindleMode::speed;
  }
  const bool surface = modal_.spindle_mode == SpindleMode::surface;
  const bool limit = codes.is(Group::one_block, 920);
  if (block.has('S')) {
    use('S');
    const double speed = block.value('S');
    if (speed < 0) return {AlarmNumber::value_range, block.offset('S')};
    if (limit) {
      modal_.spindle_limit = speed;
    } else if (surface) {
      modal_.surface_speed = modal_.metric ? speed : speed * metres_per_foot;
    } else {
      modal_.spindle_speed = speed;
    }
  }
  if (surface && !(modal_.surface_speed > 0)) {
    const std::uint16_t at =
        codes.has(Group::spindle_mode) ? codes.offset(Group::spindle_mode) : block.offset('S');
    return {AlarmNumber::surface_speed_missing, at};
  }
  if ((block.has('S') && !limit) || modal_.spindle_mode != before) {
    push(CommandKind::spindle_speed, out).value = surface ? modal_.surface_speed : modal_.spindle_speed;
  }
  return {};
}

Fault BlockExecutor::set_modal_codes(const Block& block, const Codes& codes) {
  if (const Fault fault = set_plane(codes)) return fault;
  if (codes.has(Group::distance)) modal_.absolute = codes.code(Group::distance) == 900;
  if (codes.has(Group::return_level)) modal_.return_to_initial = codes.code(Group::return_level) == 980;
  if (const Fault fault = set_path_control(block, codes)) return fault;
  if (const Fault fault = set_work_offset(block, codes)) return fault;
  if (const Fault fault = set_polar(codes)) return fault;
  if (codes.has(Group::smoothing)) {
    if (!block.has('Q')) return {AlarmNumber::missing_word, codes.offset(Group::smoothing)};
    std::uint32_t q = 0;
    if (const Fault fault = whole_number(block, 'Q', 0, 2, q)) return fault;
    modal_.smoothing = static_cast<std::uint8_t>(q);
  }
  if (codes.has(Group::motion)) {
    modal_.motion =
        static_cast<std::uint8_t>(codes.code(Group::motion) == 62 ? 62 : codes.code(Group::motion) / 10);
    modal_.cycle = 80;
  }
  if (codes.has(Group::cycle)) {
    // The level a cycle comes back to is the one before the first of its kind.
    if (modal_.cycle == 80) cycle_.initial = program_position_[plane_axes(modal_.plane).normal];
    modal_.cycle = static_cast<std::uint8_t>(codes.code(Group::cycle) / 10);
  }
  return {};
}

Fault BlockExecutor::set_plane(const Codes& codes) {
  if (!codes.has(Group::plane)) return {};
  const std::uint16_t code = codes.code(Group::plane);
  const Plane plane = code == 180 ? Plane::zx : code == 190 ? Plane::yz : Plane::xy;
  if (plane == modal_.plane) return {};
  const std::uint16_t at = codes.offset(Group::plane);
  if (modal_.rotated || modal_.polar) return {AlarmNumber::frame_plane, at};
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  modal_.plane = plane;
  return {};
}

Fault BlockExecutor::set_path_control(const Block& block, const Codes& codes) {
  if (!codes.has(Group::path_control)) return {};
  if (codes.code(Group::path_control) == 610) {
    modal_.path_control = PathControl::exact_stop;
    return {};
  }
  modal_.path_control = PathControl::continuous;
  modal_.path_tolerance = 0;
  for (const char letter : {'P', 'Q'}) {
    if (!block.has(letter)) continue;
    const double tolerance = length_word(block, letter);
    if (tolerance < 0) return {AlarmNumber::value_range, block.offset(letter)};
    // Q allows merging collinear points; leaving every point in place stays within any Q.
    if (letter == 'P') modal_.path_tolerance = tolerance;
  }
  return {};
}

Fault BlockExecutor::set_work_offset(const Block& block, const Codes& codes) {
  if (!codes.has(Group::work_offset)) return {};
  const std::uint16_t at = codes.offset(Group::work_offset);
  std::uint32_t index = codes.code(Group::work_offset) / 10u - 54u;
  if (codes.code(Group::work_offset) == 541) {
    if (!block.has('P')) return {AlarmNumber::missing_word, at};
    std::uint32_t number = 0;
    if (const Fault fault = whole_number(block, 'P', 1, work_offset_count - 6, number)) return fault;
    index = 5 + number;
  }
  if (index == modal_.work_offset) return {};
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  modal_.work_offset = static_cast<std::uint8_t>(index);
  frame_.set_work_offset(tables_.work_offset(modal_.work_offset));
  locate(position_);
  return {};
}

Fault BlockExecutor::set_polar(const Codes& codes) {
  if (!codes.has(Group::polar)) return {};
  modal_.polar = codes.code(Group::polar) == 160;
  const PlaneAxes plane = plane_axes(modal_.plane);
  const double u = program_position_[plane.first];
  const double v = program_position_[plane.second];
  polar_centre_ = {};
  polar_radius_ = std::hypot(u, v);
  polar_angle_ = std::atan2(v, u) * degrees_per_radian;
  return {};
}

Fault BlockExecutor::set_tool_length(const Block& block, const Codes& codes, CommandQueue& out) {
  const bool on =
      modal_.tool_vector || modal_.transformation == Transformation::rtcp || modal_.length_offset != 0;
  if (!codes.has(Group::tool_length)) {
    // H alone exchanges the length that counts; H0 takes it away, and without one there is nothing to take.
    if (!block.has('H') || (!on && block.value('H') != 0)) return {};
  }
  const bool off = codes.is(Group::tool_length, 490);
  Transformation transformation = modal_.transformation;
  bool vector = modal_.tool_vector;
  bool subtract = modal_.tool_length < 0;
  std::uint16_t at = 0;
  if (codes.has(Group::tool_length)) {
    const std::uint16_t code = codes.code(Group::tool_length);
    at = codes.offset(Group::tool_length);
    transformation = code == 434 || code == 435 ? Transformation::rtcp : Transformation::none;
    vector = code == 435;
    subtract = code == 440;
    if (modal_.tilt.active && transformation != Transformation::rtcp) return {AlarmNumber::tilt_active, at};
  } else {
    at = block.offset('H');
  }
  std::uint32_t h = 0;
  double length = 0;
  if (!off) {
    if (!block.has('H')) return {AlarmNumber::missing_word, at};
    if (const Fault fault = whole_number(block, 'H', 0, highest_tool, h)) return fault;
    if (h != 0) {
      const auto tool = tables_.tool(static_cast<std::uint16_t>(h));
      if (!tool) return {AlarmNumber::tool_length_unknown, block.offset('H')};
      length = tool->length + tool->length_wear;
      if (subtract) length = -length;
    }
  }
  const bool same = transformation == modal_.transformation && h == modal_.length_offset &&
                    length == modal_.tool_length && vector == modal_.tool_vector;
  if (same) return {};
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  return change_tool_length(transformation, vector, static_cast<std::uint16_t>(h), length, out);
}

// The machine stands still while the coordinates it is described in change.
Fault BlockExecutor::change_tool_length(Transformation transformation, bool vector, std::uint16_t h,
                                        double length, CommandQueue& out) {
  AxisValues position = machine_position();
  if (transformation == Transformation::rtcp) position = environment_.tip_from_machine(position, length);
  modal_.transformation = transformation;
  modal_.tool_vector = vector;
  modal_.length_offset = h;
  modal_.tool_length = length;
  locate(position);
  push(CommandKind::transformation, out);
  return {};
}

Fault BlockExecutor::set_cutter_compensation(const Block& block, const Codes& codes) {
  std::uint16_t at = 0;
  if (block.has('D')) {
    std::uint32_t d = 0;
    if (const Fault fault = whole_number(block, 'D', 0, highest_tool, d)) return fault;
    modal_.radius_offset = static_cast<std::uint16_t>(d);
    at = block.offset('D');
  } else if (!codes.has(Group::cutter_compensation)) {
    return {};
  }
  if (codes.has(Group::cutter_compensation)) {
    const std::uint16_t code = codes.code(Group::cutter_compensation);
    modal_.cutter_side = code == 410 ? CutterSide::left : code == 420 ? CutterSide::right : CutterSide::off;
    at = block.has('D') ? at : codes.offset(Group::cutter_compensation);
  }
  double radius = 0;
  if (modal_.cutter_side != CutterSide::off && modal_.radius_offset != 0) {
    const auto tool = tables_.tool(modal_.radius_offset);
    if (!tool || !tool->radius) return {AlarmNumber::radius_undefined, at};
    radius = *tool->radius + environment_.cutter_settings().wear_sign * tool->radius_wear;
  }
  if (modal_.cutter_side == CutterSide::off && !compensation_.active()) return {};
  const AxisValues here = frame_.contour_from_program(program_position_);
  const bool ends = modal_.cutter_side == CutterSide::off && codes.has(Group::cutter_compensation);
  compensation_.request(modal_.cutter_side, radius, modal_.plane, here);
  if (ends && modal_.motion <= 1 && !modal_.tool_vector) read_wall(block, here);
  return {};
}

// I J K of G40: the direction in which the contour would go on.
void BlockExecutor::read_wall(const Block& block, const AxisValues& here) {
  AxisValues ahead = program_position_;
  const PlaneAxes plane = plane_axes(modal_.plane);
  for (const std::uint8_t axis : {plane.first, plane.second})
    ahead[axis] += length_word(block, static_cast<char>('I' + axis));
  const AxisValues there = frame_.contour_from_program(ahead);
  compensation_.leave_along(
      {there[plane.first] - here[plane.first], there[plane.second] - here[plane.second]});
}

}  // namespace trunnion::language

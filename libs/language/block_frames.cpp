// The part of BlockExecutor that sets scaling, mirror, rotation and offsets.
#include <cmath>

#include "language/block_executor.hpp"
#include "language/letters.hpp"

namespace trunnion::language {
namespace {

constexpr double smallest_factor = 1e-6;
constexpr double largest_factor = 1e6;

}  // namespace

Fault BlockExecutor::set_frames(const Block& block, const Codes& codes, CommandQueue& out) {
  if (codes.has(Group::scaling)) {
    if (const Fault fault = set_scaling(block, codes)) return fault;
  }
  if (codes.has(Group::mirror)) {
    if (const Fault fault = set_mirror(block, codes)) return fault;
  }
  if (!codes.has(Group::rotation)) return {};
  switch (codes.code(Group::rotation)) {
    case 680:
      return set_rotation(block, codes);
    case 690:
      return clear_rotation(codes.offset(Group::rotation), out);
    default:
      return set_tilt(block, codes, out);
  }
}

Fault BlockExecutor::set_scaling(const Block& block, const Codes& codes) {
  modal_.scaled = codes.code(Group::scaling) == 510;
  if (!modal_.scaled) {
    frame_.clear_scaling();
    locate(position_);
    return {};
  }
  Vector3 centre{program_position_[X], program_position_[Y], program_position_[Z]};
  Vector3 factors{1, 1, 1};
  const bool each = (block.letters & letter_bits("IJK")) != 0;
  if (!each && !block.has('P')) return {AlarmNumber::missing_word, codes.offset(Group::scaling)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const char letter = axis_letters[axis];
    if (block.has(letter)) {
      use(letter);
      centre[axis] = axis_word(block, axis);
    }
    const char factor = each ? static_cast<char>('I' + axis) : 'P';
    if (!block.has(factor)) continue;
    use(factor);
    factors[axis] = block.value(factor);
    const double size = std::abs(factors[axis]);
    if (size < smallest_factor || size > largest_factor) {
      return {AlarmNumber::factor_range, block.offset(factor)};
    }
  }
  frame_.set_scaling(centre, factors);
  locate(position_);
  return {};
}

Fault BlockExecutor::set_mirror(const Block& block, const Codes& codes) {
  const std::uint16_t code = codes.code(Group::mirror);
  const bool on = code == 511 || code == 240;
  const std::uint16_t at = codes.offset(Group::mirror);
  if (!on && (block.letters & axis_bits) == 0) {
    frame_.clear_mirror();
  } else {
    std::uint32_t axes = 0;
    if (const Fault fault = take_axes(block, at, axes)) return fault;
    for (std::uint8_t axis = 0; axis < axis_count; ++axis) {
      if (((axes >> axis) & 1u) != 0) frame_.set_mirror(axis, on, axis_word(block, axis));
    }
  }
  modal_.mirrored = frame_.mirrored();
  locate(position_);
  return {};
}

Fault BlockExecutor::set_rotation(const Block& block, const Codes& codes) {
  char angle = 'R';
  if (!block.has('R')) angle = 'P';
  if (!block.has(angle)) return {AlarmNumber::missing_word, codes.offset(Group::rotation)};
  use(angle);
  const PlaneAxes plane = plane_axes(modal_.plane);
  Vector3 centre{program_position_[X], program_position_[Y], program_position_[Z]};
  for (const std::uint8_t axis : {plane.first, plane.second}) {
    const char letter = axis_letters[axis];
    if (!block.has(letter)) continue;
    use(letter);
    centre[axis] = axis_word(block, axis);
  }
  double degrees = block.value(angle);
  if (!modal_.absolute && modal_.rotated) degrees += frame_.rotation();
  frame_.set_rotation(modal_.plane, centre, std::fmod(degrees, 360.0));
  modal_.rotated = true;
  locate(position_);
  return {};
}

Fault BlockExecutor::clear_rotation(std::uint16_t at, CommandQueue& out) {
  if (modal_.tilt.active) {
    if (const Fault fault = refuse_in_compensation(at)) return fault;
  }
  frame_.clear_rotation();
  modal_.rotated = false;
  if (modal_.tilt.active) {
    modal_.tilt = {};
    frame_.set_tilt(modal_.tilt);
    locate(position_);
    push(CommandKind::transformation, out);
  }
  locate(position_);
  return {};
}

Fault BlockExecutor::set_local_offset(const Block& block, const Codes& codes) {
  const std::uint16_t at = codes.offset(Group::one_block);
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = take_axes(block, at, axes)) return fault;
  for (std::uint8_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) == 0) continue;
    const double word = axis_word(block, axis);
    frame_.set_local(axis, modal_.absolute ? word : frame_.local()[axis] + word);
  }
  locate(position_);
  return {};
}

Fault BlockExecutor::shift_coordinates(const Block& block, const Codes& codes) {
  const std::uint16_t at = codes.offset(Group::one_block);
  if ((block.letters & axis_bits) == 0) {
    return block.has('S') ? Fault{} : Fault{AlarmNumber::missing_word, at};
  }
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  if (!frame_.plain() || modal_.polar) return {AlarmNumber::frame_shift, at};
  std::uint32_t axes = 0;
  if (const Fault fault = take_axes(block, at, axes)) return fault;
  for (std::uint8_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) == 0) continue;
    frame_.set_shift(axis, frame_.shift()[axis] + program_position_[axis] - axis_word(block, axis));
  }
  locate(position_);
  return {};
}

Fault BlockExecutor::clear_shift(const Codes& codes) {
  if (const Fault fault = refuse_in_compensation(codes.offset(Group::one_block))) return fault;
  frame_.clear_shift();
  locate(position_);
  return {};
}

}  // namespace trunnion::language

// SPDX-License-Identifier: Apache-2.0
#include "analysis/arc_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "analysis/block_codes.hpp"
#include "language/letters.hpp"

namespace trunnion::analysis {
namespace {

using language::AxisValues;
using language::Block;
using language::Group;
using language::SeenBlock;

constexpr double pi = std::numbers::pi;
/// mm by which a circle may miss its end without a warning: that of four decimals of an inch, with reserve.
constexpr double end_off = 0.005;
constexpr double no_way = 1e-6;
/// The centre of a circle is this far from the chord, in parts of half the chord, where a change of R by
/// 0.5 um moves it by 20 um.
constexpr double near_chord = 0.025;
constexpr double nearly_full = 355.0 / 180 * pi;
constexpr double turns_back = 150.0 / 180 * pi, smooth = 10.0 / 180 * pi;

/// NUM programs have other words for a centre.
bool is_num(const SeenBlock& seen) { return seen.dialect == language::ProgramDialect::num; }

bool has_angle(const SeenBlock& seen) { return !is_num(seen) && seen.block.has(language::angle_word); }

/// The words of the block are no end of a move, or its position counts in another frame.
bool changes_frame(const Block& block) {
  for (const Group group : {Group::work_offset, Group::tool_length, Group::stroke_zone, Group::setting_error,
                            Group::scaling, Group::mirror, Group::rotation})
    if (code_of(block, group)) return true;
  return false;
}

/// I J K are coordinates, and not counted from the start.
bool absolute_centres_in(const SeenBlock& seen) {
  const FoundCode code = code_of(seen.block, Group::arc_distance);
  return code ? code.is(901) : seen.modal.absolute_centres;
}

double between(double one, double other) { return std::abs(std::remainder(one - other, 2 * pi)); }

}  // namespace

ArcChecks::ArcChecks(const language::Environment& environment, Warnings& warnings)
    : environment_(environment), warnings_(warnings) {}

void ArcChecks::see(const SeenBlock& seen, bool calls) {
  if (seen.block.empty()) return;
  finish(seen.position);
  path_ = path_of(seen, calls);
  // The block with ,A alone ends where the next one says.
  if (has_angle(seen)) before_known_ = doubtful_ = false;
}

ArcChecks::Path ArcChecks::path_of(const SeenBlock& seen, bool calls) const {
  const Block& block = seen.block;
  const FoundCode motion = code_of(block, Group::motion), cycle = code_of(block, Group::cycle);
  const int code = motion ? tenths_of(*motion.code) / 10 : seen.modal.motion;
  const bool in_cycle = cycle ? !cycle.is(800) : !motion && seen.modal.cycle != 80;
  Path path;
  path.start = seen.position;
  if (calls || in_cycle || code_of(block, Group::one_block) || seen.modal.tool_vector) return path;
  if (is_num(seen) || has_angle(seen) || changes_frame(block)) return path;
  if (code < 1 || code > 3) return path;
  if ((block.letters & language::axis_bits) != 0) path.kind = Kind::straight;
  const FoundCode plane = code_of(block, Group::plane);
  path.plane = !plane          ? seen.modal.plane
               : plane.is(180) ? language::Plane::zx
               : plane.is(190) ? language::Plane::yz
                               : language::Plane::xy;
  if (code == 1) return path;
  const double scale = length_scale_in(seen);
  const auto axes = canonical::plane_axes(path.plane);
  const char letters[] = {static_cast<char>('I' + axes.first), static_cast<char>('I' + axes.second)};
  path.turn = code == 3 ? 1 : -1;
  path.radius = block.has('R') ? block.value('R') * scale : 0;
  const std::size_t in_plane[] = {axes.first, axes.second};
  for (std::size_t k = 0; k < 2; ++k) {
    const double from = absolute_centres_in(seen) ? path.start[in_plane[k]] : 0;
    path.centre[k] = block.has(letters[k]) ? block.value(letters[k]) * scale - from : 0;
  }
  path.kind = block.has('R')                                   ? Kind::radius
              : block.has(letters[0]) || block.has(letters[1]) ? Kind::centre
                                                               : Kind::none;
  const char word = path.kind == Kind::radius ? 'R' : block.has(letters[0]) ? letters[0] : letters[1];
  if (path.kind != Kind::none)
    path.place = place_in(seen.program, seen.number, seen.line, block.offset(word));
  return path;
}

// Where the path ends is known when the next block is read.
void ArcChecks::finish(const AxisValues& position) {
  const Path path = path_;
  path_ = Path{};
  const auto axes = canonical::plane_axes(path.plane);
  const Flat way{position[axes.first] - path.start[axes.first],
                 position[axes.second] - path.start[axes.second]};
  const bool moved = std::hypot(way[0], way[1]) > no_way;
  const bool stays = position == path.start;
  if (path.kind == Kind::centre || (moved && path.kind != Kind::none)) {
    Ends ends{std::atan2(way[1], way[0]), std::atan2(way[1], way[0])};
    if (path.kind == Kind::centre) ends = by_centre(path, way);
    if (path.kind == Kind::radius) ends = by_radius(path, way);
    if (path.kind != Kind::radius) compare_with_next(ends.begin);
    before_known_ = true;
    before_ = ends.end;
  } else if (!stays) {
    before_known_ = doubtful_ = false;
  }
}

ArcChecks::Ends ArcChecks::by_centre(const Path& path, const Flat& way) {
  const double start = std::hypot(path.centre[0], path.centre[1]);
  const double end = std::hypot(way[0] - path.centre[0], way[1] - path.centre[1]);
  const double off = std::abs(start - end);
  // One that is further off would have been refused: then the words mean something else.
  if (off > end_off && off <= environment_.radius_deviation() + no_way)
    if (auto* const warning = warnings_.add(WarningKind::arc_end, path.place))
      warning->detail = fmt::format("radius {:.4f} mm at the start, {:.4f} mm at the end", start, end);
  const double quarter = path.turn * pi / 2;
  return {std::atan2(-path.centre[1], -path.centre[0]) + quarter,
          std::atan2(way[1] - path.centre[1], way[0] - path.centre[0]) + quarter};
}

ArcChecks::Ends ArcChecks::by_radius(const Path& path, const Flat& way) {
  const double half = std::hypot(way[0], way[1]) / 2, size = std::abs(path.radius);
  const double minor = half < size ? 2 * std::asin(half / size) : pi;
  const double sweep = path.radius < 0 ? 2 * pi - minor : minor;
  const double from_chord = half < size ? std::sqrt((size - half) * (size + half)) : 0;
  if (size - half > no_way && from_chord < near_chord * half)
    if (auto* const warning = warnings_.add(WarningKind::arc_half, path.place))
      warning->detail =
          fmt::format("half of the way is {:.4f} mm, the centre {:.3f} mm beside it", half, from_chord);
  if (sweep > nearly_full)
    if (auto* const warning = warnings_.add(WarningKind::arc_full, path.place))
      warning->detail =
          fmt::format("{:.2f} degrees, its ends are {:.4f} mm apart", sweep * 180 / pi, 2 * half);
  const double chord = std::atan2(way[1], way[0]);
  const Ends own{chord - path.turn * sweep / 2, chord + path.turn * sweep / 2};
  compare_with_next(own.begin);
  check_side(path, way, sweep, own);
  return own;
}

// The other sides: R with the other sign, and the other sense of rotation.
void ArcChecks::check_side(const Path& path, const Flat& way, double sweep, const Ends& own) {
  doubtful_ = before_known_ && between(before_, own.begin) > turns_back;
  if (!doubtful_) return;
  const double chord = std::atan2(way[1], way[0]);
  const double halves[] = {path.turn * (2 * pi - sweep) / 2, -path.turn * sweep / 2};
  for (std::size_t k = 0; k < 2; ++k) {
    other_fits_[k] = between(before_, chord - halves[k]) < smooth;
    other_ends_[k] = chord + halves[k];
  }
  own_end_ = own.end;
  doubtful_place_ = path.place;
  doubtful_ = other_fits_[0] || other_fits_[1];
}

void ArcChecks::compare_with_next(double begin) {
  if (!doubtful_) return;
  doubtful_ = false;
  if (between(own_end_, begin) <= turns_back) return;
  for (std::size_t k = 0; k < 2; ++k)
    if (other_fits_[k] && between(other_ends_[k], begin) < smooth) {
      warnings_.add(WarningKind::arc_side, doubtful_place_);
      return;
    }
}

}  // namespace trunnion::analysis

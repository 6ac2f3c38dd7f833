// SPDX-License-Identifier: Apache-2.0
// Whether a machine that was disturbed went the way of one that was not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace trunnion::integration {

using Rows = std::vector<std::vector<double>>;  ///< one row a cycle, a column for each axis, mm and deg

/// Follows executed setpoints along those of an undisturbed run. The path may cross and retrace itself: a row
/// is looked for near the place of the row before it. All axes count alike, so a distance is in mm and deg
/// together.
class PathFollower {
 public:
  /// `reference` is at least two rows and outlives this.
  explicit PathFollower(const Rows& reference) : reference_(reference) {}

  /// The next executed row. False when it lies farther than `tolerance` from every place the machine could
  /// have reached: at most `ahead` cycles of the undisturbed run farther, or back to a place it had been at.
  bool follow(const std::vector<double>& row, double tolerance, std::size_t ahead = 64);

  double largest() const { return largest_; }          ///< distance of any row so far
  std::size_t place() const { return place_; }         ///< cycle of the undisturbed run
  std::size_t farthest_back() const { return back_; }  ///< cycles gone back at once
  /// What is left of the undisturbed run is no way any more.
  bool arrived(double tolerance) const;

 private:
  double distance(const std::vector<double>& row, std::size_t piece) const;
  bool search(const std::vector<double>& row, std::size_t from, std::size_t to, double tolerance);
  const Rows& reference_;
  std::size_t place_ = 0, back_ = 0;
  double largest_ = 0;
};

/// What a run was like beside an undisturbed one.
struct Judgement {
  std::string problem;  ///< the first row that is not where it may be, or empty
  double largest = 0;
  std::size_t back = 0;
  std::uint64_t unseen = 0;  ///< cycles the observer missed: they are not judged, but what follows them is
};

/// `rows` is one for each cycle, empty where the observer has missed it. With `whole` it must also arrive at
/// the end.
Judgement judge(const Rows& rows, const Rows& reference, double tolerance, bool whole);

/// Both executed the same cycles: equal numbers of rows, no value farther off than `tolerance`.
bool same_rows(const Rows& a, const Rows& b, double tolerance);

/// `1.0000 2.0000`, for messages.
std::string text_of(const std::vector<double>& row);

}  // namespace trunnion::integration

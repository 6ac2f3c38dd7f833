// SPDX-License-Identifier: Apache-2.0
// The vectors of a kinematic chain from the centres of a sphere over poses of the rotary axes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "metrology/chain_vectors.hpp"

namespace trunnion::metrology {

/// One pose: where the linear axes put the centre of the probe's ball into the centre of the sphere.
struct MeasuredPose {
  geometry::Angles angles{};         ///< deg
  Vec3 centre = Vec3::Zero();        ///< mm, positions of X, Y, Z
  Mat3 cofactor = Mat3::Identity();  ///< covariance of `centre`, up to a factor that all poses have in common
};

/// A linear condition on the result: the sum of coefficient . (offset + correction) over the slots is value.
/// There must be as many as the chain has free components, no more, no fewer.
struct OffsetCondition {
  std::array<Vec3, slot_count> coefficient{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(),
                                           Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  double value = 0;  ///< mm
};

struct FitOptions {
  /// Estimate the directions of the axes, too. Without it they are those of the chain.
  bool directions = true;
  /// Empty: the components of parameters that no measurement shows are kept (free_components()).
  std::vector<OffsetCondition> conditions;
  /// Slots whose change goes into RotaryAxis::correction; the others change the offset.
  std::array<bool, slot_count> into_correction{};
  /// Standard uncertainty of a touch (the unit of MeasuredPose::cofactor), mm, for measurements without
  /// freedom. 0: unknown.
  double touch_uncertainty = 0;
  /// Standard deviation of a touch by a fit that leaves nothing out, mm, with its degrees of freedom. 0: by
  /// the residuals of this one, in which what is not estimated would count as an error of the touches.
  double touch_deviation = 0;
  std::size_t touch_freedom = 0;
  /// Standard uncertainty of the tool length, mm: added to the vectors that depend on it.
  double tool_length_uncertainty = 0;
  /// In addition: variance of the tool length for touches of variance 1, where touches have given it.
  double tool_length_cofactor = 0;
};

/// Estimated components with their standard and expanded uncertainty: with a probability of 95 % all
/// components of all vectors are within the expanded ones at the same time.
struct VectorEstimate {
  Vec3 value = Vec3::Zero(), standard = Vec3::Zero(), expanded = Vec3::Zero();
  /// False: these poses do not show the component; `value` is the one before.
  std::array<bool, 3> observed{true, true, true};
};

struct AxisEstimate {
  Slot slot = Slot::table_2;
  std::size_t angle = 0;
  VectorEstimate offset;     ///< mm, with the correction
  VectorEstimate direction;  ///< unit vector
};

struct KinematicFit {
  ChainParameters parameters;
  std::vector<AxisEstimate> axes;
  Vec3 sphere = Vec3::Zero();  ///< mm, its centre in the workpiece frame
  std::vector<Vec3>
      differences;              ///< mm: expected less measured centre before the fit, zero at the first pose
  std::vector<Vec3> residuals;  ///< mm: measured less computed centre after it
  double touch_deviation = 0;   ///< mm: standard deviation of a touch by the residuals; 0 without freedom
  std::size_t freedom = 0;      ///< equations less unknowns
  double coverage_factor = 0;
  double condition = 0;  ///< largest over least singular value (mm, and mm at 300 mm for directions)
  std::vector<std::string> not_observed;  ///< "A direction Y": what these poses do not show
};

enum class FitError {
  too_few,     ///< fewer equations than unknowns
  not_finite,  ///< a centre, an angle or the tool length is not a finite number
  chain,       ///< the chain, or one near it, is refused by geometry::Chain
  conditions,  ///< not as many conditions as free components, or they do not fix them
  diverged,    ///< the least squares do not converge
};

/// The components of offsets that slide along an axis without any effect on the machine, as conditions that
/// keep them: of a table those next to the base first, of a head those next to the tool first. So an AC
/// table keeps X and Z of 04c432 .. 434, a CB head Y of 04c420 .. 422 and Z of 04c417 .. 419 (the manual of
/// HNC-8 has the same zeros).
/// `given` come first; what they leave free is kept. They must be independent, or there are too few in all.
std::vector<OffsetCondition> free_components(const ChainParameters& chain,
                                             const std::vector<OffsetCondition>& given = {});

/// Least squares over all poses: unknown are offsets and directions of all rotary axes and the place of the
/// sphere. Gauss-Newton; the poses' covariances are weights. `tool_length`: to the centre of the ball, mm.
std::variant<KinematicFit, FitError> fit_kinematics(const ChainParameters& start,
                                                    const std::vector<MeasuredPose>& poses,
                                                    double tool_length, const FitOptions& options = {});

/// The meaning of `error`, in words.
const char* to_string(FitError error);

}  // namespace trunnion::metrology

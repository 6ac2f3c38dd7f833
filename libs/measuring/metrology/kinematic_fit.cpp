// SPDX-License-Identifier: Apache-2.0
#include "metrology/kinematic_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "geometry/decompositions.hpp"
#include "metrology/student.hpp"

namespace trunnion::metrology {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using geometry::Chain;

constexpr double arm = 300;              // mm: an unknown of a direction is a displacement at this distance
constexpr double structural = 1e-7;      // singular values below it, relative, are exactly zero
constexpr double least_singular = 1e-4;  // below it, relative, the poses do not show a combination
// A component that changes less than this when a vector slides along its axis by 1 does not fix the slide;
// axes are a few mrad beside their ideal direction at most.
constexpr double fixes = 0.05;
constexpr int structural_poses = 40;

// The unknowns in their order: of each axis offset X Y Z and two tilts of its direction, then the sphere.
class Unknowns {
 public:
  Unknowns(const ChainParameters& start, const FitOptions& options) : start_(start), options_(options) {
    for (const Slot slot : all_slots) {
      const auto& axis = axis_at(start, slot);
      if (!axis) continue;
      slots_.push_back(slot);
      const Vec3 along = axis->direction.normalized();
      Index least = 0;
      along.cwiseAbs().minCoeff(&least);
      const Vec3 first = (Vec3::Unit(least) - along[least] * along).normalized();
      tangents_.push_back({first, along.cross(first)});
    }
  }
  Index per_axis() const { return options_.directions ? 5 : 3; }
  Index sphere() const { return per_axis() * static_cast<Index>(slots_.size()); }
  Index count() const { return sphere() + 3; }
  const std::vector<Slot>& slots() const { return slots_; }
  const std::array<Vec3, 2>& tangents(std::size_t axis) const { return tangents_[axis]; }

  ChainParameters chain(const VectorXd& x) const {
    ChainParameters p = start_;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      auto& axis = *axis_at(p, slots_[i]);
      const Index first = per_axis() * static_cast<Index>(i);
      (options_.into_correction[index_of(slots_[i])] ? axis.correction : axis.offset) += x.segment<3>(first);
      if (options_.directions)
        axis.direction = (axis.direction.normalized() + x[first + 3] / arm * tangents_[i][0] +
                          x[first + 4] / arm * tangents_[i][1])
                             .normalized();
    }
    return p;
  }

  std::string name(Index k) const {
    constexpr const char* components[]{" X", " Y", " Z"};
    if (k >= sphere()) return std::string("sphere") + components[k - sphere()];
    const auto i = static_cast<std::size_t>(k / per_axis());
    std::string text(1, "ABCUVW"[axis_at(start_, slots_[i])->angle]);
    const Index part = k % per_axis();
    if (part < 3) return text + " offset" + components[part];
    Index component = 0;
    tangents_[i][static_cast<std::size_t>(part - 3)].cwiseAbs().maxCoeff(&component);
    return text + " direction" + components[component];
  }

 private:
  const ChainParameters& start_;
  const FitOptions& options_;
  std::vector<Slot> slots_;
  std::vector<std::array<Vec3, 2>> tangents_;
};

// Positions of the linear axes of all poses; nothing where the chain is refused.
std::optional<VectorXd> predict(const ChainParameters& chain, const Vec3& sphere,
                                const std::vector<MeasuredPose>& poses, double tool_length) {
  const auto made = Chain::make(chain);
  if (!std::holds_alternative<Chain>(made)) return std::nullopt;
  VectorXd out(3 * static_cast<Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i)
    out.segment<3>(3 * static_cast<Index>(i)) =
        std::get<Chain>(made).machine_from_tip(sphere, poses[i].angles, tool_length);
  return out;
}

// Derivative of predict() by the unknowns: central differences. The offsets are linear, of a direction the
// step is 3e-5 rad, whose square is 1e-9.
std::optional<MatrixXd> derivative(const Unknowns& unknowns, const VectorXd& x, const Vec3& sphere,
                                   const std::vector<MeasuredPose>& poses, double tool_length) {
  constexpr double step = 0.01;
  MatrixXd jacobian(3 * static_cast<Index>(poses.size()), unknowns.count());
  for (Index k = 0; k < unknowns.count(); ++k) {
    std::array<VectorXd, 2> at;
    for (const int side : {0, 1}) {
      VectorXd moved = x;
      moved[k] += side == 0 ? -step : step;
      auto values = predict(unknowns.chain(moved), sphere + moved.tail<3>(), poses, tool_length);
      if (!values) return std::nullopt;
      at[static_cast<std::size_t>(side)] = *std::move(values);
    }
    jacobian.col(k) = (at[1] - at[0]) / (2 * step);
  }
  return jacobian;
}

// Combinations of the unknowns that never change any pose, as columns: of a chain that has all poses.
std::optional<MatrixXd> free_combinations(const ChainParameters& chain, const Unknowns& unknowns) {
  std::vector<MeasuredPose> poses;
  std::uint64_t state = 1;
  for (int i = 0; i < structural_poses; ++i) {
    MeasuredPose pose;
    for (double& angle : pose.angles) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      angle = 340 * (static_cast<double>(state >> 11) * 0x1p-53 - 0.5);
    }
    const Vec3 sphere(170, -90, 60);
    const auto at = predict(chain, sphere, {pose}, 100);
    if (!at) return std::nullopt;
    if (at->cwiseAbs().maxCoeff() < 1e6) poses.push_back(pose);
  }
  const auto jacobian =
      derivative(unknowns, VectorXd::Zero(unknowns.count()), Vec3(170, -90, 60), poses, 100);
  if (!jacobian) return std::nullopt;
  const Eigen::JacobiSVD<MatrixXd> svd(*jacobian, Eigen::ComputeFullV);
  Index rank = 0;
  while (rank < svd.singularValues().size() &&
         svd.singularValues()[rank] > structural * svd.singularValues()[0])
    ++rank;
  return MatrixXd(svd.matrixV().rightCols(unknowns.count() - rank));
}

// The rows of conditions over the unknowns.
MatrixXd rows_of(const std::vector<OffsetCondition>& conditions, const Unknowns& unknowns) {
  MatrixXd rows = MatrixXd::Zero(static_cast<Index>(conditions.size()), unknowns.count());
  for (std::size_t c = 0; c < conditions.size(); ++c)
    for (std::size_t i = 0; i < unknowns.slots().size(); ++i)
      rows.row(static_cast<Index>(c)).segment<3>(unknowns.per_axis() * static_cast<Index>(i)) =
          conditions[c].coefficient[index_of(unknowns.slots()[i])].transpose();
  return rows;
}

bool independent(const MatrixXd& square) {
  if (square.size() == 0) return true;
  const Eigen::JacobiSVD<MatrixXd> svd(square);
  return svd.singularValues().minCoeff() > fixes * svd.singularValues().maxCoeff();
}

std::vector<OffsetCondition> kept_components(const ChainParameters& chain, const Unknowns& unknowns,
                                             const MatrixXd& free,
                                             const std::vector<OffsetCondition>& given = {}) {
  auto chosen = given;
  MatrixXd taken = rows_of(given, unknowns) * free;
  // Next to the base of the table, next to the tool of the head.
  for (const Slot slot :
       {Slot::table_0, Slot::table_1, Slot::head_2, Slot::head_1, Slot::head_0, Slot::table_2}) {
    const auto& axis = axis_at(chain, slot);
    if (!axis) continue;
    for (int component = 0; component < 3; ++component) {
      if (taken.rows() >= free.cols()) return chosen;
      OffsetCondition condition;
      condition.coefficient[index_of(slot)] = Vec3::Unit(component);
      condition.value = (axis->offset + axis->correction)[component];
      MatrixXd more(taken.rows() + 1, free.cols());
      more << taken, rows_of({condition}, unknowns) * free;
      if (more.bottomRows(1).norm() < fixes) continue;
      const Eigen::JacobiSVD<MatrixXd> svd(more);
      if (svd.singularValues()[more.rows() - 1] < fixes) continue;
      taken = more;
      chosen.push_back(condition);
    }
  }
  return chosen;
}

// Whitens the rows of a pose: divides by the square root of its covariance.
void whiten(const std::vector<MeasuredPose>& poses, MatrixXd& rows) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    auto part = rows.middleRows<3>(3 * static_cast<Index>(i));
    part = poses[i].cofactor.llt().matrixL().solve(part).eval();
  }
}

bool usable(const std::vector<MeasuredPose>& poses, double tool_length) {
  bool good = std::isfinite(tool_length);
  for (const auto& pose : poses) {
    good = good && pose.centre.allFinite() && pose.cofactor.allFinite() &&
           pose.cofactor.llt().info() == Eigen::Success;
    for (const double angle : pose.angles) good = good && std::isfinite(angle);
  }
  return good;
}

// Estimates with their uncertainties from the covariance of the unknowns.
void describe(KinematicFit& fit, const Unknowns& unknowns, const MatrixXd& covariance,
              const MatrixXd& hidden) {
  const auto observed = [&](Index k) { return hidden.cols() == 0 || hidden.row(k).norm() < 1e-2; };
  for (std::size_t i = 0; i < unknowns.slots().size(); ++i) {
    const Index first = unknowns.per_axis() * static_cast<Index>(i);
    const auto& axis = *axis_at(fit.parameters, unknowns.slots()[i]);
    AxisEstimate estimate{unknowns.slots()[i], axis.angle, {}, {}};
    estimate.offset.value = axis.offset + axis.correction;
    estimate.direction.value = axis.direction.normalized();
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << unknowns.tangents(i)[0], unknowns.tangents(i)[1];
    for (Index c = 0; c < 3; ++c) {
      estimate.offset.standard[c] = std::sqrt(std::max(0.0, covariance(first + c, first + c)));
      estimate.offset.observed[static_cast<std::size_t>(c)] = observed(first + c);
    }
    if (unknowns.per_axis() == 5) {
      const Mat3 spread =
          tangents * covariance.block<2, 2>(first + 3, first + 3) * tangents.transpose() / (arm * arm);
      for (Index c = 0; c < 3; ++c) {
        estimate.direction.standard[c] = std::sqrt(std::max(0.0, spread(c, c)));
        for (Index t = 0; t < 2; ++t)
          if (!observed(first + 3 + t) && std::abs(tangents(c, t)) > 0.01)
            estimate.direction.observed[static_cast<std::size_t>(c)] = false;
      }
    }
    for (auto* vector : {&estimate.offset, &estimate.direction})
      vector->expanded = fit.coverage_factor * vector->standard;
    fit.axes.push_back(estimate);
  }
  for (Index k = 0; k < unknowns.count(); ++k)
    if (!observed(k)) fit.not_observed.push_back(unknowns.name(k));
}

}  // namespace

std::vector<OffsetCondition> free_components(const ChainParameters& chain,
                                             const std::vector<OffsetCondition>& given) {
  FitOptions options;
  const Unknowns unknowns(chain, options);
  const auto free = free_combinations(chain, unknowns);
  return free ? kept_components(chain, unknowns, *free, given) : std::vector<OffsetCondition>{};
}

std::variant<KinematicFit, FitError> fit_kinematics(const ChainParameters& start,
                                                    const std::vector<MeasuredPose>& poses,
                                                    double tool_length, const FitOptions& options) {
  if (poses.size() < 3) return FitError::too_few;
  if (!usable(poses, tool_length)) return FitError::not_finite;
  const auto chain = Chain::make(start);
  if (!std::holds_alternative<Chain>(chain)) return FitError::chain;
  const Vec3 sphere = std::get<Chain>(chain).tip_from_machine(poses[0].centre, poses[0].angles, tool_length);
  const Unknowns unknowns(start, options);
  const Index n = unknowns.count();
  const auto free = free_combinations(start, unknowns);
  if (!free) return FitError::chain;
  const auto conditions =
      options.conditions.empty() ? kept_components(start, unknowns, *free) : options.conditions;
  const MatrixXd rows = rows_of(conditions, unknowns);
  if (rows.rows() != free->cols() || !independent(rows * *free)) return FitError::conditions;
  // x = fixed + span y fulfils the conditions for every y.
  VectorXd fixed = VectorXd::Zero(n);
  MatrixXd span = MatrixXd::Identity(n, n);
  if (rows.rows() > 0) {
    VectorXd wanted(rows.rows());
    for (std::size_t c = 0; c < conditions.size(); ++c) {
      wanted[static_cast<Index>(c)] = conditions[c].value;
      for (const Slot slot : unknowns.slots()) {
        const auto& axis = *axis_at(start, slot);
        wanted[static_cast<Index>(c)] -=
            conditions[c].coefficient[index_of(slot)].dot(axis.offset + axis.correction);
      }
    }
    const Eigen::JacobiSVD<MatrixXd> svd(rows, Eigen::ComputeFullU | Eigen::ComputeFullV);
    fixed = svd.solve(wanted);
    span = svd.matrixV().rightCols(n - rows.rows());
  }
  VectorXd measured(3 * static_cast<Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i)
    measured.segment<3>(3 * static_cast<Index>(i)) = poses[i].centre;

  KinematicFit fit;
  const auto expected = predict(start, sphere, poses, tool_length);
  for (std::size_t i = 0; i < poses.size(); ++i)
    fit.differences.emplace_back(expected->segment<3>(3 * static_cast<Index>(i)) - poses[i].centre);
  VectorXd y = VectorXd::Zero(span.cols());
  MatrixXd residual;
  Eigen::JacobiSVD<MatrixXd> svd;
  Index rank = 0;
  constexpr int most_steps = 40;
  for (int step = 0;; ++step) {
    const VectorXd x = fixed + span * y;
    const auto predicted = predict(unknowns.chain(x), sphere + x.tail<3>(), poses, tool_length);
    const auto jacobian = derivative(unknowns, x, sphere, poses, tool_length);
    if (!predicted || !jacobian) return FitError::chain;
    residual = measured - *predicted;
    MatrixXd design = *jacobian * span;
    whiten(poses, residual);
    whiten(poses, design);
    svd.compute(design, Eigen::ComputeThinU | Eigen::ComputeFullV);
    rank = 0;
    while (rank < svd.singularValues().size() &&
           svd.singularValues()[rank] > least_singular * svd.singularValues()[0])
      ++rank;
    const VectorXd change =
        svd.matrixV().leftCols(rank) *
        (svd.matrixU().leftCols(rank).transpose() * residual).cwiseQuotient(svd.singularValues().head(rank));
    if (!change.allFinite() || step > most_steps) return FitError::diverged;
    if (change.norm() < 1e-9) break;
    y += change;
  }
  if (3 * static_cast<Index>(poses.size()) < rank) return FitError::too_few;
  const VectorXd x = fixed + span * y;
  fit.parameters = unknowns.chain(x);
  fit.sphere = sphere + x.tail<3>();
  const auto after = predict(fit.parameters, fit.sphere, poses, tool_length);
  for (std::size_t i = 0; i < poses.size(); ++i)
    fit.residuals.emplace_back(poses[i].centre - after->segment<3>(3 * static_cast<Index>(i)));
  fit.freedom = poses.size() * 3 - static_cast<std::size_t>(rank);
  fit.condition = svd.singularValues()[0] / svd.singularValues()[svd.singularValues().size() - 1];
  if (fit.freedom > 0) fit.touch_deviation = residual.norm() / std::sqrt(static_cast<double>(fit.freedom));
  const double by_residuals = fit.freedom > 0 ? fit.touch_deviation : options.touch_uncertainty;
  const bool given = options.touch_deviation > 0;
  const double unit = given ? options.touch_deviation : by_residuals;
  const auto values = static_cast<std::size_t>(std::max<Index>(rank - 3, 1));
  fit.coverage_factor = coverage_factor(0.95, values, given ? options.touch_freedom : fit.freedom);
  const MatrixXd seen = span * svd.matrixV().leftCols(rank);
  const MatrixXd hidden = span * svd.matrixV().rightCols(span.cols() - rank);
  const MatrixXd scaled = unit * seen * svd.singularValues().head(rank).cwiseInverse().asDiagonal();
  MatrixXd covariance = scaled * scaled.transpose();
  const double length_deviation =
      std::hypot(options.tool_length_uncertainty, unit * std::sqrt(options.tool_length_cofactor));
  if (length_deviation > 0) {
    constexpr double longer = 1;  // mm
    MatrixXd effect = *predict(fit.parameters, fit.sphere, poses, tool_length + longer) - *after;
    whiten(poses, effect);
    const VectorXd change = seen * svd.singularValues().head(rank).cwiseInverse().asDiagonal() *
                            (svd.matrixU().leftCols(rank).transpose() * effect) * length_deviation;
    covariance += change * change.transpose();
  }
  describe(fit, unknowns, covariance, hidden);
  return fit;
}

const char* to_string(FitError error) {
  switch (error) {
    case FitError::too_few:
      return "fewer centres than the unknown vectors need";
    case FitError::not_finite:
      return "a centre, an angle or the tool length is not a finite number";
    case FitError::chain:
      return "the kinematic chain is refused";
    case FitError::conditions:
      return "the normalizations do not fix the free components: an axis without one, one twice, or a "
             "component "
             "that sliding along the axis does not change";
    case FitError::diverged:
      return "the least squares do not converge: the poses or the start are wrong";
  }
  return "";
}

}  // namespace trunnion::metrology

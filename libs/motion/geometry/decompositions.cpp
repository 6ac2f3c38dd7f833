// SPDX-License-Identifier: Apache-2.0
#include "geometry/decompositions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

template class Eigen::JacobiSVD<Eigen::MatrixXd>;

namespace trunnion::geometry {

Eigen::VectorXd least_squares(const Eigen::MatrixXd& rows, const Eigen::VectorXd& values) {
  return rows.colPivHouseholderQr().solve(values);
}

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  return matrix.ldlt().solve(right);
}

Eigen::MatrixXd symmetric_inverse(const Eigen::MatrixXd& matrix) {
  return matrix.ldlt().solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
}

}  // namespace trunnion::geometry

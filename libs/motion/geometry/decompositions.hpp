// SPDX-License-Identifier: Apache-2.0
// Eigen's decompositions of matrices of any size: compiled once, because each takes seconds wherever it is
// used.
#pragma once

#include <Eigen/SVD>

extern template class Eigen::JacobiSVD<Eigen::MatrixXd>;

namespace trunnion::geometry {

/// The x of least |rows x - values|, by a QR decomposition with pivoting of columns. Where columns depend on
/// each other it is one of the solutions.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& rows, const Eigen::VectorXd& values);

/// The x of matrix x = right, the matrix symmetric and positive semidefinite, by the decomposition L D L^T.
/// Of a singular matrix the directions without a pivot are 0.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// The inverse of a symmetric, positive definite matrix, by the same decomposition: the caller sees to it
/// that no column depends on others.
Eigen::MatrixXd symmetric_inverse(const Eigen::MatrixXd& matrix);

}  // namespace trunnion::geometry

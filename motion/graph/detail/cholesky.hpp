#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>
#include <span>
#include <vector>

namespace sketchloc::detail {

/// The lower triangle of a symmetric sparse matrix, column by column; rows in ascending order, the
/// diagonal always there.
struct LowerPattern {
  std::vector<int> column_starts;  ///< one more than columns
  std::vector<int> rows;

  int size() const { return static_cast<int>(column_starts.size()) - 1; }
};

/// In which order to eliminate, so that little fills in: position -> index. Minimum degree, then
/// postordered.
std::vector<int> elimination_order(const LowerPattern& pattern);

/// Sparse Cholesky factors of matrices of one pattern, which is in the order of elimination.
class Cholesky {
 public:
  explicit Cholesky(const LowerPattern& pattern);
  ~Cholesky();
  Cholesky(Cholesky&& other) noexcept;
  Cholesky& operator=(Cholesky&& other) noexcept;

  /// False where the matrix is not positive definite; then nothing can be solved.
  bool factorise(std::span<const double> values);
  /// The same of a Hermitian matrix.
  bool factorise(std::span<const std::complex<double>> values);
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  Eigen::VectorXcd solve(const Eigen::VectorXcd& right) const;
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& right) const;
  Eigen::MatrixX2d solve(const Eigen::MatrixX2d& right) const;

 private:
  struct Parts;
  bool factorise(const void* values, int xtype);

  std::unique_ptr<Parts> parts_;
};

}  // namespace sketchloc::detail

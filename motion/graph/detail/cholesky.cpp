#include "motion/graph/detail/cholesky.hpp"

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <new>

#include "motion/check.hpp"

namespace sketchloc::detail {
namespace {

/// Operations per entry of the factor from which supernodes are faster. Pose graphs of 10 000
/// vertices have 90; with a reference BLAS supernodes take twice as long there.
constexpr double kSupernodalFrom = 250.0;

/// CHOLMOD's settings and memory.
class Common {
 public:
  Common() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.try_catch = 1;  // a matrix that is not positive definite is no reason to print
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_NATURAL;
    common_.postorder = 0;
    common_.final_ll = 1;
    common_.supernodal_switch = kSupernodalFrom;
  }
  ~Common() { cholmod_finish(&common_); }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;

  cholmod_common* operator&() { return &common_; }
  cholmod_common* operator->() { return &common_; }

 private:
  cholmod_common common_{};
};

/// A view of our arrays as CHOLMOD's matrix. CHOLMOD does not change its input.
cholmod_sparse view_of(const LowerPattern& pattern, const void* values, int xtype) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(pattern.size());
  view.nzmax = pattern.rows.size();
  view.p = const_cast<int*>(pattern.column_starts.data());
  view.i = const_cast<int*>(pattern.rows.data());
  view.x = const_cast<void*>(values);
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = xtype;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

/// Memory is the only thing that can run out in what we ask for.
void expect_memory(bool has_memory) {
  if (!has_memory) {
    throw std::bad_alloc();
  }
}

}  // namespace

std::vector<int> elimination_order(const LowerPattern& pattern) {
  Common common;
  common->method[0].ordering = CHOLMOD_AMD;
  common->postorder = 1;
  common->supernodal = CHOLMOD_SIMPLICIAL;
  cholmod_sparse matrix = view_of(pattern, nullptr, CHOLMOD_PATTERN);
  cholmod_factor* factor = cholmod_analyze(&matrix, &common);
  expect_memory(factor != nullptr);
  const int* order = static_cast<const int*>(factor->Perm);
  std::vector<int> result(order, order + pattern.size());
  cholmod_free_factor(&factor, &common);
  return result;
}

struct Cholesky::Parts {
  LowerPattern pattern;
  Common common;
  cholmod_factor* factor = nullptr;
  bool is_solvable = false;

  ~Parts() { cholmod_free_factor(&factor, &common); }
};

Cholesky::Cholesky(const LowerPattern& pattern) : parts_(std::make_unique<Parts>()) {
  parts_->pattern = pattern;
  cholmod_sparse matrix = view_of(parts_->pattern, nullptr, CHOLMOD_PATTERN);
  parts_->factor = cholmod_analyze(&matrix, &parts_->common);
  expect_memory(parts_->factor != nullptr);
}

Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&& other) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&& other) noexcept = default;

bool Cholesky::factorise(std::span<const double> values) {
  check(values.size() == parts_->pattern.rows.size(), "values of the pattern");
  return factorise(values.data(), CHOLMOD_REAL);
}

bool Cholesky::factorise(std::span<const std::complex<double>> values) {
  check(values.size() == parts_->pattern.rows.size(), "values of the pattern");
  return factorise(values.data(), CHOLMOD_COMPLEX);
}

bool Cholesky::factorise(const void* values, int xtype) {
  cholmod_factor& factor = *parts_->factor;
  if (factor.xtype != CHOLMOD_PATTERN && factor.xtype != xtype) {  // back to what was analysed
    cholmod_change_factor(CHOLMOD_PATTERN, 1, 0, 1, 1, &factor, &parts_->common);
  }
  cholmod_sparse matrix = view_of(parts_->pattern, values, xtype);
  cholmod_factorize(&matrix, parts_->factor, &parts_->common);
  expect_memory(parts_->common->status != CHOLMOD_OUT_OF_MEMORY);
  parts_->is_solvable = parts_->common->status == CHOLMOD_OK &&
                        parts_->factor->minor == static_cast<std::size_t>(parts_->pattern.size());
  return parts_->is_solvable;
}

namespace {

/// A view of our numbers as CHOLMOD's dense matrix.
template <typename Dense>
cholmod_dense view_of(const Dense& dense, int xtype) {
  cholmod_dense view{};
  view.nrow = static_cast<std::size_t>(dense.rows());
  view.ncol = static_cast<std::size_t>(dense.cols());
  view.nzmax = view.nrow * view.ncol;
  view.d = view.nrow;
  view.x = const_cast<typename Dense::Scalar*>(dense.data());
  view.xtype = xtype;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

template <typename Dense>
Dense solution_of(cholmod_factor& factor, const Dense& right, int xtype, cholmod_common& common) {
  cholmod_dense view = view_of(right, xtype);
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, &factor, &view, &common);
  expect_memory(solution != nullptr);
  const Dense result = Eigen::Map<const Dense>(
      static_cast<const typename Dense::Scalar*>(solution->x), right.rows(), right.cols());
  cholmod_free_dense(&solution, &common);
  return result;
}

}  // namespace

Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& right) const {
  check(parts_->is_solvable && right.rows() == parts_->pattern.size(), "a system with a factor");
  return solution_of(*parts_->factor, right, CHOLMOD_REAL, *&parts_->common);
}

Eigen::VectorXcd Cholesky::solve(const Eigen::VectorXcd& right) const {
  check(parts_->is_solvable && right.rows() == parts_->pattern.size(), "a system with a factor");
  return solution_of(*parts_->factor, right, CHOLMOD_COMPLEX, *&parts_->common);
}

Eigen::MatrixX2d Cholesky::solve(const Eigen::MatrixX2d& right) const {
  check(parts_->is_solvable && right.rows() == parts_->pattern.size(), "a system with a factor");
  return solution_of(*parts_->factor, right, CHOLMOD_REAL, *&parts_->common);
}

Eigen::MatrixXd Cholesky::solve_columns(const Eigen::MatrixXd& right) const {
  check(parts_->is_solvable && right.rows() == parts_->pattern.size(), "a system with a factor");
  return solution_of(*parts_->factor, right, CHOLMOD_REAL, *&parts_->common);
}

}  // namespace sketchloc::detail

// SPDX-License-Identifier: GPL-3.0-or-later
// Explicit instances of Eigen's costly templates for real matrices of any size: products, factorisations.
//
// No file needs to include this. The precompiled headers bring it to every file (tisserand_precompile in
// cmake/Warnings.cmake). Without them each file instantiates what it uses: same results, longer compilation.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#ifndef TISSERAND_INSTANCE
#define TISSERAND_INSTANCE extern template
#endif

namespace Eigen {
namespace internal {

// Products: the kernels of general_matrix_matrix_product, their packing, and matrix times vector.
using Blocking = gebp_traits<double, double>;
template <int order>
using ConstMapper = const_blas_data_mapper<double, Index, order>;
TISSERAND_INSTANCE struct gebp_kernel<double, double, Index, blas_data_mapper<double, Index, ColMajor, Unaligned, 1>,
                                      Blocking::mr, Blocking::nr>;
TISSERAND_INSTANCE struct gemm_pack_lhs<double, Index, ConstMapper<ColMajor>, Blocking::mr, Blocking::LhsProgress,
                                        Blocking::LhsPacket4Packing, ColMajor>;
TISSERAND_INSTANCE struct gemm_pack_lhs<double, Index, ConstMapper<RowMajor>, Blocking::mr, Blocking::LhsProgress,
                                        Blocking::LhsPacket4Packing, RowMajor>;
TISSERAND_INSTANCE struct gemm_pack_rhs<double, Index, ConstMapper<ColMajor>, Blocking::nr, ColMajor>;
TISSERAND_INSTANCE struct gemm_pack_rhs<double, Index, ConstMapper<RowMajor>, Blocking::nr, RowMajor>;
TISSERAND_INSTANCE struct general_matrix_vector_product<Index, double, ConstMapper<ColMajor>, ColMajor, false, double,
                                                        ConstMapper<RowMajor>, false>;
TISSERAND_INSTANCE struct general_matrix_vector_product<Index, double, ConstMapper<ColMajor>, ColMajor, false, double,
                                                        ConstMapper<ColMajor>, false>;
TISSERAND_INSTANCE struct general_matrix_vector_product<Index, double, ConstMapper<RowMajor>, RowMajor, false, double,
                                                        ConstMapper<ColMajor>, false>;
TISSERAND_INSTANCE struct general_matrix_vector_product<Index, double, ConstMapper<RowMajor>, RowMajor, false, double,
                                                        ConstMapper<RowMajor>, false>;

// Triangular systems; transposed ones are read by rows.
TISSERAND_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, Lower, false, ColMajor, ColMajor, 1>;
TISSERAND_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, UnitLower, false, ColMajor, ColMajor, 1>;
TISSERAND_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, ColMajor, ColMajor, 1>;
TISSERAND_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, RowMajor, ColMajor, 1>;
TISSERAND_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, UnitUpper, false, RowMajor, ColMajor, 1>;
TISSERAND_INSTANCE struct triangular_solve_matrix<double, Index, OnTheRight, Upper, false, RowMajor, ColMajor, 1>;

// Symmetric eigenvalues of any expression.
TISSERAND_INSTANCE void tridiagonalization_inplace<MatrixXd, VectorXd, VectorXd, VectorXd>(MatrixXd&, VectorXd&,
                                                                                           VectorXd&, VectorXd&, bool);
TISSERAND_INSTANCE ComputationInfo computeFromTridiagonal_impl<MatrixXd, VectorXd, VectorXd>(VectorXd&, VectorXd&,
                                                                                             const Index, bool,
                                                                                             MatrixXd&);

}  // namespace internal

// Factorisations of plain matrices.
TISSERAND_INSTANCE class LLT<MatrixXd>;
TISSERAND_INSTANCE LLT<MatrixXd>& LLT<MatrixXd>::compute<MatrixXd>(const EigenBase<MatrixXd>&);
TISSERAND_INSTANCE class LDLT<MatrixXd>;
TISSERAND_INSTANCE LDLT<MatrixXd>& LDLT<MatrixXd>::compute<MatrixXd>(const EigenBase<MatrixXd>&);
TISSERAND_INSTANCE class PartialPivLU<MatrixXd>;
TISSERAND_INSTANCE class FullPivLU<MatrixXd>;
TISSERAND_INSTANCE class HouseholderQR<MatrixXd>;
TISSERAND_INSTANCE class ColPivHouseholderQR<MatrixXd>;
TISSERAND_INSTANCE class CompleteOrthogonalDecomposition<MatrixXd>;
TISSERAND_INSTANCE class JacobiSVD<MatrixXd>;
TISSERAND_INSTANCE class SelfAdjointEigenSolver<MatrixXd>;
TISSERAND_INSTANCE SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute<MatrixXd>(
    const EigenBase<MatrixXd>&, int);
TISSERAND_INSTANCE class GeneralizedSelfAdjointEigenSolver<MatrixXd>;

// Solutions with plain right-hand sides.
TISSERAND_INSTANCE void LLT<MatrixXd>::_solve_impl_transposed<true, MatrixXd, MatrixXd>(const MatrixXd&,
                                                                                        MatrixXd&) const;
TISSERAND_INSTANCE void LLT<MatrixXd>::_solve_impl_transposed<true, VectorXd, VectorXd>(const VectorXd&,
                                                                                        VectorXd&) const;
TISSERAND_INSTANCE void LDLT<MatrixXd>::_solve_impl_transposed<true, MatrixXd, MatrixXd>(const MatrixXd&,
                                                                                         MatrixXd&) const;
TISSERAND_INSTANCE void LDLT<MatrixXd>::_solve_impl_transposed<true, VectorXd, VectorXd>(const VectorXd&,
                                                                                         VectorXd&) const;
TISSERAND_INSTANCE void ColPivHouseholderQR<MatrixXd>::_solve_impl<MatrixXd, MatrixXd>(const MatrixXd&,
                                                                                       MatrixXd&) const;
TISSERAND_INSTANCE void ColPivHouseholderQR<MatrixXd>::_solve_impl<VectorXd, VectorXd>(const VectorXd&,
                                                                                       VectorXd&) const;
TISSERAND_INSTANCE void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl<MatrixXd, MatrixXd>(const MatrixXd&,
                                                                                                   MatrixXd&) const;
TISSERAND_INSTANCE void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl<VectorXd, VectorXd>(const VectorXd&,
                                                                                                   VectorXd&) const;
TISSERAND_INSTANCE void FullPivLU<MatrixXd>::_solve_impl<MatrixXd, MatrixXd>(const MatrixXd&, MatrixXd&) const;
TISSERAND_INSTANCE void FullPivLU<MatrixXd>::_solve_impl<VectorXd, VectorXd>(const VectorXd&, VectorXd&) const;
TISSERAND_INSTANCE void HouseholderQR<MatrixXd>::_solve_impl<MatrixXd, MatrixXd>(const MatrixXd&, MatrixXd&) const;
TISSERAND_INSTANCE void HouseholderQR<MatrixXd>::_solve_impl<VectorXd, VectorXd>(const VectorXd&, VectorXd&) const;

}  // namespace Eigen

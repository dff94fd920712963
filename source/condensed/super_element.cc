// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/condensed/super_element.h"

#include "conetact/condensed/free_motion.h"
#include "conetact/solvers/null_space.h"

#include <deal.II/base/exceptions.h>

#include <lapacke.h>

#include <cmath>

namespace conetact::condensed
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;
    using SparseMatrix = Eigen::SparseMatrix<double>;
    using Places       = Eigen::PermutationMatrix<Eigen::Dynamic>;

    /** Places of unknowns: those that are retained come last, all others first,
     * both in the order that they have. */
    Places
    retained_last(const Index n, const std::vector<Index> &retained)
    {
      Places place(n);
      place.indices().setConstant(-1);
      auto next = static_cast<int>(n - static_cast<Index>(retained.size()));
      for (const Index p : retained)
        place.indices()[p] = next++;
      next = 0;
      for (int &p : place.indices())
        if (p < 0)
          p = next++;
      return place;
    }

    SparseMatrix
    sorted(const SparseMatrix &upper, const Places &place, const double scale)
    {
      SparseMatrix result(upper.rows(), upper.cols());
      result.selfadjointView<Eigen::Upper>() =
        upper.selfadjointView<Eigen::Upper>().twistedBy(place);
      result /= scale;
      return result;
    }

    std::vector<unsigned int>
    sorted(const std::vector<unsigned int> &nodes, const Places &place)
    {
      std::vector<unsigned int> result(nodes.size());
      for (std::size_t i = 0; i < nodes.size(); ++i)
        result[static_cast<std::size_t>(
          place.indices()[static_cast<Index>(i)])] = nodes[i];
      return result;
    }

    /** The mean entry of the diagonal, as a power of two: dividing by it rounds
     * nothing. */
    double
    mean_diagonal(const SparseMatrix &upper)
    {
      const double mean =
        upper.cols() > 0 ? upper.diagonal().sum() / double(upper.cols()) : 1.;
      return mean > 0 ? std::exp2(std::round(std::log2(mean))) : 1.;
    }

    /** From the Cholesky factor, in n^3 operations: to solve for the columns of
     * a unit matrix would take twice as many. Throws SingularMatrix. */
    MatrixXd
    inverse(MatrixXd A)
    {
      const auto n = static_cast<lapack_int>(A.rows());
      if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, A.data(), n) != 0 ||
          LAPACKE_dpotri_work(LAPACK_COL_MAJOR, 'L', n, A.data(), n) != 0)
        throw SingularMatrix({});
      A.triangularView<Eigen::StrictlyUpper>() =
        A.triangularView<Eigen::StrictlyLower>().transpose();
      return A;
    }

    /** P of a Schur complement S. Throws SingularMatrix. */
    MatrixXd
    inverse_without_motions(const MatrixXd &S, const MatrixXd &B)
    {
      if (S.rows() == 0)
        return S;
      // Any alpha > 0 gives the same P: it stiffens the motions B, which are
      // taken out below. Of the size of S it leaves the condition of the rest
      // alone.
      const double   alpha = S.diagonal().mean();
      const MatrixXd T     = inverse(S + alpha * B * B.transpose());
      // A body that supports or foundations hold has no free motion: P = S^-1.
      if (B.cols() == 0)
        return T;
      const MatrixXd TB = T * B;
      // The response to f and to forces along B such that B^T w = 0.
      MatrixXd P = T - TB * (B.transpose() * TB).ldlt().solve(TB.transpose());
      // (1 - B B^T) P (1 - B B^T): the rounding of T is not free of motions.
      P -= B * (B.transpose() * P).eval();
      P -= (P * B).eval() * B.transpose();
      return .5 * (P + P.transpose());
    }
  } // namespace

  SuperElement::SuperElement(const SparseMatrix              &upper,
                             const std::vector<unsigned int> &node_of,
                             const std::vector<Index>        &retained,
                             const Condenser                 &condenser)
    : kept(retained)
    , place(retained_last(upper.cols(), retained))
    , scale(mean_diagonal(upper)) // MUMPS has thresholds that know no units
    , factor(condenser.create(sorted(upper, place, scale),
                              static_cast<Index>(retained.size()),
                              sorted(node_of, place)))
    , S(factor->take_schur_complement())
  {}

  SuperElement::SuperElement(const SparseMatrix              &upper,
                             const std::vector<unsigned int> &node_of,
                             const std::vector<Index>        &retained,
                             const MatrixXd                  &motions,
                             const Condenser                 &condenser)
    : SuperElement(upper, node_of, retained, condenser)
  {
    AssertDimension(motions.rows(), upper.cols());
    P = inverse_without_motions(
          S, solvers::orthonormal_basis(motions(retained, Eigen::all))) /
        scale;
    const VectorXd stiffness = S.diagonal();
    S.resize(0, 0);
    // P_ii S_ii has no units and grows with slenderness. Slender beams may have
    // this, and so have mechanisms: strain energy tells which.
    constexpr double soft = 1e12;
    if ((scale * P.diagonal().array() * stiffness.array() > soft).any())
      refuse_free_motion(upper, deform(probe_load(upper.diagonal())), node_of);
  }

  FactorEstimate
  SuperElement::estimate(const SparseMatrix              &upper,
                         const std::vector<unsigned int> &node_of,
                         const std::vector<Index>        &retained,
                         const Condenser                 &condenser)
  {
    const Places place = retained_last(upper.cols(), retained);
    return condenser.estimate(sorted(upper, place, 1),
                              static_cast<Index>(retained.size()),
                              sorted(node_of, place));
  }

  MatrixXd
  SuperElement::take_stiffness()
  {
    AssertDimension(S.rows(), static_cast<Index>(kept.size()));
    MatrixXd result = scale * S;
    S.resize(0, 0);
    return result;
  }

  MatrixXd
  SuperElement::to_solver(const MatrixXd &x) const
  {
    AssertDimension(x.rows(), place.size());
    return place * x;
  }

  MatrixXd
  SuperElement::reduce(const MatrixXd &forces) const
  {
    Assert(forces.rows() > 0, dealii::ExcMessage("A body has unknowns."));
    return factor->reduce(to_solver(forces));
  }

  MatrixXd
  SuperElement::deform(const MatrixXd &forces) const
  {
    Assert(forces.allFinite(), dealii::ExcMessage("Forces are finite."));
    AssertDimension(P.rows(), static_cast<Index>(kept.size()));
    const MatrixXd b = to_solver(forces);
    // w_C = P (f_C - K_CF K_FF^-1 f_F) first, then K_FF w_F = f_F - K_FC w_C.
    // The factor is that of K / scale: loads are divided as well, P is that of
    // K.
    const MatrixXd w = P * factor->reduce(b);
    return place.transpose() * factor->expand(b / scale, w);
  }

  MatrixXd
  SuperElement::carry(const MatrixXd &forces, const MatrixXd &w) const
  {
    AssertDimension(forces.cols(), w.cols());
    return place.transpose() * factor->expand(to_solver(forces) / scale, w);
  }
} // namespace conetact::condensed

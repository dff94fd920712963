// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/errors.h"
#include "conetact/condensed/amesos_schur.h"
#include "conetact/condensed/condenser.h"
#include "conetact/condensed/mumps_schur.h"

#include <stdexcept>

namespace conetact::condensed
{
  namespace
  {
    using Eigen::Index;
    using SparseMatrix = Eigen::SparseMatrix<double>;
    using Nodes        = std::vector<unsigned int>;
    using Solver       = std::unique_ptr<SchurSolver>;

    /** The dense matrix takes 288 MB then. */
    constexpr Index most_of_lapack = 6000;

    void
    refuse_large(const SparseMatrix &upper, const Index n_schur)
    {
      if (const Index n = upper.cols() - n_schur; n > most_of_lapack)
        throw InputError(
          "Solver/Condensation: amesos_lapack is dense and takes " +
          std::to_string(most_of_lapack) +
          " unknowns at most besides those of contact nodes, here there are " +
          std::to_string(n) + ". Choose mumps or amesos_klu.");
    }

    Solver
    create_mumps(const SparseMatrix &upper,
                 const Index         n_schur,
                 const Nodes        &node_of)
    {
      return std::make_unique<MumpsSchur>(upper, n_schur, node_of);
    }

    /** A method of Amesos. */
    template <const char *name>
    Solver
    create_amesos(const SparseMatrix &upper,
                  const Index         n_schur,
                  const Nodes        &node_of)
    {
      return std::make_unique<AmesosSchur>(name, upper, n_schur, node_of);
    }
    constexpr char amesos_klu[]    = "Amesos_Klu";
    constexpr char amesos_mumps[]  = "Amesos_Mumps";
    constexpr char amesos_lapack[] = "Amesos_Lapack";

    Solver
    create_lapack(const SparseMatrix &upper,
                  const Index         n_schur,
                  const Nodes        &node_of)
    {
      refuse_large(upper, n_schur);
      return create_amesos<amesos_lapack>(upper, n_schur, node_of);
    }

    /**
     * The cost of a factor with `entries` entries in both triangles: 8 bytes an
     * entry, and two operations an entry for each of the n_schur right-hand
     * sides of A_FC, which go through it forwards and backwards.
     */
    FactorEstimate
    of_both_triangles(const double entries,
                      const double flops,
                      const Index  n_schur)
    {
      const double bytes = 8 * entries;
      return {bytes,
              bytes,
              flops + 2 * entries * static_cast<double>(n_schur),
              0};
    }

    /**
     * Estimates from below: Amesos tells nothing beforehand, so the order of
     * MUMPS is taken, whose fill others exceed, and both triangles, as Amesos
     * does not know that the matrix is symmetric.
     */
    FactorEstimate
    estimate_sparse(const SparseMatrix &upper,
                    const Index         n_schur,
                    const Nodes        &node_of)
    {
      const Index          n = upper.cols() - n_schur;
      const FactorEstimate half =
        MumpsSchur::estimate(with_ascending_rows(upper).topLeftCorner(n, n),
                             0,
                             Nodes(node_of.begin(), node_of.begin() + n));
      return of_both_triangles(2 * half.factor_bytes / 8,
                               2 * half.flops,
                               n_schur);
    }

    FactorEstimate
    estimate_lapack(const SparseMatrix &upper,
                    const Index         n_schur,
                    const Nodes &)
    {
      refuse_large(upper, n_schur);
      // LU of a dense matrix takes 2/3 n^3 operations.
      const auto n = static_cast<double>(upper.cols() - n_schur);
      return of_both_triangles(n * n, 2. / 3. * n * n * n, n_schur);
    }
  } // namespace



  const std::vector<Condenser> &
  condenser_table()
  {
    static const std::vector<Condenser> table = {
      {"mumps",
       "MUMPS itself, whose factorisation returns the condensed stiffness: "
       "the fastest",
       &create_mumps,
       &MumpsSchur::estimate},
      {"amesos_klu",
       "KLU of Trilinos' Amesos, an independent method to compare with; slow "
       "in space",
       &create_amesos<amesos_klu>,
       &estimate_sparse},
      {"amesos_mumps",
       "MUMPS as Amesos calls it, contact node by contact node",
       &create_amesos<amesos_mumps>,
       &estimate_sparse},
      {"amesos_lapack",
       "LAPACK of Amesos, dense, for small bodies (up to 6000 unknowns)",
       &create_lapack,
       &estimate_lapack},
    };
    return table;
  }



  const Condenser &
  default_condenser()
  {
    return condenser_table().front();
  }



  const Condenser &
  condenser_named(const std::string &name)
  {
    for (const Condenser &row : condenser_table())
      if (name == row.name)
        return row;
    throw std::invalid_argument("there is no condensation '" + name + "'");
  }



  const Condenser &
  independent_of(const Condenser &condenser)
  {
    const Condenser &mumps = default_condenser();
    return condenser.name == std::string(mumps.name) ?
             condenser_named("amesos_klu") :
             mumps;
  }
} // namespace conetact::condensed

// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/direct_system.h"

#include "conetact/base/index.h"
#include "conetact/base/team.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/SparseLU>

#include <algorithm>

namespace conetact::iterative
{
  using Eigen::Index;
  using Triplets = std::vector<Eigen::Triplet<double>>;

  DirectSystem::DirectSystem(const Elements          &elements,
                             solvers::ContactSystem &&contact,
                             const Index              n)
    : K(n, n)
    , layout(std::move(contact))
  {
    Assert(layout.n_unknowns() <= n,
           dealii::ExcMessage("Unknowns of contact are the last ones."));
    Triplets entries;
    elements.for_each([&](const std::vector<Index> &unknowns,
                          const double             *matrix) {
      // Elements of both triangles give each entry at its place: Newton's
      // matrix takes whole rows of K, and its unsymmetric factor both
      // triangles.
      const std::size_t size = unknowns.size();
      for (std::size_t a = 0; a < size; ++a)
        for (std::size_t b = 0; b < size; ++b)
          // One triangle is read, so that sums are symmetric to the last bit.
          entries.emplace_back(static_cast<int>(unknowns[a]),
                               static_cast<int>(unknowns[b]),
                               matrix[std::max(a, b) * size + std::min(a, b)]);
    });
    K.setFromTriplets(entries.begin(), entries.end());
  }



  /* Rows of K for unknowns that touch nothing, rows of P + D K for contact
     nodes, so that D (K du) is made of whole rows of K. Friction makes the
     matrix unsymmetric. */
  DirectSystem::Matrix
  DirectSystem::newton_matrix(const std::vector<solvers::NodeLaw> &laws) const
  {
    Assert(laws.empty() || laws.size() == at(layout.n_nodes()),
           dealii::ExcMessage("Each node has a law, or none has."));
    const Index begin = n_unknowns() - layout.n_unknowns();
    Triplets    entries;
    const auto  add_row_of_K =
      [&](const Index of, const double factor, const Index to) {
        for (Matrix::InnerIterator k(K, of); k; ++k)
          entries.emplace_back(static_cast<int>(to),
                               static_cast<int>(k.col()),
                               factor * k.value());
      };
    for (Index q = 0; q < begin; ++q)
      add_row_of_K(q, 1, q);
    for (std::size_t i = 0; i < laws.size(); ++i)
      for (Index r = 0; r < laws[i].h.size(); ++r)
        for (Index c = 0; c < laws[i].h.size(); ++c)
          {
            const Index first = begin + layout.first[i];
            if (laws[i].p(r, c) != 0)
              entries.emplace_back(static_cast<int>(first + r),
                                   static_cast<int>(first + c),
                                   laws[i].p(r, c));
            if (laws[i].d(r, c) != 0)
              add_row_of_K(first + c, laws[i].d(r, c), first + r);
          }
    Matrix result(n_unknowns(), n_unknowns());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }



  /* One step of iterative refinement takes away most of the rounding that the
     factor of a slender frame has. Machines round differently: all processes
     take the result of the first one. */
  std::optional<DirectSystem::Step>
  DirectSystem::solve(const std::vector<solvers::NodeLaw> &laws,
                      const Kept                          &f,
                      const Precision &) const
  {
    Matrix      matrix = newton_matrix(laws);
    Array       b      = -array(f);
    const Index begin  = n_unknowns() - layout.n_unknowns();
    for (std::size_t i = 0; i < laws.size(); ++i)
      b.segment(begin + layout.first[i], laws[i].h.size()) = laws[i].h;
    // Rows are forces, or displacements where a law says them: pivots can be
    // compared once the largest entry of each is one.
    for (Index q = 0; q < n_unknowns(); ++q)
      {
        double largest = 0;
        for (Matrix::InnerIterator k(matrix, q); k; ++k)
          largest = std::max(largest, std::abs(k.value()));
        if (largest == 0) // nothing resists the unknown
          return {};
        matrix.row(q) /= largest;
        b[q] /= largest;
      }
    // Each state has another pattern, and friction makes the matrix
    // unsymmetric: no order of elimination is kept from one step to the next.
    Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
    bool is_regular = solver.info() == Eigen::Success;
    first_decides(is_regular);
    if (!is_regular)
      return {};
    Array du = Array::Zero(n_unknowns());
    if (solver.info() == Eigen::Success)
      {
        du            = solver.solve(b);
        const Array r = b - matrix * du;
        du += solver.solve(r);
      }
    team().broadcast(du);
    const double size  = b.norm();
    double       error = size > 0 ? (b - matrix * du).norm() / size : 0.;
    first_decides(error);
    if (!du.allFinite())
      return {};
    return Step{keep(du), 1, error};
  }
} // namespace conetact::iterative

// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/condensation.h"

#include "conetact/solvers/null_space.h"

#include <cmath>

namespace conetact
{
  namespace
  {
    /** More different loads than this are forgotten and begun anew. */
    constexpr std::size_t largest_basis = 8;

    /** Mechanisms are searched for in systems up to this size. */
    constexpr Eigen::Index largest_rank_search = 2000;

    /** A power of two, so that dividing by it rounds nothing. */
    double
    mean_diagonal(const Eigen::SparseMatrix<double> &matrix)
    {
      const double mean =
        matrix.rows() == 0 ?
          0. :
          matrix.diagonal().sum() / static_cast<double>(matrix.rows());
      return mean > 0 ? std::exp2(std::round(std::log2(mean))) : 1.;
    }
  } // namespace

  Condensation::Condensation(const ElasticSystem   &e,
                             const Coordinates     &c,
                             const Eigen::MatrixXd &null_space,
                             const bool             find_mechanisms)
    : elastic(e)
    , coordinates(c)
  {
    Eigen::SparseMatrix<double> stiffness = assemble(elastic, coordinates);
    // MUMPS has thresholds of its own, which know no units.
    stiffness_scale = mean_diagonal(stiffness);
    stiffness /= stiffness_scale;
    solver = std::make_unique<SchurSolver>(stiffness,
                                           coordinates.n_contact_unknowns(),
                                           coordinates.node_of_unknowns());

    auto system    = std::make_shared<ContactSystem>(coordinates.layout());
    system->matrix = solver->take_schur_complement();
    system->matrix *= stiffness_scale;
    const Eigen::Index n = coordinates.n_contact_unknowns();
    system->null_space = find_mechanisms && n > 0 && n <= largest_rank_search ?
                           null_space_basis(system->matrix) :
                           null_space;
    contact_system     = system;
  }

  Condensation::Load
  Condensation::reduce(const Eigen::VectorXd &forces,
                       const Eigen::VectorXd &prescribed)
  {
    const Eigen::Index n = coordinates.n_dofs();
    Eigen::VectorXd    rest(2 * n);
    rest.head(n) = forces;
    rest.tail(n) = stiffness_scale * prescribed;

    const double size = rest.norm();
    Load         load{prescribed,
              Eigen::VectorXd::Zero(coordinates.n_unknowns()),
              Eigen::VectorXd::Zero(coordinates.n_contact_unknowns()),
              Eigen::VectorXd::Zero(is_linear() ? coordinates.n_unknowns() :
                                                  0)};
    const auto   project = [&] {
      for (std::size_t i = 0; i < basis.size(); ++i)
        {
          const double part = basis[i].dot(rest);
          rest -= part * basis[i];
          load.b += part * basis_b[i];
          load.f += part * basis_f[i];
          load.q += part * basis_q[i];
        }
    };
    project();
    project(); // twice is enough for orthogonality to round-off
    const double norm = rest.norm();
    if (norm <= 1e-15 * size)
      return load;

    if (basis.size() == largest_basis)
      {
        basis.clear();
        basis_b.clear();
        basis_f.clear();
        basis_q.clear();
      }
    rest /= norm;
    basis.push_back(rest);
    basis_b.push_back(coordinates.restrict(
      rest.head(n) - elastic.internal_forces(rest.tail(n) / stiffness_scale)));
    basis_f.push_back(solver->reduce(basis_b.back()));
    basis_q.push_back(is_linear() ? solve(basis_b.back()) : Eigen::VectorXd());
    ++n_reduced;
    load.b += norm * basis_b.back();
    load.f += norm * basis_f.back();
    load.q += norm * basis_q.back();
    return load;
  }

  Eigen::MatrixXd
  Condensation::expand(const std::vector<Load>            &loads,
                       const std::vector<Eigen::VectorXd> &contact) const
  {
    // Where nothing has changed the displacements are those before.
    std::vector<std::size_t>  different;
    std::vector<Eigen::Index> column;
    for (std::size_t k = 0; k < loads.size(); ++k)
      {
        if (k == 0 || loads[k].b != loads[k - 1].b ||
            contact[k] != contact[k - 1])
          different.push_back(k);
        column.push_back(static_cast<Eigen::Index>(different.size()) - 1);
      }
    const auto      n = static_cast<Eigen::Index>(different.size());
    Eigen::MatrixXd b(coordinates.n_unknowns(), n);
    Eigen::MatrixXd q_contact(coordinates.n_contact_unknowns(), n);
    for (Eigen::Index i = 0; i < n; ++i)
      {
        const std::size_t k = different[static_cast<std::size_t>(i)];
        b.col(i)            = is_linear() ? loads[k].q : loads[k].b;
        q_contact.col(i)    = contact[k];
      }
    const Eigen::MatrixXd q =
      is_linear() ? b : solver->expand(b / stiffness_scale, q_contact);
    Eigen::MatrixXd u(coordinates.n_dofs(),
                      static_cast<Eigen::Index>(loads.size()));
    for (std::size_t k = 0; k < loads.size(); ++k)
      u.col(static_cast<Eigen::Index>(k)) =
        coordinates.expand(q.col(column[k])) + loads[k].prescribed;
    return u;
  }

  bool
  Condensation::is_linear() const
  {
    return coordinates.n_contact_unknowns() == 0;
  }

  Eigen::VectorXd
  Condensation::solve(const Eigen::VectorXd &b) const
  {
    return solver->expand(b / stiffness_scale, Eigen::MatrixXd(0, 1));
  }

  Eigen::VectorXd
  Condensation::reduce_unbalanced(const Eigen::VectorXd &unbalanced) const
  {
    return solver->reduce(unbalanced);
  }

  Eigen::VectorXd
  Condensation::correction(const Eigen::VectorXd &unbalanced,
                           const Eigen::VectorXd &contact) const
  {
    return coordinates.expand(
      solver->expand(-unbalanced / stiffness_scale, contact));
  }

  FactorEstimate
  estimate_condensation(const ElasticSystem &elastic,
                        const Coordinates   &coordinates)
  {
    return SchurSolver::estimate(assemble(elastic, coordinates),
                                 coordinates.n_contact_unknowns(),
                                 coordinates.node_of_unknowns());
  }
} // namespace conetact

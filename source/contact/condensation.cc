// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/condensation.h"

#include "conetact/solvers/null_space.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace conetact::contact
{
  namespace
  {
    /** Mechanisms are searched for in systems up to this size. */
    constexpr Eigen::Index largest_rank_search = 2000;

    /** A power of two, so that dividing by it rounds nothing. */
    double
    mean_diagonal(const Eigen::SparseMatrix<double> &upper)
    {
      const double sum = upper.diagonal().sum();
      return sum > 0 ? std::exp2(std::round(
                         std::log2(sum / static_cast<double>(upper.cols())))) :
                       1.;
    }

    /** The elastic system with its unknowns in other places, if any. */
    struct Sorted
    {
      Eigen::SparseMatrix<double> upper;
      std::vector<unsigned int>   node_of;
    };

    Sorted
    sorted(const ElasticSystem &elastic,
           const Coordinates   &coordinates,
           const Places        &place)
    {
      Sorted result = {assemble(elastic, coordinates),
                       coordinates.node_of_unknowns()};
      if (place.size() == 0)
        return result;
      Eigen::SparseMatrix<double> upper(result.upper.rows(),
                                        result.upper.cols());
      // P A P^T, of which again only the upper triangle is written.
      upper.selfadjointView<Eigen::Upper>() =
        result.upper.selfadjointView<Eigen::Upper>().twistedBy(place);
      result.upper.swap(upper);
      for (Eigen::Index q = 0; q < place.size(); ++q)
        result.node_of[static_cast<std::size_t>(place.indices()[q])] =
          coordinates.node_of_unknowns()[static_cast<std::size_t>(q)];
      return result;
    }

    /** Places of the unknowns with those of the set last; empty: as they are.
     */
    Places
    set_last(const Coordinates &coordinates, const WorkingSet &set)
    {
      Places place;
      // contact unknowns are the last ones already
      if (set.is_all())
        return place;
      place.resize(coordinates.n_unknowns());
      place.indices().setConstant(-1);
      const Eigen::Index n_free =
        coordinates.n_unknowns() - coordinates.n_contact_unknowns();
      auto next =
        static_cast<int>(coordinates.n_unknowns() - set.layout().n_unknowns());
      for (const Eigen::Index c : set.unknowns())
        place.indices()[n_free + c] = next++;
      next = 0;
      for (int &p : place.indices())
        if (p < 0)
          p = next++;
      return place;
    }
  } // namespace

  Condensation::Condensation(const ElasticSystem       &e,
                             const NodeRules           &supports,
                             const ContactPoints       &p,
                             const WorkingSet          &s,
                             const Eigen::MatrixXd     &null_space,
                             const bool                 find_mechanisms,
                             const backends::Condenser &condenser)
    : ElasticBackend(s)
    , elastic(e)
    , points(p)
    , coordinates(elastic.bodies, supports, &points)
    , rigid(null_space)
    , place(set_last(coordinates, set))
  {
    const Eigen::Index n = set.layout().n_unknowns();
    {
      // Given back as soon as it is factorised: it is large.
      Sorted matrix = sorted(elastic, coordinates, place);
      // MUMPS has thresholds of its own, which know no units.
      stiffness_scale = mean_diagonal(matrix.upper);
      matrix.upper /= stiffness_scale;
      solver = std::make_unique<backends::ExtendedSchur>(matrix.upper,
                                                         n,
                                                         matrix.node_of,
                                                         condenser);
    }

    auto system    = std::make_shared<solvers::ContactSystem>(set.layout());
    system->matrix = solver->base().take_schur_complement();
    system->matrix *= stiffness_scale;
    // Frames may have motions that nobody has named; those of other bodies
    // are rigid, and known to the last digit.
    system->null_space =
      find_mechanisms && n > 0 && n <= largest_rank_search ?
        solvers::null_space_basis(system->matrix, set.gather(null_space)) :
        set.gather(null_space);
    contact_system = system;
  }

  Eigen::MatrixXd
  Condensation::to_solver(Eigen::MatrixXd b) const
  {
    if (place.size() > 0)
      b = place * b;
    return b;
  }

  Eigen::MatrixXd
  Condensation::from_solver(Eigen::MatrixXd b) const
  {
    if (place.size() > 0)
      b = place.transpose() * b;
    return b;
  }

  bool
  Condensation::extend(const std::vector<Eigen::Index> &nodes)
  {
    const WorkingSet added(points.layout(), nodes);
    if (!solver->base().extension_is_cheaper(added.layout().n_unknowns()))
      return false;
    std::vector<Eigen::Index> all = set.nodes();
    all.insert(all.end(), nodes.begin(), nodes.end());
    set = WorkingSet(points.layout(), all);

    std::vector<Eigen::Index> unknowns;
    for (const Eigen::Index c : added.unknowns())
      unknowns.push_back(place.indices()[coordinates.n_unknowns() -
                                         coordinates.n_contact_unknowns() + c]);
    auto system = std::make_shared<solvers::ContactSystem>(set.layout());
    // The factor knows the scaled matrix only.
    system->matrix = contact_system->matrix / stiffness_scale;
    solver->extend(unknowns, system->matrix);
    system->matrix *= stiffness_scale;
    // Mechanisms make the set that of all candidates: here are rigid motions
    // only.
    system->null_space = set.gather(rigid);
    contact_system     = system;
    // Loads have rows for the new unknowns now.
    reduce_again();
    return true;
  }

  // Bodies that meet obstacles only do not see each other: each has rows of
  // its own.
  std::vector<StiffnessDifference>
  Condensation::compare(const backends::Condenser &other) const
  {
    Sorted matrix = sorted(elastic, coordinates, set_last(coordinates, set));
    matrix.upper /= stiffness_scale;
    const Eigen::MatrixXd &K = contact_system->matrix;
    const Eigen::MatrixXd  K_2 =
      stiffness_scale * other.create(matrix.upper, K.cols(), matrix.node_of)
                          ->take_schur_complement();
    std::map<unsigned int, std::pair<double, double>> largest;
    for (std::size_t i = 0; i < set.nodes().size(); ++i)
      {
        const auto rows =
          Eigen::seq(set.layout().first[i], set.layout().first[i + 1] - 1);
        const Eigen::Index p      = set.nodes()[i];
        auto &[difference, entry] = largest[points[p].node->body];
        if (rows.size() == 0)
          continue;
        difference =
          std::max(difference,
                   (K - K_2)(rows, Eigen::all).cwiseAbs().maxCoeff());
        entry = std::max(entry, K(rows, Eigen::all).cwiseAbs().maxCoeff());
      }
    std::vector<StiffnessDifference> result;
    for (const auto &[body, found] : largest)
      result.push_back({{body}, found.first / found.second});
    return result;
  }

  void
  Condensation::reduce_one(const Eigen::VectorXd &forces,
                           const Eigen::VectorXd &prescribed,
                           LoadCase              &load)
  {
    // C^T (f - K d): what is prescribed acts as a load on the rest.
    load.b = coordinates.restrict(forces - elastic.internal_forces(prescribed));
    load.f = reduce_forces(load.b);
    if (is_linear())
      // No contact unknowns: the load case is solved once for all.
      load.q = solve(load.b);
  }

  LoadCase
  Condensation::nothing() const
  {
    LoadCase load;
    load.b = Eigen::VectorXd::Zero(coordinates.n_unknowns());
    load.f = Eigen::VectorXd::Zero(set.layout().n_unknowns());
    if (is_linear())
      load.q = load.b;
    return load;
  }

  Eigen::VectorXd
  Condensation::reduce_forces(const Eigen::VectorXd &b) const
  {
    return solver->reduce(to_solver(b));
  }

  Eigen::MatrixXd
  Condensation::expand(const std::vector<const LoadCase *> &loads,
                       const std::vector<Eigen::VectorXd>  &primal) const
  {
    AssertDimension(loads.size(), primal.size());
    // Where nothing has changed the displacements are those before.
    std::vector<std::size_t>  different;
    std::vector<Eigen::Index> column;
    for (std::size_t k = 0; k < loads.size(); ++k)
      {
        if (k == 0 || loads[k]->b != loads[k - 1]->b ||
            primal[k] != primal[k - 1])
          different.push_back(k);
        column.push_back(static_cast<Eigen::Index>(different.size()) - 1);
      }
    const auto      n = static_cast<Eigen::Index>(different.size());
    Eigen::MatrixXd q(coordinates.n_unknowns(), n);
    Eigen::MatrixXd contact(set.layout().n_unknowns(), n);
    Eigen::MatrixXd reduced(contact.rows(), n);
    for (Eigen::Index i = 0; i < n; ++i)
      {
        const std::size_t k = different[static_cast<std::size_t>(i)];
        // A column of the right-hand side for each different load case: many of
        // them cost little more than one.
        q.col(i)       = is_linear() ? loads[k]->q : loads[k]->b;
        contact.col(i) = primal[k];
        if (solver->is_extended())
          reduced.col(i) = loads[k]->f;
      }
    if (!is_linear())
      q = expand_unknowns(std::move(q), contact, reduced);
    Eigen::MatrixXd w(coordinates.n_dofs(),
                      static_cast<Eigen::Index>(loads.size()));
    for (std::size_t k = 0; k < loads.size(); ++k)
      w.col(static_cast<Eigen::Index>(k)) =
        coordinates.expand(q.col(column[k])) + loads[k]->prescribed;
    return w;
  }

  bool
  Condensation::is_linear() const
  {
    return coordinates.n_contact_unknowns() == 0;
  }

  Eigen::VectorXd
  Condensation::solve(const Eigen::VectorXd &b) const
  {
    return expand_unknowns(b, Eigen::MatrixXd(0, 1), Eigen::MatrixXd(0, 1));
  }

  Eigen::MatrixXd
  Condensation::expand_unknowns(Eigen::MatrixXd        b,
                                const Eigen::MatrixXd &contact,
                                const Eigen::MatrixXd &reduced) const
  {
    // Forces over the scale of K leave displacements as they are.
    b /= stiffness_scale;
    return from_solver(solver->expand(to_solver(std::move(b)),
                                      contact,
                                      reduced / stiffness_scale));
  }

  /* `unbalanced` is K w - f: what takes it away has the other sign. */
  LoadCase
  Condensation::reduce_unbalanced(const Eigen::VectorXd &unbalanced) const
  {
    LoadCase change;
    change.b = -coordinates.restrict(unbalanced);
    change.f = reduce_forces(change.b);
    return change;
  }

  Eigen::VectorXd
  Condensation::correction(const LoadCase        &change,
                           const Eigen::VectorXd &primal) const
  {
    return coordinates.expand(expand_unknowns(change.b, primal, change.f));
  }

  backends::FactorEstimate
  estimate_condensation(const ElasticSystem       &elastic,
                        const NodeRules           &supports,
                        const ContactPoints       &points,
                        const WorkingSet          &set,
                        const backends::Condenser &condenser)
  {
    const Coordinates coordinates(elastic.bodies, supports, &points);
    const Sorted      matrix =
      sorted(elastic, coordinates, set_last(coordinates, set));
    return condenser.estimate(matrix.upper,
                              set.layout().n_unknowns(),
                              matrix.node_of);
  }
} // namespace conetact::contact

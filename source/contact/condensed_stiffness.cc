// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/condensed_stiffness.h"

#include "conetact/base/index.h"
#include "conetact/contact/large_nodes.h"
#include "conetact/solvers/null_space.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /** Mechanisms are searched for in systems up to this size. */
    constexpr Index largest_rank_search = 2000;

    std::vector<Index>
    own_unknowns(const ContactPoints &points, const BodyCoordinates &own)
    {
      std::vector<Index> result;
      for (const ContactPoint &point : points)
        for (std::size_t k = 0; k < point.directions.size(); ++k)
          result.push_back(own.first_of(point) + static_cast<Index>(k));
      return result;
    }

    /** Bodies keep the unknowns of contacts, and no others. */
    CondensedBodies
    bodies_with(const ElasticSystem        &elastic,
                const BodyCoordinates      &own,
                const condensed::Condenser &condenser,
                const std::vector<Index>   &contact)
    {
      std::vector<bool> kept(at(own.n_unknowns()), false);
      for (const Index p : contact)
        kept[at(p)] = true;
      return {elastic,
              own,
              condenser,
              {},
              [&](const unsigned int body, std::vector<bool> &of_body) {
                for (std::size_t i = 0; i < of_body.size(); ++i)
                  of_body[i] = kept[at(own.begin(body)) + i];
              }};
    }

    /** The numbers among all own unknowns of those that a part has retained. */
    std::vector<Index>
    retained_rows(const CondensedBodies::Part &part,
                  const unsigned int           body,
                  const BodyCoordinates       &own)
    {
      std::vector<Index> rows = part.retained;
      for (Index &row : rows)
        row += own.begin(body);
      return rows;
    }

    /** The elastic displacements of contact unknowns by themselves: v - o would
     * round them where bodies have moved far. */
    class StatesOfStiffness : public ElasticStates
    {
    public:
      StatesOfStiffness(const Index n_unknowns, const RigidMotions &m)
        : n(n_unknowns)
        , motions(m)
      {}

      void
      begin(const ElasticState    &state,
            solvers::ContactState &start) const override
      {
        start.u = primal(state, start.r);
      }
      void
      end(const solvers::ContactState &end, ElasticState &state) const override
      {
        if (end.u.size() == n)
          state.start = shared(end.u);
      }
      VectorXd
      primal(const ElasticState &state, const VectorXd &) const override
      {
        return state.start ? *state.start : VectorXd::Zero(n);
      }
      void
      move(const VectorXd &,
           const VectorXd        &seen,
           solvers::ContactState &end) const override
      {
        AssertDimension(seen.size(), end.u.size());
        end.u += seen;
      }
      /** The iterative Elasticity, which a checkpoint may come from, has
       * contact unknowns behind all others; without them displacements q tell.
       * One stiffness of all knows no motions apart from displacements: G a is
       * added. */
      void
      restore(const std::vector<double> &start,
              const VectorXd            &q,
              ElasticState              &state) const override
      {
        VectorXd u = q;
        if (start.size() >= at(q.size()))
          std::copy(start.end() - q.size(), start.end(), u.data());
        if (state.motions.size() > 0)
          {
            u += motions.seen() * state.motions;
            state.motions.setZero();
            state.base.setZero();
          }
        state.start = shared(std::move(u));
      }

    private:
      const Index         n;
      const RigidMotions &motions;
    };
  } // namespace

  CondensedStiffness::CondensedStiffness(const ElasticSystem &e,
                                         const ContactPoints &points,
                                         const Coordinates   &coordinates,
                                         const RigidMotions  &m,
                                         const bool           find_mechanisms,
                                         const condensed::Condenser &by)
    : elastic(e)
    , own(elastic.bodies, coordinates, &points)
    , own_unknown(own_unknowns(points, own))
    , bodies(bodies_with(elastic, own, by, own_unknown))
  {
    bodies.condense();
    auto system    = std::make_shared<solvers::ContactSystem>(points.layout());
    system->matrix = take_stiffness();
    const Index n  = system->matrix.cols();
    AssertDimension(n, points.n_unknowns());
    // Frames may have motions that nobody has named: the null space of K tells
    // them, for n^3/3 operations. Those of other bodies are rigid, and known to
    // the last digit.
    system->null_space =
      find_mechanisms && n > 0 && n <= largest_rank_search ?
        solvers::null_space_basis(system->matrix, m.null_space()) :
        m.null_space();
    contact_system = system;
    own_states     = std::make_unique<StatesOfStiffness>(n, m);
    // A power of two rounds nothing.
    if (const double mean = diagonal_of(elastic, coordinates.n_dofs()).mean();
        mean > 0)
      stiffness_scale = std::exp2(std::round(std::log2(mean)));
  }

  /* What the graph of K tells without numbers: bytes and operations of the
     factor, from its order of elimination. */
  condensed::FactorEstimate
  CondensedStiffness::estimate(const ElasticSystem        &elastic,
                               const ContactPoints        &points,
                               const Coordinates          &coordinates,
                               const condensed::Condenser &condenser)
  {
    const BodyCoordinates own(elastic.bodies, coordinates, &points);
    return bodies_with(elastic, own, condenser, own_unknowns(points, own))
      .estimate();
  }

  /* Bodies that meet obstacles only do not see each other: each has rows of its
     own. */
  MatrixXd
  CondensedStiffness::take_stiffness()
  {
    std::vector<Index> place(at(own.n_unknowns()), -1);
    for (std::size_t i = 0; i < own_unknown.size(); ++i)
      place[at(own_unknown[i])] = static_cast<Index>(i);
    const auto n = static_cast<Index>(own_unknown.size());
    MatrixXd   K;
    for (const CondensedBodies::Part &part : bodies.parts())
      {
        std::vector<Index> rows;
        for (const Index row : retained_rows(part, part.bodies[0], own))
          rows.push_back(place[at(row)]);
        MatrixXd S = part.element->take_stiffness();
        if (S.cols() == n && std::is_sorted(rows.begin(), rows.end()))
          return S; // the usual case, and a large matrix
        // Several bodies have blocks of their own: nothing couples them.
        if (K.size() == 0)
          K.setZero(n, n);
        // Retained unknowns ascend in a body, contact unknowns go contact by
        // contact: rows and columns are permuted.
        K(rows, rows) = S;
      }
    return K.size() > 0 ? K : MatrixXd::Zero(n, n);
  }

  void
  CondensedStiffness::reduce_one(const VectorXd &forces,
                                 const VectorXd &prescribed,
                                 LoadCase       &load)
  {
    AssertDimension(forces.size(), prescribed.size());
    // b = B^T (f - K d): what is prescribed acts as a load on the rest.
    // Contacts see f = b_C - K_CF K_FF^-1 b_F.
    load.b = own.restrict(forces - elastic.internal_forces(prescribed));
    load.f = reduce_forces(load.b);
    if (is_linear())
      // No contact unknowns: the load case is solved once for all.
      load.q = carry(load.b, MatrixXd(0, 1));
  }

  LoadCase
  CondensedStiffness::nothing() const
  {
    LoadCase load;
    load.b = VectorXd::Zero(own.n_unknowns());
    load.f = VectorXd::Zero(static_cast<Index>(own_unknown.size()));
    if (is_linear())
      load.q = load.b;
    return load;
  }

  /* b_C - K_CF K_FF^-1 b_F of each body, in the order of the contact
     unknowns. */
  VectorXd
  CondensedStiffness::reduce_forces(const VectorXd &b) const
  {
    AssertDimension(b.size(), own.n_unknowns());
    if (is_linear())
      return {};
    VectorXd reduced(b.size());
    for (const CondensedBodies::Part &part : bodies.parts())
      reduced(retained_rows(part, part.bodies[0], own)) = part.element->reduce(
        b.segment(own.begin(part.bodies[0]), bodies.n_own(part.bodies[0])));
    return reduced(own_unknown);
  }

  /* K_FF u_F = b_F - K_FC u_C of each body, with the contact unknowns u_C. */
  MatrixXd
  CondensedStiffness::carry(const MatrixXd &b, const MatrixXd &contact) const
  {
    AssertDimension(b.cols(), contact.cols());
    MatrixXd displaced(b.rows(), b.cols());
    displaced(own_unknown, Eigen::all) = contact;
    return bodies.map(b,
                      [&](const CondensedBodies::Part &part,
                          const unsigned int           body,
                          const MatrixXd              &of_body) {
                        return part.element->carry(
                          of_body,
                          displaced(retained_rows(part, body, own),
                                    Eigen::all));
                      });
  }

  std::vector<VectorXd>
  CondensedStiffness::expand(const std::vector<const LoadCase *> &loads,
                             const std::vector<VectorXd>         &primal) const
  {
    AssertDimension(loads.size(), primal.size());
    // Displacements are those before where nothing has changed.
    std::vector<std::size_t> different;
    std::vector<Index>       column;
    for (std::size_t k = 0; k < loads.size(); ++k)
      {
        if (k == 0 || loads[k]->b != loads[k - 1]->b ||
            primal[k] != primal[k - 1])
          different.push_back(k);
        column.push_back(static_cast<Index>(different.size()) - 1);
      }
    const auto n = static_cast<Index>(different.size());
    // A column of the right-hand side for each different load case: many of
    // them cost little more than one.
    MatrixXd q(own.n_unknowns(), n);
    MatrixXd contact(static_cast<Index>(own_unknown.size()), n);
    for (Index i = 0; i < n; ++i)
      {
        const std::size_t k = different[at(i)];
        q.col(i)            = is_linear() ? loads[k]->q : loads[k]->b;
        contact.col(i)      = primal[k];
      }
    if (!is_linear())
      q = carry(q, contact);
    std::vector<VectorXd> w;
    for (std::size_t k = 0; k < loads.size(); ++k)
      {
        w.push_back(own.expand(q.col(column[k])));
        if (loads[k]->deforms())
          w.back() += loads[k]->prescribed;
      }
    return w;
  }

  /* What is left is K w - f: what takes it away has the other sign. */
  LoadCase
  CondensedStiffness::reduce_unbalanced(const Unbalanced &left) const
  {
    LoadCase change;
    change.b = -own.restrict(left.forces);
    change.f = reduce_forces(change.b);
    return change;
  }

  /* One step of iterative refinement: the same factor answers what the
     displacements left unbalanced. */
  VectorXd
  CondensedStiffness::correction(const LoadCase &change,
                                 const VectorXd &primal) const
  {
    return own.expand(carry(change.b, primal));
  }

  void
  CondensedStiffness::write(const LoadCase &load,
                            const VectorXd &offset,
                            const ElasticState &,
                            solvers::ContactProblem &problem) const
  {
    AssertDimension(offset.size(), load.f.size());
    problem.load   = load.f;
    problem.offset = offset;
  }
} // namespace conetact::contact

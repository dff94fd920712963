// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/condensed_compliance.h"

#include "conetact/base/index.h"
#include "conetact/contact/equal_bodies.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;
    using SparseMatrix = Eigen::SparseMatrix<double>;
    using VectorXd     = Eigen::VectorXd;

    /** The distance of p from a point, or from the line through two. */
    double
    distance(const Point<3> &p, const std::vector<Point<3>> &from)
    {
      const Tensor<1, 3> arm = p - from[0];
      if (from.size() < 2)
        return arm.norm();
      const Tensor<1, 3> line = from[1] - from[0];
      return cross_product_3d(line / line.norm(), arm).norm();
    }

    /** Which own unknowns bodies keep where contacts are rows H over them. */
    struct RetainedUnknowns
    {
      const model::Bodies   &bodies;
      const Coordinates     &coordinates; ///< without contacts
      const RigidMotions    &motions;
      const BodyCoordinates &own;
      const SparseMatrix    &H;

      /** Marks them, of all own unknowns of a body. */
      void
      operator()(const unsigned int body, std::vector<bool> &kept) const;
      void
      keep_anchors(const unsigned int body, std::vector<bool> &kept) const;
    };

    void
    RetainedUnknowns::operator()(const unsigned int body,
                                 std::vector<bool> &kept) const
    {
      AssertDimension(H.cols(), own.n_unknowns());
      AssertDimension(kept.size(), at(own.end(body) - own.begin(body)));
      for (Index p = own.begin(body); p < own.end(body); ++p)
        // A column of H that is not empty: contacts see this unknown.
        if (H.outerIndexPtr()[p + 1] > H.outerIndexPtr()[p])
          kept[at(p - own.begin(body))] = true;
      for (const auto &[of, node] : bodies.nodes_to_keep)
        if (of == body)
          for (unsigned int c = 0; c < bodies.dim; ++c)
            own.for_row(coordinates.dof(body, node) + c,
                        [&](const Index unknown, double) {
                          kept[at(unknown - own.begin(body))] = true;
                        });
      if (std::count(motions.body_of_own().begin(),
                     motions.body_of_own().end(),
                     body) > 0)
        keep_anchors(body, kept);
    }

    // A body that floats keeps some nodes far apart, or digits would go with
    // the lever from its contacts to its ends; and a contact may be a single
    // node.
    void
    RetainedUnknowns::keep_anchors(const unsigned int body,
                                   std::vector<bool> &kept) const
    {
      AssertDimension(kept.size(),
                      static_cast<std::size_t>(own.end(body) -
                                               own.begin(body)));
      const bodies::Structure &structure = *bodies.structures[body];
      std::vector<Point<3>>    chosen    = {structure.position(0)};
      for (unsigned int k = 0; k < bodies.dim; ++k)
        {
          unsigned int best     = 0;
          double       furthest = -1;
          for (unsigned int i = 0; i < structure.n_nodes(); ++i)
            {
              const auto [begin, end] = own.unknowns_of(body, i);
              const double d          = distance(structure.position(i), chosen);
              // Only nodes that no support holds have all their unknowns.
              if (end - begin >= bodies.dim && d > furthest)
                {
                  furthest = d;
                  best     = i;
                }
            }
          // The node furthest from any, then the one furthest from that, in
          // space the one furthest from the line through both: they span the
          // body.
          if (k == 0) // the first one only served to find it
            chosen.clear();
          chosen.push_back(structure.position(best));
          const auto [begin, end] = own.unknowns_of(body, best);
          for (Index p = begin; p < end; ++p)
            kept[at(p - own.begin(body))] = true;
        }
    }

    /** Reactions and motions are all there is. */
    class StatesOfCompliance : public ElasticStates
    {
    public:
      StatesOfCompliance(const ContactPoints &p, const RigidMotions &m)
        : points(p)
        , motions(m)
      {}

      void
      begin(const ElasticState    &state,
            solvers::ContactState &start) const override
      {
        const Index n = points.n_unknowns() + state.motions.size();
        start.v.conservativeResizeLike(VectorXd::Zero(n));
        start.r.conservativeResizeLike(VectorXd::Zero(n));
        // Motions count from those that the problem is written about.
        start.r.tail(state.motions.size()) = state.motions - state.base;
      }
      void
      end(const solvers::ContactState &end, ElasticState &state) const override
      {
        // The next problem is written about where its bodies are then.
        if (end.r.size() > points.n_unknowns())
          state.motions = state.base =
            state.base + end.r.tail(state.motions.size());
      }
      VectorXd
      primal(const ElasticState &state, const VectorXd &r) const override
      {
        AssertDimension(r.size(), points.n_unknowns());
        VectorXd result(r.size() + state.motions.size());
        result << r, state.motions;
        return result;
      }
      void
      move(const VectorXd &amounts,
           const VectorXd &,
           solvers::ContactState &end) const override
      {
        Assert(end.r.size() >= amounts.size(),
               dealii::ExcMessage("Motions stand behind the reactions."));
        end.r.tail(amounts.size()) += amounts;
      }
      /** A correction starts from the end of the try before, which is nearly
       * right: the relation holds for rounded matrices. Motions count from
       * there. */
      solvers::ContactState
      restart(const solvers::ContactState &,
              const solvers::ContactState &end) const override
      {
        solvers::ContactState start = end;
        start.r.tail(motions.n_free()).setZero();
        return start;
      }
      void
      restore(const std::vector<double> &,
              const VectorXd &,
              ElasticState &state) const override
      {
        state.start.reset();
      }

    private:
      const ContactPoints &points;
      const RigidMotions  &motions;
    };
  } // namespace

  CondensedCompliance::CondensedCompliance(const ElasticSystem        &e,
                                           const ContactPoints        &p,
                                           const Coordinates          &c,
                                           const RigidMotions         &m,
                                           const condensed::Condenser &by,
                                           const Empty)
    : elastic(e)
    , points(p)
    , coordinates(c)
    , motions(m)
    , own(elastic.bodies, coordinates)
    , rows(elastic.bodies, points, coordinates, own)
    , bodies(elastic,
             own,
             by,
             find_equal_bodies(elastic, own),
             RetainedUnknowns{elastic.bodies,
                              coordinates,
                              motions,
                              own,
                              rows.matrix()})
    , free(elastic, motions, own)
    , eliminated(points, motions)
  {
    own_states = std::make_unique<StatesOfCompliance>(points, motions);
  }

  CondensedCompliance::CondensedCompliance(const ElasticSystem        &e,
                                           const ContactPoints        &p,
                                           const Coordinates          &c,
                                           const RigidMotions         &m,
                                           const condensed::Condenser &by)
    : CondensedCompliance(e, p, c, m, by, Empty())
  {
    bodies.condense([this](const unsigned int body) -> const MatrixXd & {
      return free.of_body(body);
    });
    free.respond(bodies);
    assemble_system();
  }

  /* Rows are others over the same bodies: K_b and P_b stay, W = H P H^T costs
     products. Cuts that are locked are motions less: R and Y are found again,
     and W stays as it is. */
  bool
  CondensedCompliance::relink(const Changed what)
  {
    rows.find_again();
    if (what == Changed::motions)
      {
        free.find();
        free.respond(bodies);
      }
    assemble_system();
    forget_reductions();
    return true;
  }

  /* w = P b of each body. P is an inverse up to a motion of the body, which
     drops out: forces balance, and motions are unknowns of their own. */
  Eigen::MatrixXd
  CondensedCompliance::deform(const MatrixXd &forces) const
  {
    AssertDimension(forces.rows(), own.n_unknowns());
    return bodies.map(forces,
                      [](const CondensedBodies::Part &part,
                         const unsigned int,
                         const MatrixXd &of_body) {
                        return part.element->deform(of_body);
                      });
  }

  // Nothing resists these motions: a load on them would have no answer.
  Eigen::VectorXd
  CondensedCompliance::without_unseen(const VectorXd &against) const
  {
    AssertDimension(against.size(), motions.own().cols());
    if (unseen.cols() == 0)
      return against;
    const MatrixXd nowhere = motions.free_of_own() * unseen;
    return against - nowhere * (nowhere.transpose() * against).eval();
  }

  /* H^T r, and the foundations against the motions a. */
  Eigen::VectorXd
  CondensedCompliance::forces_of(const VectorXd &primal) const
  {
    const SparseMatrix &H = rows.matrix();
    AssertDimension(primal.size(), H.rows() + motions.own().cols());
    return H.transpose() * primal.head(H.rows()) -
           free.resistance(primal.tail(primal.size() - H.rows()));
  }

  /* The load b = B^T (f - K d), in which prescribed displacements d act as
     forces, and of it q = H w and the balance of motions. */
  void
  CondensedCompliance::reduce_one(const VectorXd &forces,
                                  const VectorXd &prescribed,
                                  LoadCase       &load)
  {
    AssertDimension(forces.size(), coordinates.n_dofs());
    AssertDimension(prescribed.size(), coordinates.n_dofs());
    load.b       = own.restrict(forces - elastic.internal_forces(prescribed));
    VectorXd all = reduce_all(load.b, forces);
    // R^T K = 0 for structures but for rounding, which must not carry anything:
    // R^T K d, which the balance has by -R^T b, is taken out again.
    const VectorXd rounding =
      own.restrict(elastic.structure_forces(prescribed));
    all.tail(motions.own().cols()) -= free.resultants(rounding);
    eliminated.set_load(all, load);
  }

  LoadCase
  CondensedCompliance::nothing() const
  {
    LoadCase load;
    load.b = VectorXd::Zero(own.n_unknowns());
    eliminated.set_load(VectorXd::Zero(points.n_all_unknowns() +
                                       motions.own().cols()),
                        load);
    return load;
  }

  /* The load (q, -R^T b) of the relation: q = H P b and -(R + Y)^T b, less what
     drives motions that nothing resists. */
  Eigen::VectorXd
  CondensedCompliance::reduce_all(const VectorXd &b,
                                  const VectorXd &forces) const
  {
    AssertDimension(b.size(), own.n_unknowns());
    VectorXd w = VectorXd::Zero(b.size());
    for (const CondensedBodies::Part &part : bodies.parts())
      for (const unsigned int body : part.bodies)
        {
          const VectorXd kept =
            part.element->flexibility() *
            // P_C (f_C - K_CF K_FF^-1 f_F): displacements of what is retained.
            part.element->reduce(
              b.segment(own.begin(body), bodies.n_own(body)));
          for (std::size_t k = 0; k < part.retained.size(); ++k)
            w[own.begin(body) + part.retained[k]] = kept[static_cast<Index>(k)];
        }
    VectorXd f(points.n_all_unknowns() + motions.own().cols());
    f << rows.matrix() * w,
      without_unseen(free.imbalance(b) + free.rigid_imbalance(forces));
    return f;
  }

  /* The balance of a free motion is a sum over all nodes. Parts of a load that
     cancel leave up to 1e-13 of the sum of their magnitudes there. */
  void
  CondensedCompliance::forget_rounding(LoadCase &load) const
  {
    constexpr double rounding = 1e-13; // over the magnitudes
    const VectorXd   zero =
      rounding * (motions.free_of_own().cwiseAbs().transpose() *
                  free.size_of_terms(load.b));
    for (Index j = 0; j < zero.size(); ++j)
      if (double &sum = load.f[points.n_unknowns() + j];
          std::abs(sum) <= zero[j])
        sum = 0;
  }

  /* Each body has w = P (b + H^T r - K_s R a), and what is prescribed. */
  std::vector<Eigen::VectorXd>
  CondensedCompliance::expand(const std::vector<const LoadCase *> &loads,
                              const std::vector<Eigen::VectorXd>  &primal) const
  {
    AssertDimension(loads.size(), primal.size());
    const auto n = static_cast<Index>(loads.size());
    MatrixXd   forces(own.n_unknowns(), n);
    for (Index k = 0; k < n; ++k)
      forces.col(k) =
        loads[at(k)]->b +
        forces_of(eliminated.all_of(*loads[at(k)], primal[at(k)]));
    const MatrixXd               p = deform(forces);
    std::vector<Eigen::VectorXd> w;
    for (Index k = 0; k < n; ++k)
      {
        w.push_back(own.expand(p.col(k)));
        if (loads[at(k)]->deforms())
          w.back() += loads[at(k)]->prescribed;
      }
    return w;
  }

  /* What is left is K w - f - H^T r: its negative is the load of the
     correction. The load q takes up by how much recovered displacements miss W
     r + G a + q. */
  LoadCase
  CondensedCompliance::reduce_unbalanced(const Unbalanced &left) const
  {
    AssertDimension(left.forces.size(), coordinates.n_dofs());
    LoadCase change;
    change.b = -own.restrict(left.forces);
    eliminated.set_load(reduce_all(change.b, -left.forces), change);
    change.f.head(left.by_contacts.size()) += left.by_contacts;
    eliminated.move(left.by_bound, change);
    return change;
  }

  /* Refinement of w: P of what is left unbalanced, with the forces of the
     changed reactions and motions. */
  Eigen::VectorXd
  CondensedCompliance::correction(const LoadCase &change,
                                  const VectorXd &primal) const
  {
    return own.expand(
      deform(change.b + forces_of(eliminated.all_of(change, primal))));
  }

  condensed::FactorEstimate
  CondensedCompliance::estimate(const ElasticSystem        &elastic,
                                const ContactPoints        &points,
                                const Coordinates          &coordinates,
                                const RigidMotions         &motions,
                                const condensed::Condenser &condenser)
  {
    return CondensedCompliance(
             elastic, points, coordinates, motions, condenser, Empty())
      .bodies.estimate();
  }

  /* Heat presses no body as a whole: its forces cancel up to rounding, and a
     free motion would take this rounding for a load. */
  LoadCase
  CondensedCompliance::reduce(const VectorXd &forces,
                              const VectorXd &heat,
                              const VectorXd &prescribed)
  {
    AssertDimension(forces.size(), prescribed.size());
    Assert(heat.size() == 0 || heat.size() == forces.size(),
           dealii::ExcMessage("Thermal forces at all dofs, or none."));
    LoadCase load = Elasticity::reduce(forces, prescribed);
    forget_rounding(load);
    if (heat.size() == 0)
      return load;
    LoadCase hot = Elasticity::reduce(heat, VectorXd::Zero(prescribed.size()));
    for (Index j = points.n_unknowns(); j < contact_system->n_unknowns(); ++j)
      if (contact_system->matrix(j, j) == 0) // rounding must not drive a body
        hot.f[j] = 0;
    load.b += hot.b;
    load.f += hot.f;
    if (hot.bound.size() > 0)
      load.bound += hot.bound;
    return load;
  }

  /* Problems are written about the motions a_0 of `base`: unknowns are (r, a -
     a_0), and (G a_0, C a_0) is part of the load. */
  void
  CondensedCompliance::write(const LoadCase          &load,
                             const VectorXd          &offset,
                             const ElasticState      &state,
                             solvers::ContactProblem &problem) const
  {
    AssertDimension(offset.size(), points.n_unknowns());
    problem.load = load.f;
    problem.load.head(offset.size()) += offset;
    if (const Index k = contact_system->n_motions; k > 0)
      problem.load += contact_system->matrix.rightCols(k) * state.base;
  }

  /* In compliance form f has forces in its balance rows only. What is bound may
     carry nearly all. */
  ForceScale
  CondensedCompliance::force_scale(const LoadCase &load) const
  {
    const double force =
      solvers::largest(load.f.tail(contact_system->n_motions));
    if (points.n_bound() == 0)
      return {force};
    const VectorXd none = VectorXd::Zero(load.f.size());
    const double   whole =
      std::max(force, solvers::largest(eliminated.state(load, none).r));
    return {whole, rounding_of_past * whole};
  }

  /* The shortest reactions that drive the motions as the load does, G^T r = R^T
     f: balance rows have -R^T f. */
  Eigen::VectorXd
  CondensedCompliance::contact_load(
    const solvers::ContactProblem &problem) const
  {
    const VectorXd resultants = -motions.unresisted().transpose() *
                                problem.load.tail(problem.system->n_motions);
    return shortest_load(problem.system->null_space, resultants);
  }



  std::vector<double>
  unknowns_of_flexibilities(const model::Bodies &bodies,
                            const ContactPoints &points)
  {
    std::vector<std::set<unsigned int>> nodes(bodies.structures.size());
    for (const ContactPoint &point : points.all())
      {
        nodes[point.node->body].insert(point.node->node);
        for (const auto &[master, weight] : point.node->masters)
          nodes[point.node->master].insert(master);
      }
    std::vector<double> result;
    for (const std::set<unsigned int> &of_body : nodes)
      result.push_back(bodies.dim * static_cast<double>(of_body.size()));
    return result;
  }
} // namespace conetact::contact

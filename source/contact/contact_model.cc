// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_model.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/doubled_nodes.h"
#include "conetact/contact/equal_bodies.h"
#include "conetact/contact/pieces.h"
#include "conetact/solvers/null_space.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace conetact::contact
{
  namespace
  {
    /** A prescribed deformation below this part of the longest way of a body is
     * the rounding of ways: 64 eps, as it is the difference of two sums. */
    constexpr double deformation_rounding = 64 * 2.2e-16;

    /** Directions of ties turn with their bodies. */
    void
    turn_ties(const model::Bodies               &bodies,
              std::vector<pairing::ContactNode> &nodes)
    {
      if (bodies.frames.empty())
        return;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].is_tied())
          for (const auto direction : {&pairing::ContactNode::n,
                                       &pairing::ContactNode::t1,
                                       &pairing::ContactNode::t2,
                                       &pairing::ContactNode::axis_1,
                                       &pairing::ContactNode::axis_2})
            nodes[i].*direction =
              bodies.in_space(nodes[i].body,
                              bodies.contact_nodes[i].*direction);
    }
  } // namespace

  ContactModel::ContactModel(const model::Bodies            &b,
                             const std::vector<double>      &at,
                             const condensed::Condenser     &by,
                             const iterative::Preconditioner levels)
    : own_bodies(b)
    , bodies(own_bodies)
    , rules(bodies, at)
    , points(bodies, rules, at)
    , coordinates(bodies, rules)
    , elastic(bodies)
    , motions(bodies, rules, points)
    , frames(own_bodies, rules, points, motions)
    , preconditioner(levels)
    , times(at)
    , condenser(by)
    , form(needs_compliance() ? solvers::Form::compliance :
                                solvers::Form::stiffness)
  {
    if (form == solvers::Form::compliance)
      refuse_loose_pieces(bodies, rules, motions);
  }

  /* A column of `open` is a set of reactions that bound nodes and supports can
     exchange. Entries of orthonormal columns below 1e-9 are rounding. */
  const pairing::ContactNode *
  ContactModel::held_twice() const
  {
    if (points.n_bound() == 0)
      return nullptr;
    const RedundantRows *const known =
      made ? made->bound().redundant_rows() : nullptr;
    const Eigen::SparseMatrix<double> open =
      known != nullptr ?
        known->open :
        find_redundant_rows(bodies, points, coordinates, motions).open;
    std::vector<const pairing::ContactNode *> node_of;
    for (std::size_t i = points.size(); i < points.all().size(); ++i)
      node_of.insert(node_of.end(),
                     points.all()[i].dual.size(),
                     points.all()[i].node);
    for (Eigen::Index j = 0; j < open.cols(); ++j)
      {
        std::set<const pairing::ContactNode *> nodes;
        for (Eigen::SparseMatrix<double>::InnerIterator it(open, j); it; ++it)
          if (std::abs(it.value()) > 1e-9)
            nodes.insert(node_of[static_cast<std::size_t>(it.row())]);
        // Where supports hold both sides of one node, as in a plane of
        // symmetry, nothing is to share, nor is it on an axis.
        const pairing::ContactNode &node = **nodes.begin();
        if (nodes.size() > 1 ||
            (node.masters.empty() &&
             !(bodies.structures[node.body]->is_axisymmetric() &&
               node.position[0] == 0)))
          return &node;
      }
    return nullptr;
  }

  /* Stiffness is the faster form, a matrix without an inverse. Compliance, v =
     W r + G a + q, takes anything. */
  bool
  ContactModel::needs_compliance() const
  {
    if (points.n_bound() > 0)
      return true;
    if (points.size() == 0)
      return false;
    // One stiffness K with a frame at each node serves only where each node is
    // in one contact, with an obstacle, and all of its slip is elastic. Bodies
    // that float lose digits in it, equal bodies would be condensed several
    // times. A layer that is much softer than the body is added to W without
    // loss.
    const bool pairs =
      std::any_of(bodies.contact_nodes.begin(),
                  bodies.contact_nodes.end(),
                  [](const pairing::ContactNode &node) {
                    return !node.masters.empty() || !node.slaves.empty() ||
                           (node.layer && node.layer->is_soft() && !node.bond);
                  });
    // Contacts that slide far have other rows over the same bodies in each
    // increment. Mechanisms are found in a stiffness only, which there is where
    // contacts see all motions; it serves those that are some.
    return pairs || points.slide() || points.traits().has_prescribed_slip ||
           points.traits().shares_nodes ||
           (may_be_mechanism() ?
              motions.unseen().cols() > 0 ||
                (motions.n_free() > 0 && moves_as_rigid_only()) :
              motions.n_free() > 0 || has_equal_bodies());
  }

  /* The whole stiffness is factorised densely, n^3/3 operations: small frames
     alone are asked, others may be mechanisms. */
  bool
  ContactModel::moves_as_rigid_only() const
  {
    constexpr Eigen::Index few = 600;
    const Eigen::Index     n   = coordinates.n_unknowns();
    if (n > few)
      return false;
    const Eigen::MatrixXd all = Eigen::MatrixXd(assemble(elastic, coordinates))
                                  .selfadjointView<Eigen::Upper>();
    Eigen::MatrixXd rigid(n, motions.n_free());
    for (Eigen::Index j = 0; j < rigid.cols(); ++j)
      rigid.col(j) = coordinates.values(
        motions.field(motions.of_free(Eigen::VectorXd::Unit(rigid.cols(), j))));
    return solvers::null_space_basis(all, rigid).cols() ==
           solvers::orthonormal_basis(rigid).cols();
  }

  bool
  ContactModel::has_equal_bodies() const
  {
    return may_have_equals(bodies) &&
           !find_equal_bodies(elastic, BodyCoordinates(bodies, coordinates))
              .empty();
  }

  LoadCase
  ContactModel::load_case(const Eigen::VectorXd &mechanical,
                          const Eigen::VectorXd &thermal,
                          const double           t)
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    AssertDimension(mechanical.size(), coordinates.n_dofs());
    // Supports that move as one carry their body along: that is the placement
    // a_p, and no force belongs to it. Only the rest of what they prescribe
    // deforms: d - (R a_p)_h, along what they hold.
    const Eigen::VectorXd placement  = motions.placement(t);
    Eigen::VectorXd       prescribed = coordinates.prescribed(t);
    Eigen::VectorXd       all        = mechanical;
    double                far        = frames.largest_way();
    // A ground that moves by g pulls by K_s g, wherever the body is.
    if (elastic.has_springs())
      all += elastic.ground_forces(t);
    if (!placement.isZero(0))
      {
        const Eigen::VectorXd rigid = motions.field(placement);
        far                         = std::max(far, solvers::largest(rigid));
        prescribed -= coordinates.held_part(rigid);
        // Foundations do feel the placement: K_s R a_p.
        if (elastic.has_springs())
          all -= elastic.spring_forces(rigid);
      }
    if (const double zero = deformation_rounding * far; zero > 0)
      for (double &d : prescribed)
        d = std::abs(d) <= zero ? 0. : d;
    LoadCase load  = elasticity().reduce(all, thermal, prescribed);
    load.placement = placement;
    if (motions.has_geometric())
      load.f.segment(points.n_unknowns(), motions.n_free()) -=
        motions.geometric_forces(stiffened_about);
    const Eigen::VectorXd offset = all_offsets(load, t);
    load.offset                  = offset.head(points.n_unknowns());
    elasticity().bound().move(offset.tail(points.n_bound_unknowns()) +
                                points.gaps_to_close(),
                              load);
    return load;
  }

  /* Displacements of contacts that are no unknowns: placements and prescribed
     deformations, less the motion of obstacles. */
  Eigen::VectorXd
  ContactModel::all_offsets(const LoadCase &load, const double t) const
  {
    return points.components(
      [&](const unsigned int body, const unsigned int node) {
        Tensor<1, 3>       u   = motions.at(load.placement, body, node);
        const Eigen::Index dof = coordinates.dof(body, node);
        for (unsigned int c = 0; c < bodies.dim && load.deforms(); ++c)
          u[c] += load.prescribed[dof + c];
        return bodies.displacement(body, node, u);
      },
      t);
  }

  /* v = H u of all sides, less the motion of obstacles, without gaps: what a
     history remembers when nodes have met others. */
  Eigen::VectorXd
  ContactModel::relative_displacements(const Eigen::VectorXd &u,
                                       const double           t) const
  {
    AssertDimension(u.size(), coordinates.n_dofs());
    return points
      .components(
        [&](const unsigned int body, const unsigned int node) {
          return displacement(u, body, node);
        },
        t)
      .head(points.n_unknowns());
  }

  Tensor<1, 3>
  ContactModel::displacement(const Eigen::VectorXd &u,
                             const unsigned int     body,
                             const unsigned int     node) const
  {
    AssertIndexRange(body, bodies.structures.size());
    return coordinates.at_node(u, body, node);
  }

  /* Amounts of all modes: placements are those of supports, free motions come
     on top. */
  Eigen::VectorXd
  ContactModel::amounts(const Eigen::VectorXd &placement,
                        const Eigen::VectorXd &a) const
  {
    AssertDimension(a.size(), motions.n_free());
    return placement + motions.of_free(a);
  }

  std::string
  ContactModel::singular_sentence(const condensed::SingularMatrix &error) const
  {
    std::string text = "Some part of a body can move although supports and "
                       "contact nodes hold all bodies";
    std::string hint;
    if (error.node)
      {
        // A pivot that vanishes names a node: the piece around it moves. Nodes
        // at one place that are not joined are what most such pieces come from.
        const auto [body, node] = coordinates.locate(*error.node);
        text += ": what surrounds the node at " +
                to_text(bodies.structures[body]->position(node)) +
                " of body '" + bodies.names[body] + "'";
        hint = bodies.structures[body]->weakness(node);
      }
    for (std::size_t b = 0; b < bodies.n_elastic() && hint.empty(); ++b)
      if (const auto doubled = bodies::doubled_nodes(*bodies.structures[b]);
          !doubled.empty())
        hint = "Body '" + bodies.names[b] + "' has nodes at " +
               to_text(bodies.structures[b]->position(doubled[0].first)) +
               " that coincide and are not joined: join them in the program "
               "that wrote the mesh.";
    return text +
           ". It is a piece that is not joined to the rest, or a "
           "mechanism: join it, or add a Support." +
           (hint.empty() ? " Parts that touch each other only, such as bolts, "
                           "are bodies of their own." :
                           " " + hint);
  }

  bool
  ContactModel::may_be_mechanism() const
  {
    return std::any_of(bodies.structures.begin(),
                       bodies.structures.end(),
                       [](const bodies::Structure *structure) {
                         return structure->may_be_mechanism();
                       });
  }

  condensed::FactorEstimate
  ContactModel::estimate_factor() const
  {
    return estimate_condensed(*this, condenser);
  }

  /* Factors of the old Elasticity give their memory back before there is
     another one; what they cost is remembered. */
  void
  ContactModel::solve_by(const ElasticityRow &other)
  {
    if (const std::string why = other.why_not(*this); !why.empty())
      throw InputError("Solver, Backend = " + std::string(other.name) + " " +
                       why + ". Set Backend = condensed, or automatic.");
    former_work = work();
    made.reset();
    row = &other;
  }

  Elasticity &
  ContactModel::elasticity()
  {
    try
      {
        if (!made)
          made = row->create(*this, condenser);
      }
    catch (const condensed::SingularMatrix &error)
      {
        throw InputError(singular_sentence(error));
      }
    return *made;
  }

  std::vector<StiffnessDifference>
  ContactModel::compare_stiffness(const condensed::Condenser &other)
  {
    try
      {
        return elasticity().compare(other);
      }
    catch (const condensed::SingularMatrix &error)
      {
        throw AnalysisError(std::string(other.name) +
                            " finds what Solver/Condensation did not: " +
                            singular_sentence(error));
      }
  }

  std::string
  ContactModel::relink(std::vector<pairing::ContactNode> nodes,
                       ElasticState                     &state)
  {
    turn_ties(bodies, nodes);
    const bool stiffens      = std::exchange(is_stiffened, false);
    const bool turns_motions = rules.turn_with_frames() || stiffens;
    if (std::string why = points.relink(std::move(nodes), times); !why.empty())
      return why;
    // Free motions are those of supports and ties, which stay but where axes
    // are held of an obstacle that turns; what contacts see of them turns with
    // normals.
    if (turns_motions)
      motions.find_again(points);
    else
      motions.see_contacts(points);
    // The iterative Elasticity has the axes of contacts in its unknowns: where
    // these turn its start is taken over as a deformation.
    if (!made || made->relink(turns_motions ? Elasticity::Changed::motions :
                                              Elasticity::Changed::contacts))
      return {};
    Eigen::VectorXd w;
    if (why_not().empty() && state.start)
      w = made->states().deformation(*state.start);
    made.reset(); // before there is another one
    if (w.size() > 0)
      state.start = shared(elasticity().states().nearby(w, Eigen::VectorXd()));
    return {};
  }

  void
  ContactModel::stiffen(Eigen::MatrixXd geometric, Eigen::VectorXd about)
  {
    AssertDimension(about.size(), motions.none().size());
    motions.set_geometric(std::move(geometric));
    stiffened_about = std::move(about);
    is_stiffened    = true;
  }

  Eigen::VectorXd
  ContactModel::geometric_forces(const Eigen::VectorXd &a) const
  {
    return motions.has_geometric() ?
             motions.geometric_forces(motions.of_free(a) - stiffened_about) :
             Eigen::VectorXd();
  }

  /* A cut stays as open as it is: that is a placement of its rigid body from
     now on, and one free motion less. An Elasticity that is made anew has other
     unknowns, and starts from the same deformation in these. */
  bool
  ContactModel::lock_cuts(const double           t,
                          const Eigen::VectorXd &u,
                          ElasticState          &state)
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    Assert(u.size() == 0 || u.size() == coordinates.n_dofs(),
           dealii::ExcMessage("Displacements of all dofs, or none yet."));
    bool any = false;
    for (model::Cut &cut : own_bodies.cuts)
      if (!cut.opening && cut.is_due(t))
        {
          cut.opening = u.size() > 0 ? opening(cut, u) : 0.;
          any         = true;
        }
    if (!any)
      return false;
    motions.find_again(points);
    if (!made || made->relink(Elasticity::Changed::motions))
      return true;
    made.reset(); // before there is another one
    state.start.reset();
    if (u.size() > 0)
      state.start = shared(
        elasticity().states().nearby(deformation(u, t), Eigen::VectorXd()));
    return true;
  }

  /* w = u - R a_p - (d - (R a_p)_h): displacements less the placement a_p and
     less what supports prescribe beyond it, where ( )_h is the part along what
     they hold. */
  Eigen::VectorXd
  ContactModel::deformation(const Eigen::VectorXd &u, const double t) const
  {
    const Eigen::VectorXd rigid = motions.field(motions.placement(t));
    return coordinates.in_frames(u) - rigid - coordinates.prescribed(t) +
           coordinates.held_part(rigid);
  }

  double
  ContactModel::opening(const model::Cut &cut, const Eigen::VectorXd &u) const
  {
    AssertDimension(u.size(), coordinates.n_dofs());
    return displacement(u, cut.body, 0) * cut.axis;
  }

  /* The rigid body of a cut has no equation once it is locked: the lock holds
     its reactions along the axis, sum_i r_i . e, as the force of a support
     does. */
  Eigen::VectorXd
  ContactModel::lock_forces(const Eigen::VectorXd &all_reactions) const
  {
    AssertDimension(all_reactions.size(), points.n_all_unknowns());
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(coordinates.n_dofs());
    for (const model::Cut &cut : bodies.cuts)
      if (cut.opening)
        for (const ContactPoint &point : points.all())
          if (point.node->contact == cut.contact)
            {
              const double along = force_of(point, all_reactions) * cut.axis;
              for (unsigned int c = 0; c < bodies.dim; ++c)
                forces[coordinates.dof(cut.body, 0) + c] += along * cut.axis[c];
            }
    return forces;
  }

  condensed::SchurWork
  ContactModel::work() const
  {
    condensed::SchurWork sum = former_work;
    if (made)
      sum += made->report().work;
    return sum;
  }
} // namespace conetact::contact

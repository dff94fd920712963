// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_model.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/doubled_nodes.h"
#include "conetact/contact/equal_bodies.h"
#include "conetact/contact/large_nodes.h"
#include "conetact/contact/open_motions.h"
#include "conetact/solvers/large_system.h"
#include "conetact/solvers/null_space.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace conetact::contact
{
  namespace
  {
    /**
     * Of the motion that supports give a body as a whole: a deformation below
     * is the rounding of what they prescribe.
     */
    constexpr double deformation_rounding = 64 * 2.2e-16;

    /**
     * Of the largest force so far: to a tolerance of 1e-10 of this, what is
     * left of it is rounding.
     */
    constexpr double rounding_of_past = 1e-4;

    /** The same of the force that it takes to hold back what moves. */
    constexpr double rounding_of_motion = 1e-3;

    /** Over the spacing of nodes: ties of what is further apart do not turn. */
    constexpr double tied_apart = 1e-9;

    /** Whether the tie goes on to be one where its bodies turn together. */
    bool
    turns_along(const pairing::ContactNode &tie, const Bodies &bodies)
    {
      return tie.kind == pairing::ContactKind::tie && !tie.masters.empty() &&
             !tie.opening &&
             pairing::undeformed_distance(tie, bodies.structures).norm() <=
               tied_apart * tie.spacing;
    }

    /** What equations join turns together, or not at all. */
    std::vector<bool>
    together(const RigidMotions &motions, const std::vector<bool> &alone)
    {
      std::vector<bool> may = alone;
      for (unsigned int body = 0; body < alone.size(); ++body)
        for (unsigned int other = 0; other < alone.size(); ++other)
          if (motions.first_tied(body) == motions.first_tied(other))
            may[body] = may[body] && alone[other];
      return may;
    }

    /**
     * Of what is tied to a body: the one whose frame all of them have. It is
     * held by supports alone, if one is: the others follow it by their ties,
     * and turn where these are strained.
     */
    unsigned int
    leader_of(const unsigned int  body,
              const Bodies       &bodies,
              const RigidMotions &motions)
    {
      const unsigned int first = motions.first_tied(body);
      const auto        &own   = motions.body_of_own();
      for (unsigned int other = first; other < bodies.structures.size();
           ++other)
        if (motions.first_tied(other) == first &&
            std::find(own.begin(), own.end(), other) == own.end())
          return other;
      return first;
    }

    [[noreturn]] void
    refuse_turn(const bodies::Support &support, const Bodies &bodies)
    {
      throw InputError(
        "Support '" + support.name + "', Turn: " + bodies.called(support.body) +
        " is held along some directions only, has a foundation, or contacts "
        "with Kinematics = small, which would stay where they are, or is "
        "tied to an obstacle, with a Preload, across a gap, or to such a "
        "body. Hold it by this support alone, and set Kinematics = finite "
        "sliding in its contacts.");
    }

    /** Directions of ties turn with their bodies. */
    void
    turn_ties(const Bodies &bodies, std::vector<pairing::ContactNode> &nodes)
    {
      if (bodies.frames().empty())
        return;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].kind == pairing::ContactKind::tie)
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

  ContactModel::ContactModel(const Bodies              &b,
                             const std::vector<double> &at,
                             const backends::Condenser &by)
    : bodies(b)
    , rules(bodies, at)
    , points(bodies, rules, at)
    , coordinates(bodies, rules)
    , elastic(bodies)
    , motions(bodies, rules, points, coordinates)
    , times(at)
    , condenser(by)
    , dual(needs_dual())
    , chosen(points.layout())
  {
    find_frames();
  }

  /* Elements that turn have no frame here, and foundations and supports along
     some directions do not turn with the body. */
  bool
  ContactModel::may_turn(const unsigned int body) const
  {
    AssertIndexRange(body, bodies.structures.size());
    if (!bodies.deforms(body) ||
        bodies.structures[body]->n_components() > bodies.dim)
      return false;
    for (const bodies::Support &support : bodies.supports)
      if (support.body == body && support.stiffness)
        return false;
    for (const NodeRule &rule : rules.rules())
      if (rule.body == body && !rule.held.empty() &&
          rule.held.size() < bodies.dim)
        return false;
    return std::all_of(bodies.contact_nodes.begin(),
                       bodies.contact_nodes.end(),
                       [&](const pairing::ContactNode &node) {
                         return node.slides || turns_along(node, bodies) ||
                                (node.body != body &&
                                 (node.masters.empty() || node.master != body));
                       });
  }

  void
  ContactModel::find_frames()
  {
    const bool far =
      points.slide() ||
      std::any_of(bodies.supports.begin(),
                  bodies.supports.end(),
                  [](const auto &support) { return support.turn.has_value(); });
    bodies.move_frames().clear();
    std::vector<bool> may;
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      may.push_back(may_turn(body));
    may = together(motions, may);
    for (const bodies::Support &support : bodies.supports)
      if (support.turn && !may[support.body])
        refuse_turn(support, bodies);
    if (!far)
      return;
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      {
        turns.push_back(may[body]);
        bodies.move_frames().emplace_back();
        bodies.move_frames().back().centre =
          motions.of_body(motions.none(), leader_of(body, bodies, motions))
            .centre;
      }
  }

  double
  ContactModel::turn_of_frames(const Eigen::VectorXd &amounts) const
  {
    double largest = 0;
    for (unsigned int body = 0; body < turns.size(); ++body)
      if (turns[body] && leader_of(body, bodies, motions) == body)
        largest = std::max(largest, motions.rotation(amounts, body));
    return largest;
  }

  /* What is tied has one frame: rigid motions leave ties alone. */
  void
  ContactModel::move_frames(const Eigen::VectorXd &amounts)
  {
    for (unsigned int body = 0; body < turns.size(); ++body)
      if (turns[body])
        {
          const RigidMotions::Motion more =
            motions.of_body(amounts, leader_of(body, bodies, motions));
          pairing::RigidMotion &frame = bodies.move_frames()[body];
          frame.translation += frame.rotation * more.translation;
          frame.rotation =
            frame.rotation *
            pairing::RigidMotion::turned({}, more.rotation, {}).rotation;
        }
  }

  /* Placements are small motions: it takes a few to follow a far turn. */
  void
  ContactModel::move_frames_with_supports(const double t)
  {
    constexpr unsigned int most  = 50;
    constexpr double       small = 1e-14;
    for (unsigned int n = 0; n < most; ++n)
      {
        const Eigen::VectorXd placement = motions.placement(t);
        move_frames(placement);
        if (turn_of_frames(placement) <= small)
          return;
      }
  }

  const pairing::ContactNode *
  ContactModel::held_twice() const
  {
    if (points.n_bound() == 0)
      return nullptr;
    const auto *const bodies_by_themselves =
      dynamic_cast<const DualBackend *>(condensed.get());
    const Eigen::SparseMatrix<double> open =
      bodies_by_themselves != nullptr ?
        bodies_by_themselves->redundant_rows().open :
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
        // Where supports hold both sides, as in a plane of symmetry, nothing is
        // to share, nor is it on an axis.
        const pairing::ContactNode &node = **nodes.begin();
        if (nodes.size() > 1 ||
            (node.masters.empty() &&
             !(bodies.structures[node.body]->is_axisymmetric() &&
               node.position[0] == 0)))
          return &node;
      }
    return nullptr;
  }

  bool
  ContactModel::needs_dual() const
  {
    if (points.n_bound() > 0)
      return true;
    if (points.size() == 0)
      return false;
    // One stiffness K with a frame at each node serves only where each node is
    // in one contact, with an obstacle, and all of its slip is elastic. Bodies
    // that float lose digits in it, equal bodies would be condensed several
    // times.
    const bool pairs =
      std::any_of(bodies.contact_nodes.begin(),
                  bodies.contact_nodes.end(),
                  [](const pairing::ContactNode &node) {
                    return !node.masters.empty() || !node.slaves.empty();
                  });
    // What slides far has other rows over the same bodies in each increment.
    // Mechanisms are found in a stiffness only, which there is where contacts
    // see all motions; it serves those that are some.
    return pairs || points.slide() || points.have_prescribed_slip() ||
           points.share_nodes() ||
           (may_be_mechanism() ?
              motions.unseen().cols() > 0 ||
                (motions.n_free() > 0 && moves_as_rigid_only()) :
              motions.n_free() > 0 || has_equal_bodies());
  }

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

  double
  ContactModel::way_of_frames() const
  {
    double largest = 0;
    if (!bodies.frames().empty())
      for (const NodeRule &rule : rules.rules())
        largest = std::max(
          largest,
          bodies.displacement(rule.body, rule.node, Tensor<1, 3>()).norm());
    return largest;
  }

  LoadCase
  ContactModel::load_case(const Eigen::VectorXd &mechanical,
                          const Eigen::VectorXd &thermal,
                          const double           t)
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    AssertDimension(mechanical.size(), coordinates.n_dofs());
    // Supports that move as one carry their body along: that is the placement,
    // and no force belongs to it. Only the rest of what they prescribe deforms.
    const Eigen::VectorXd placement  = motions.placement(t);
    Eigen::VectorXd       prescribed = coordinates.prescribed(t);
    Eigen::VectorXd       all        = mechanical + elastic.ground_forces(t);
    double                far        = way_of_frames();
    if (!placement.isZero(0))
      {
        const Eigen::VectorXd rigid = motions.field(placement);
        far                         = std::max(far, solvers::largest(rigid));
        prescribed -= coordinates.held_part(rigid);
        // Foundations do feel the placement.
        all -= elastic.spring_forces(rigid);
      }
    if (const double zero = deformation_rounding * far; zero > 0)
      prescribed = prescribed.unaryExpr(
        [zero](const double d) { return std::abs(d) <= zero ? 0. : d; });
    LoadCase load;
    if (thermal.size() == 0 || is_dual())
      load = condense().reduce(all, prescribed);
    if (is_dual())
      dynamic_cast<const DualBackend &>(condense()).forget_rounding(load);
    if (thermal.size() > 0 && is_dual())
      {
        // Heat presses no body as a whole: its forces cancel up to rounding,
        // and a free motion would take this rounding for a load.
        LoadCase heat =
          condense().reduce(thermal, Eigen::VectorXd::Zero(prescribed.size()));
        const solvers::ContactSystem &system = *condense().system();
        for (Eigen::Index j = system.n_contact_unknowns();
             j < system.n_unknowns();
             ++j)
          if (system.matrix(j, j) == 0) // rounding must not drive a body
            heat.f[j] = 0;
        load.b += heat.b;
        load.f += heat.f;
        if (heat.bound.size() > 0)
          load.bound += heat.bound;
      }
    else if (thermal.size() > 0)
      load = condense().reduce(all + thermal, prescribed);
    load.placement               = placement;
    const Eigen::VectorXd offset = all_offsets(load, t);
    load.offset                  = offset.head(points.n_unknowns());
    condense().move_bound(offset.tail(points.n_bound_unknowns()) +
                            points.gaps_to_close(),
                          load);
    return load;
  }

  /* What contacts see of placements and prescribed deformations, less the
     motion of obstacles: displacements that are no unknowns. */
  Eigen::VectorXd
  ContactModel::all_offsets(const LoadCase &load, const double t) const
  {
    return points.components(
      [&](const unsigned int body, const unsigned int node) {
        Tensor<1, 3>       u   = motions.at(load.placement, body, node);
        const Eigen::Index dof = coordinates.dof(body, node);
        for (unsigned int c = 0; c < bodies.dim; ++c)
          u[c] += load.prescribed[dof + c];
        return bodies.displacement(body, node, u);
      },
      t);
  }

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

  Eigen::VectorXd
  ContactModel::amounts(const Eigen::VectorXd &placement,
                        const Eigen::VectorXd &a) const
  {
    AssertDimension(a.size(), motions.n_free());
    return placement + motions.of_free(a);
  }

  std::string
  ContactModel::singular_sentence(const backends::SingularMatrix &error) const
  {
    std::string text = "Some part of a body can move although supports and "
                       "contact nodes hold all bodies";
    std::string hint;
    if (error.node)
      {
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
           (hint.empty() ? "" : " " + hint);
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

  std::unique_ptr<ElasticBackend>
  ContactModel::make_backend() const
  {
    if (large)
      return std::make_unique<IterativeBackend>(elastic,
                                                rules,
                                                points,
                                                motions);
    if (is_dual())
      return std::make_unique<DualBackend>(
        elastic, points, coordinates, motions, chosen, condenser);
    return std::make_unique<Condensation>(elastic,
                                          rules,
                                          points,
                                          chosen,
                                          motions.null_space(),
                                          may_be_mechanism(),
                                          condenser);
  }

  backends::FactorEstimate
  ContactModel::estimate_factor() const
  {
    if (condenses_bodies())
      return DualBackend::estimate(
        elastic, points, coordinates, motions, working_set(), condenser);
    return estimate_condensation(
      elastic, rules, points, working_set(), condenser);
  }

  double
  ContactModel::hardest_slave() const
  {
    return contact::hardest_slave(elastic, coordinates, points);
  }

  void
  ContactModel::solve_iteratively()
  {
    if (const std::string why = why_not_iterative(); !why.empty())
      throw InputError("Solver, Backend = iterative " + why +
                       ". Set Backend = condensed, or automatic.");
    large = true;
  }

  void
  ContactModel::solve_condensed()
  {
    large = false;
    choose(WorkingSet(points.layout()));
  }

  const IterativeBackend &
  ContactModel::iterative_backend()
  {
    return dynamic_cast<const IterativeBackend &>(condense());
  }

  ElasticBackend &
  ContactModel::condense()
  {
    try
      {
        if (!condensed)
          condensed = make_backend();
      }
    catch (const backends::SingularMatrix &error)
      {
        throw InputError(singular_sentence(error));
      }
    return *condensed;
  }

  std::vector<StiffnessDifference>
  ContactModel::compare_stiffness(const backends::Condenser &other)
  {
    try
      {
        return condense().compare(other);
      }
    catch (const backends::SingularMatrix &error)
      {
        throw AnalysisError(std::string(other.name) +
                            " finds what Solver/Condensation did not: " +
                            singular_sentence(error));
      }
  }

  void
  ContactModel::choose(WorkingSet set)
  {
    former_work = work();
    condensed.reset();
    chosen = std::move(set);
  }

  void
  ContactModel::relink(std::vector<pairing::ContactNode> nodes,
                       Eigen::VectorXd                  &elastic_unknowns)
  {
    turn_ties(bodies, nodes);
    points.relink(std::move(nodes), times);
    motions.see_contacts(points);
    if (condensed && is_dual()) // without contacts there are no rows
      dynamic_cast<DualBackend &>(*condensed).relink();
    if (!condensed || !large)
      return;
    const IterativeBackend &former = iterative_backend();
    if (former.fits_contacts())
      return;
    if (!why_not_iterative().empty()) // nor can it be made
      {
        condensed.reset();
        return;
      }
    Eigen::VectorXd u;
    if (elastic_unknowns.size() > 0)
      u = former.displacements_of(elastic_unknowns);
    condensed.reset(); // before there is another one
    if (u.size() > 0)
      elastic_unknowns = iterative_backend().values_of(u);
  }

  bool
  ContactModel::lock_cuts(const double t, const Eigen::VectorXd &u)
  {
    bool any = false;
    for (Cut &cut : bodies.change_cuts())
      if (!cut.opening && cut.is_due(t))
        {
          cut.opening = u.size() > 0 ? opening(cut, u) : 0.;
          any         = true;
        }
    if (!any)
      return false;
    motions.find_again(points);
    if (condensed)
      dynamic_cast<DualBackend &>(*condensed).see_motions();
    return true;
  }

  double
  ContactModel::opening(const Cut &cut, const Eigen::VectorXd &u) const
  {
    AssertDimension(u.size(), coordinates.n_dofs());
    return displacement(u, cut.body, 0) * cut.axis;
  }

  Eigen::VectorXd
  ContactModel::lock_forces(const Eigen::VectorXd &all_reactions) const
  {
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(coordinates.n_dofs());
    for (const Cut &cut : bodies.cuts())
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

  bool
  ContactModel::extend(const std::vector<Eigen::Index> &nodes)
  {
    return condense().extend(nodes);
  }

  backends::SchurWork
  ContactModel::work() const
  {
    backends::SchurWork sum = former_work;
    if (condensed)
      sum += condensed->work();
    return sum;
  }

  namespace
  {
    std::vector<Tensor<1, 3>>
    directions_of(const ContactPoints &points)
    {
      std::vector<Tensor<1, 3>> all;
      for (const ContactPoint &point : points.all())
        all.insert(all.end(), point.directions.begin(), point.directions.end());
      return all;
    }

    std::vector<double>
    to_numbers(const std::vector<solvers::NodeState> &states)
    {
      std::vector<double> numbers;
      for (const solvers::NodeState state : states)
        numbers.push_back(static_cast<double>(state));
      return numbers;
    }

    std::vector<solvers::NodeState>
    to_states(const std::vector<double> &numbers)
    {
      std::vector<solvers::NodeState> states;
      for (const double number : numbers)
        states.push_back(static_cast<solvers::NodeState>(number));
      return states;
    }
  } // namespace

  ContactHistory::ContactHistory(ContactModel &m)
    : model(&m)
    , initial_gap(m.points.layout().n_nodes())
    , q(Eigen::VectorXd::Zero(m.points.n_unknowns()))
    , r(q)
    , elastic(m.is_iterative() ? Eigen::VectorXd() : q)
    , a(Eigen::VectorXd::Zero(m.motions.n_free()))
    , base(a)
  {
    Eigen::Index i = 0;
    for (const ContactPoint &point : model->points)
      initial_gap[i++] = point.node->gap;
  }

  /* The law counts the slip from the start of the increment, and the gap from
     zero: v = H u + o + shift. */
  Eigen::VectorXd
  ContactHistory::shift() const
  {
    const solvers::ContactSystem &layout = model->points.layout();
    Eigen::VectorXd               s      = -q;
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      s[layout.normal(i)] = initial_gap[i];
    return s;
  }

  // Bodies that are moved until they touch miss each other by rounding only,
  // which must not press them.
  Eigen::VectorXd
  ContactHistory::offset_at(const LoadCase &load) const
  {
    const solvers::ContactSystem &layout = model->points.layout();
    Eigen::VectorXd               sum    = load.offset + shift();
    Eigen::VectorXd               moving = load.offset;
    double moved = conetact::solvers::largest(load.placement) +
                   conetact::solvers::largest(load.prescribed);
    if (model->is_iterative() && base.size() > 0)
      {
        const Eigen::VectorXd motions = model->motions.seen() * base;
        sum += motions;
        moving += motions;
        moved += conetact::solvers::largest(base);
      }
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      {
        const Eigen::Index k = layout.normal(i);
        if (std::abs(sum[k]) <=
            solvers::position_rounding *
              (std::abs(initial_gap[i]) + std::abs(moving[k]) + moved))
          sum[k] = 0;
      }
    return sum;
  }

  Eigen::VectorXd
  ContactHistory::gaps() const
  {
    const solvers::ContactSystem &layout = model->points.layout();
    Eigen::VectorXd               gap    = initial_gap;
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      gap[i] += q[layout.normal(i)];
    return gap;
  }

  void
  ContactHistory::relink(std::vector<pairing::ContactNode> nodes,
                         const Eigen::VectorXd            &u,
                         const double                      t)
  {
    model->relink(std::move(nodes), elastic);
    Eigen::Index i = 0;
    for (const ContactPoint &point : model->points)
      initial_gap[i++] = point.node->gap;
    if (u.size() > 0)
      q = model->relative_displacements(u, t);
    // Frames have taken the free motions so far.
    for (Eigen::Index j = 0; j < a.size(); ++j)
      if (model->has_frame(
            model->motions.body_of_free()[static_cast<std::size_t>(j)]))
        a[j] = base[j] = 0;
  }

  void
  ContactHistory::save(Archive &archive) const
  {
    archive.put("contact/q", q);
    archive.put("contact/r", r);
    archive.put("contact/elastic", model->is_iterative() ? primal() : elastic);
    archive.put("contact/a", a);
    archive.put("contact/base", base);
    archive.put("contact/largest", largest);
    archive.put("contact/gap", initial_gap);
    archive.put("contact/directions", directions_of(model->points));
    archive.put("contact/states", to_numbers(states));
  }

  void
  ContactHistory::restore(const Archive &archive)
  {
    Eigen::VectorXd gap(initial_gap.size());
    archive.fill("contact/gap", gap);
    std::vector<Tensor<1, 3>> now = directions_of(model->points), then(now);
    archive.fill("contact/directions", then);
    double turned = conetact::solvers::largest(gap - initial_gap) /
                    std::max(conetact::solvers::largest(gap), 1e-300);
    for (std::size_t i = 0; i < now.size(); ++i)
      turned = std::max(turned, (now[i] - then[i]).norm());
    if (turned > 1e-9)
      throw InputError("The checkpoint does not fit the scene: contact nodes "
                       "have other gaps or directions. Meshes, obstacles and "
                       "supports of contact nodes must be those of the run "
                       "that is continued.");
    archive.fill("contact/q", q);
    archive.fill("contact/r", r);
    archive.fill("contact/largest", largest);
    states = to_states(archive.get("contact/states"));
    // Where other supports leave other motions free, the problem is written
    // about the undeformed place, which is as good.
    if (archive.get("contact/a").size() == static_cast<std::size_t>(a.size()))
      {
        archive.fill("contact/a", a);
        archive.fill("contact/base", base);
      }
    take_elastic(archive.get("contact/elastic"));
  }

  /* It is where solvers start: unknowns of other supports are others, and those
     of contacts stand behind all others. */
  void
  ContactHistory::take_elastic(const std::vector<double> &kept)
  {
    elastic      = model->is_iterative() ? primal() : q;
    const auto n = static_cast<std::size_t>(elastic.size());
    if (kept.size() == n || (kept.size() > n && !model->is_iterative()))
      std::copy(kept.end() - elastic.size(), kept.end(), elastic.data());
    if (model->is_iterative() || model->is_dual() || a.size() == 0)
      return;
    // One stiffness of all knows no motions apart from displacements.
    elastic += model->motions.seen() * a;
    a = base = Eigen::VectorXd::Zero(a.size());
  }

  void
  ContactHistory::see_condensation()
  {
    take_elastic({elastic.data(), elastic.data() + elastic.size()});
  }

  double
  ContactHistory::motion_force(const LoadCase &load) const
  {
    const solvers::ContactSystem &system = *model->condense().system();
    if (system.n_nodes() == 0)
      return 0;
    return rounding_of_motion * system.diagonal().mean() *
           (conetact::solvers::largest(load.offset) +
            conetact::solvers::largest(load.placement) +
            conetact::solvers::largest(load.prescribed));
  }

  solvers::ContactProblem
  ContactHistory::problem(const LoadCase &load)
  {
    const auto             &system = model->condense().system();
    const WorkingSet       &set    = model->working_set();
    solvers::ContactProblem problem;
    problem.system               = system;
    problem.load                 = load.f;
    problem.gap                  = gaps()(set.nodes());
    problem.reference_force      = rounding_of_past * largest;
    const Eigen::VectorXd offset = set.gather(offset_at(load));
    const Eigen::Index    k      = system->n_motions;
    if (system->form == solvers::Form::stiffness)
      {
        problem.offset = offset;
        largest        = std::max(largest, conetact::solvers::largest(load.f));
        // Open contacts carry nothing, and not all unknowns are theirs.
        if (model->is_iterative())
          problem.reference_force =
            std::max(rounding_of_past * largest, motion_force(load));
        if (model->is_iterative() && !base.isZero(0))
          problem.load -= model->iterative_backend().resistance(base);
        return problem;
      }
    // unknown is what motions change from there on
    problem.load.head(offset.size()) += offset;
    if (k > 0)
      problem.load += system->matrix.rightCols(k) * base;
    // In compliance form f has forces in its balance rows only.
    largest = std::max(largest, conetact::solvers::largest(load.f.tail(k)));
    if (model->points.n_bound() > 0)
      {
        // What is bound may carry nearly all, and leave rounding of it.
        const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(load.f.size());
        largest                       = std::max(largest,
                           conetact::solvers::largest(
                             model->condense().bound_state(load, nothing).r));
        problem.reference_force       = rounding_of_past * largest;
      }
    return problem;
  }

  solvers::ContactState
  ContactHistory::start() const
  {
    const WorkingSet             &set    = model->working_set();
    const solvers::ContactSystem &layout = set.layout();
    const Eigen::VectorXd         gap    = gaps()(set.nodes());
    const Eigen::Index            n      = layout.n_unknowns();
    const Eigen::Index            k      = model->is_dual() ? a.size() : 0;
    solvers::ContactState         state;
    state.v = Eigen::VectorXd::Zero(n + k);
    state.r = Eigen::VectorXd::Zero(n + k);
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      state.v[layout.normal(i)] = gap[i];
    state.r.head(n) = set.gather(r);
    // motions count from where the problem is written about
    state.r.tail(k) = (a - base).head(k);
    state.node      = set.gather(states);
    if (!model->is_dual())
      // u by itself: v - o would round it where bodies have moved far.
      state.u = primal();
    if (model->is_iterative() && a != base)
      state.u += model->iterative_backend().values_of_motions(a - base);
    return state;
  }

  bool
  ContactHistory::linearise_about(const solvers::ContactProblem &problem,
                                  const solvers::ContactState   &state)
  {
    if (a.size() == 0)
      return false;
    const Eigen::MatrixXd    &G = model->motions.seen();
    std::vector<Eigen::Index> closed;
    for (Eigen::Index i = 0; i < problem.system->n_nodes(); ++i)
      if (state.node[static_cast<std::size_t>(i)] != solvers::NodeState::open)
        closed.push_back(problem.system->normal(i));
    if (closed.empty())
      return false;
    const Eigen::MatrixXd normals = G(closed, Eigen::all);
    const Eigen::VectorXd way =
      normals.completeOrthogonalDecomposition().solve(-problem.offset(closed));
    const Eigen::VectorXd rest =
      state.nearby - model->iterative_backend().values_of_motions(way);
    if (!(solvers::largest(way) > solvers::largest(rest)))
      return false;
    base += way;
    return true;
  }

  Eigen::VectorXd
  ContactHistory::nearby(const Eigen::VectorXd &w,
                         Eigen::VectorXd        motions) const
  {
    for (Eigen::Index j = 0; j < a.size(); ++j)
      if (model->has_frame(
            model->motions.body_of_free()[static_cast<std::size_t>(j)]))
        motions[j] = base[j];
    const IterativeBackend &backend = model->iterative_backend();
    Eigen::VectorXd         u       = backend.values_of(w);
    if (motions != base)
      u += backend.values_of_motions(motions - base);
    return u;
  }

  void
  ContactHistory::advance(const solvers::ContactState &end)
  {
    AssertDimension(end.node.size(), model->working_set().nodes().size());
    Assert(end.r.allFinite() && end.v.allFinite(),
           dealii::ExcMessage("Only finite states become history."));
    const WorkingSet             &set    = model->working_set();
    const solvers::ContactSystem &layout = set.layout();
    const Eigen::Index            n      = layout.n_unknowns();
    const Eigen::VectorXd         gap    = initial_gap(set.nodes());
    Eigen::VectorXd               own    = set.gather(q) + end.v.head(n);
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      // v has slips of the increment, but the gap itself.
      own[layout.normal(i)] = end.v[layout.normal(i)] - gap[i];
    set.scatter(own, q);
    set.scatter(end.r.head(n), r);
    if (end.r.size() > n)
      // The next problem is written about where its bodies are then.
      a = base = base + end.r.tail(a.size());
    if (model->is_iterative())
      {
        elastic = end.u;
        take_motions();
      }
    else if (end.u.size() == n)
      set.scatter(end.u, elastic);
    states = set.scatter(end.node);
    if (r.size() > 0)
      largest = std::max(largest, r.cwiseAbs().maxCoeff());
  }

  void
  ContactHistory::move(solvers::ContactState &end,
                       const Eigen::VectorXd &amounts,
                       const double           largest_force) const
  {
    const WorkingSet     &set = model->working_set();
    const Eigen::VectorXd seen =
      set.gather(Eigen::VectorXd(model->motions.seen() * amounts));
    end.v.head(seen.size()) += seen;
    if (model->is_iterative())
      end.u += model->iterative_backend().values_of_motions(amounts);
    else if (model->condense().system()->form == solvers::Form::compliance)
      end.r.tail(amounts.size()) += amounts;
    else
      end.u += seen;
    // What carried nothing may have left or slipped, and what stuck at its
    // limit may slip.
    const double zero = 1e-12 * conetact::solvers::largest(amounts);
    const solvers::ContactSystem &layout = set.layout();
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      {
        const Eigen::Index  n = layout.normal(i), nt = layout.n_tangents(i);
        const bool          empty = presses_nothing(end.r[n], largest_force);
        solvers::NodeState &state = end.node[static_cast<std::size_t>(i)];
        if (empty && end.v[n] > zero)
          {
            end.r.segment(n - nt, nt + 1).setZero();
            state = solvers::NodeState::open;
          }
        else if (state == solvers::NodeState::stick &&
                 end.v.segment(n - nt, nt).norm() > zero &&
                 (empty || is_at_limit(end.r.segment(n - nt, nt),
                                       layout.mu(i) * end.r[n])))
          state = solvers::NodeState::slip;
      }
  }

  /* What moves bodies as a whole would cost the digits of what strains them:
     amounts of their own have it. */
  void
  ContactHistory::take_motions()
  {
    if (a.size() == 0)
      return;
    const IterativeBackend &backend = model->iterative_backend();
    const Eigen::VectorXd   more    = backend.motions_in(elastic);
    elastic -= backend.values_of_motions(more);
    a = base = base + more;
  }

  Eigen::VectorXd
  ContactHistory::primal() const
  {
    const WorkingSet &set = model->working_set();
    if (model->is_iterative() && elastic.size() == 0) // nothing has moved
      return Eigen::VectorXd::Zero(
        model->condense().system()->large->n_unknowns());
    if (model->is_iterative())
      return elastic;
    if (!model->is_dual())
      return set.gather(elastic);
    Eigen::VectorXd result(set.layout().n_unknowns() + a.size());
    result << set.gather(r), a;
    return result;
  }

  void
  ContactHistory::recover(const Eigen::VectorXd &displacements)
  {
    // Those of the set are the solver's own, exact in their zeros; recovered
    // from u they would be rounded.
    const Eigen::VectorXd own = model->working_set().gather(q);
    q                         = displacements;
    model->working_set().scatter(own, q);
  }

  solvers::ContactState
  ContactHistory::of_candidates(const solvers::ContactState &end,
                                const ContactHistory        &before) const
  {
    const WorkingSet             &set    = model->working_set();
    const solvers::ContactSystem &layout = model->points.layout();
    // Candidates outside the set are open; their slip is what they moved by.
    solvers::ContactState state{q - before.q, r, set.scatter(end.node)};
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      state.v[layout.normal(i)] = initial_gap[i] + q[layout.normal(i)];
    set.scatter(end.v.head(set.layout().n_unknowns()), state.v);
    return state;
  }
} // namespace conetact::contact

// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_history.h"

#include "conetact/base/errors.h"
#include "conetact/contact/open_motions.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace conetact::contact
{
  namespace
  {
    /** As checkpoints name them. */
    constexpr std::pair<const char *, Eigen::VectorXd LawMemory::*>
      numbers_of_memory[] = {{"contact/slipped", &LawMemory::slipped},
                             {"contact/shorn", &LawMemory::shorn},
                             {"contact/packed", &LawMemory::packed},
                             {"contact/opened", &LawMemory::opened},
                             {"contact/parted", &LawMemory::parted},
                             {"contact/broken", &LawMemory::broken}};

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
  {
    forget_motions();
    for (const auto &[name, number] : numbers_of_memory)
      laws_know.*number = Eigen::VectorXd::Zero(initial_gap.size());
    laws_know.wear          = Wear(initial_gap.size());
    constexpr double closed = 1e-6; // of an edge
    Eigen::Index     i      = 0;
    for (const ContactPoint &point : model->points)
      {
        // A bond is that of nodes which are closed at the start. Others have
        // opened by as much as can be: no law of a bond holds there.
        initial_gap[i] = point.node->gap;
        if (point.node->gap > closed * point.node->spacing)
          laws_know.opened[i] = pairing::never_closed;
        ++i;
      }
  }

  // Bodies that are moved until they touch miss each other by rounding only,
  // which must not press them.
  Eigen::VectorXd
  ContactHistory::offset_at(const LoadCase &load) const
  {
    AssertDimension(load.offset.size(), q.size());
    using conetact::solvers::largest;
    const solvers::ContactSystem &layout  = model->points.layout();
    const Eigen::VectorXd        &receded = laws_know.wear.receded();
    // The law counts the slip from the start of the increment, and the gap from
    // zero: v = H u + o + shift.
    Eigen::VectorXd sum = load.offset - q;
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      {
        const Eigen::Index k = layout.normal(i);
        sum[k]               = load.offset[k] + (initial_gap[i] + receded[i]);
      }
    Eigen::VectorXd moving = load.offset;
    double          moved  = largest(load.placement) + largest(load.prescribed);
    if (const Eigen::VectorXd motions =
          model->elasticity().states().moved_by(elastic.base);
        motions.size() > 0)
      {
        sum += motions;
        moving += motions;
        moved += largest(elastic.base);
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

  /* g = g_0 + u_n, and what has worn off opens it as well. */
  Eigen::VectorXd
  ContactHistory::gaps() const
  {
    const solvers::ContactSystem &layout = model->points.layout();
    Eigen::VectorXd               gap = initial_gap + laws_know.wear.receded();
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      gap[i] += q[layout.normal(i)];
    return gap;
  }

  std::string
  ContactHistory::relink(std::vector<pairing::ContactNode> nodes,
                         const Eigen::VectorXd            &u,
                         const double                      t)
  {
    Assert(u.size() == 0 || u.size() == model->coordinates.n_dofs(),
           dealii::ExcMessage("Displacements of all dofs, or none yet."));
    if (std::string why = model->relink(std::move(nodes), elastic);
        !why.empty())
      return why;
    Eigen::Index i = 0;
    for (const ContactPoint &point : model->points)
      initial_gap[i++] = point.node->gap;
    laws_know.wear.stand(model->points);
    if (u.size() > 0)
      q = model->relative_displacements(u, t);
    // Frames have taken the free motions so far.
    for (Eigen::Index j = 0; j < elastic.motions.size(); ++j)
      if (model->frames.has(
            model->motions.body_of_free()[static_cast<std::size_t>(j)]))
        elastic.motions[j] = elastic.base[j] = 0;
    return {};
  }

  void
  ContactHistory::save(const Eigen::VectorXd &elastic_start,
                       Archive               &archive) const
  {
    archive.put("contact/q", q);
    archive.put("contact/r", r);
    archive.put("contact/elastic", elastic_start);
    archive.put("contact/a", elastic.motions);
    archive.put("contact/base", elastic.base);
    archive.put("contact/largest", largest);
    for (const auto &[name, number] : numbers_of_memory)
      archive.put(name, laws_know.*number);
    laws_know.wear.save(archive);
    archive.put("contact/time", time);
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
    // Gaps are compared over the largest of them, as lengths have no other
    // scale here; directions are unit vectors.
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
    for (const auto &[name, number] : numbers_of_memory)
      archive.fill(name, laws_know.*number);
    laws_know.wear.restore(archive, model->points);
    archive.fill("contact/time", time);
    states = to_states(archive.get("contact/states"));
    // Where other supports leave other motions free, the problem is written
    // about the undeformed place, which is as good.
    if (archive.get("contact/a").size() ==
        static_cast<std::size_t>(elastic.motions.size()))
      {
        archive.fill("contact/a", elastic.motions);
        archive.fill("contact/base", elastic.base);
      }
    model->elasticity().states().restore(archive.get("contact/elastic"),
                                         q,
                                         elastic);
  }

  /* Another Elasticity has other unknowns: its start is made from the
     displacements that contacts remember. */
  void
  ContactHistory::see_elasticity()
  {
    const Eigen::VectorXd &start = numbers(elastic.start);
    model->elasticity().states().restore(
      {start.data(), start.data() + start.size()}, q, elastic);
  }

  solvers::ContactProblem
  ContactHistory::problem(const LoadCase &load)
  {
    const Elasticity       &bodies = model->elasticity();
    solvers::ContactProblem problem;
    problem.system = bodies.system();
    problem.laws   = load.laws;
    problem.gap    = gaps();
    // What is rounding beside the largest force so far is none: a load that has
    // almost gone must not be judged by itself.
    const ForceScale scale = bodies.force_scale(load);
    problem.reference_force =
      std::max(rounding_of_past * largest, scale.reference);
    bodies.write(load, offset_at(load), elastic, problem);
    largest = std::max(largest, scale.largest);
    return problem;
  }

  /* Where an increment starts nothing has slipped in it, v = (0, g). States and
     reactions are those of its start, for most nodes keep theirs. */
  solvers::ContactState
  ContactHistory::start() const
  {
    const solvers::ContactSystem &layout = model->points.layout();
    const Eigen::VectorXd         gap    = gaps();
    solvers::ContactState         state;
    state.v = Eigen::VectorXd::Zero(layout.n_unknowns());
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      state.v[layout.normal(i)] = gap[i];
    state.r    = r;
    state.node = states;
    model->elasticity().states().begin(elastic, state);
    return state;
  }

  /* Frames have taken what bodies that have one moved as a whole: only the
     others have it in their motions. */
  Eigen::VectorXd
  ContactHistory::nearby(const Eigen::VectorXd &w,
                         Eigen::VectorXd        motions) const
  {
    if (w.size() == 0)
      return {};
    for (Eigen::Index j = 0; j < motions.size(); ++j)
      if (model->frames.has(
            model->motions.body_of_free()[static_cast<std::size_t>(j)]))
        motions[j] = elastic.base[j];
    return model->elasticity().states().nearby(w, motions - elastic.base);
  }

  std::shared_ptr<const IncrementLaws>
  ContactHistory::laws_until(const double             t,
                             const Temperature       &temperature,
                             const std::vector<bool> &wet) const
  {
    const ContactPoints &points = model->points;
    if (!has_nodal_laws(points))
      return {};
    Assert(t > time, dealii::ExcMessage("Time goes on."));
    const Eigen::VectorXd           gap = gaps();
    std::vector<pairing::Situation> known(points.size());
    for (std::size_t i = 0; i < known.size(); ++i)
      {
        const pairing::ContactNode &node = *points[i].node;
        known[i].position                = node.position;
        known[i].t                       = t;
        known[i].slipped = laws_know.slipped[static_cast<Eigen::Index>(i)];
        known[i].shorn   = laws_know.shorn[static_cast<Eigen::Index>(i)];
        known[i].opened  = laws_know.opened[static_cast<Eigen::Index>(i)];
        known[i].packed  = laws_know.packed[static_cast<Eigen::Index>(i)];
        known[i].gap     = gap[static_cast<Eigen::Index>(i)];
        if (pairing::has_law_of_temperature(node))
          known[i].temperature = temperature(node.body, node.position);
      }
    return std::make_shared<IncrementLaws>(
      points, std::move(known), r, t - time, wet);
  }

  void
  ContactHistory::advance(const solvers::ContactState &end,
                          const double                 t,
                          const IncrementLaws *const   laws)
  {
    AssertDimension(end.node.size(), model->points.size());
    Assert(end.r.allFinite() && end.v.allFinite(),
           dealii::ExcMessage("Only finite states become history."));
    const solvers::ContactSystem &layout = model->points.layout();
    const Eigen::Index            n      = layout.n_unknowns();
    q += end.v.head(n);
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      // v has slips of the increment, but the gap itself.
      q[layout.normal(i)] =
        end.v[layout.normal(i)] - initial_gap[i] - laws_know.wear.receded()[i];
    r = end.r.head(n);
    model->elasticity().states().end(end, elastic);
    states = end.node;
    time   = t;
    if (laws != nullptr)
      {
        laws_know.slipped += laws->slips(end);
        laws_know.shorn += laws->shears(end);
        // Both are of this increment: what wears is a slip times a pressure.
        laws_know.wear.add(model->points, laws->wear(end), laws->areas());
        laws_know.packed = laws_know.packed.cwiseMax(laws->pressures(end));
      }
    if (laws != nullptr && laws->has_bonds())
      {
        laws_know.broken += laws->fracture(laws_know.parted, end);
        laws_know.parted = laws->openings(end);
        laws_know.opened = laws_know.opened.cwiseMax(laws_know.parted);
      }
    else
      laws_know.parted.setZero();
    if (n > 0)
      largest = std::max(largest, r.cwiseAbs().maxCoeff());
  }

  void
  ContactHistory::move(solvers::ContactState &end,
                       const Eigen::VectorXd &amounts,
                       const double           largest_force) const
  {
    AssertDimension(amounts.size(), model->motions.n_free());
    AssertDimension(end.node.size(), model->points.size());
    Assert(largest_force >= 0, dealii::ExcMessage("A force has no sign here."));
    const Eigen::VectorXd seen = // BLAS does not take matrices of size 0
      model->motions.seen().lazyProduct(amounts);
    end.v.head(seen.size()) += seen;
    model->elasticity().states().move(amounts, seen, end);
    // What carried nothing may have left or slipped, and what stuck at its
    // limit may slip.
    const double zero = 1e-12 * conetact::solvers::largest(amounts);
    const solvers::ContactSystem &layout = model->points.layout();
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      {
        const Eigen::Index  n = layout.normal(i), nt = layout.n_tangents(i);
        const bool          empty = carries_nothing(end.r[n], largest_force);
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
} // namespace conetact::contact

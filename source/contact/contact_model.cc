// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_model.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>

namespace conetact
{
  ContactModel::ContactModel(const Bodies &b, const std::vector<double> &times)
    : bodies(b)
    , rules(bodies, times)
    , coordinates(bodies, rules)
    , elastic(bodies)
    , motions(bodies, rules, coordinates)
    , chosen(coordinates.layout())
  {}

  std::string
  ContactModel::singular_sentence(const SingularMatrix &error) const
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
                       [](const Structure *structure) {
                         return structure->may_be_mechanism();
                       });
  }

  Condensation &
  ContactModel::condensation()
  {
    try
      {
        if (!condensed)
          condensed = std::make_unique<Condensation>(elastic,
                                                     coordinates,
                                                     chosen,
                                                     motions.null_space(),
                                                     may_be_mechanism());
      }
    catch (const SingularMatrix &error)
      {
        throw InputError(singular_sentence(error));
      }
    return *condensed;
  }

  void
  ContactModel::choose(WorkingSet set)
  {
    former_work = work();
    condensed.reset();
    chosen = std::move(set);
  }

  void
  ContactModel::extend(const std::vector<Eigen::Index> &nodes)
  {
    condensation().extend(nodes, motions.null_space());
  }

  SchurWork
  ContactModel::work() const
  {
    SchurWork sum = former_work;
    if (condensed)
      sum += condensed->work();
    return sum;
  }

  ContactHistory::ContactHistory(ContactModel &m)
    : model(&m)
    , initial_gap(m.coordinates.layout().n_nodes())
    , q(Eigen::VectorXd::Zero(m.coordinates.n_contact_unknowns()))
    , r(q)
  {
    Eigen::Index i = 0;
    for (const NodeRule *rule : model->coordinates.contact_rules())
      initial_gap[i++] = rule->contact_node->gap;
  }

  Eigen::VectorXd
  ContactHistory::shift() const
  {
    const ContactSystem &layout = model->coordinates.layout();
    Eigen::VectorXd      s      = -q;
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      s[layout.normal(i)] = initial_gap[i];
    return s;
  }

  Eigen::VectorXd
  ContactHistory::gaps() const
  {
    const ContactSystem &layout = model->coordinates.layout();
    Eigen::VectorXd      gap    = initial_gap;
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      gap[i] += q[layout.normal(i)];
    return gap;
  }

  ContactProblem
  ContactHistory::problem(const Condensation::Load &load)
  {
    const auto       &system = model->condensation().system();
    const WorkingSet &set    = model->working_set();
    ContactProblem    problem;
    problem.system            = system;
    problem.load              = load.f;
    const Eigen::VectorXd own = set.gather(shift());
    problem.load.noalias() +=
      system->matrix.selfadjointView<Eigen::Lower>() * own;
    problem.gap             = gaps()(set.nodes());
    problem.reference_force = largest;
    if (load.f.size() > 0)
      largest = std::max(largest, load.f.cwiseAbs().maxCoeff());
    return problem;
  }

  ContactState
  ContactHistory::start() const
  {
    const WorkingSet     &set    = model->working_set();
    const ContactSystem  &layout = set.layout();
    const Eigen::VectorXd gap    = gaps()(set.nodes());
    ContactState          state;
    state.v = Eigen::VectorXd::Zero(layout.n_unknowns());
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      state.v[layout.normal(i)] = gap[i];
    state.r    = set.gather(r);
    state.node = set.gather(states);
    return state;
  }

  void
  ContactHistory::advance(const ContactState &end)
  {
    const WorkingSet     &set    = model->working_set();
    const ContactSystem  &layout = set.layout();
    const Eigen::VectorXd gap    = initial_gap(set.nodes());
    Eigen::VectorXd       own    = set.gather(q) + end.v;
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      own[layout.normal(i)] = end.v[layout.normal(i)] - gap[i];
    set.scatter(own, q);
    set.scatter(end.r, r);
    states = set.scatter(end.node);
    if (r.size() > 0)
      largest = std::max(largest, r.cwiseAbs().maxCoeff());
  }

  void
  ContactHistory::recover(const Eigen::VectorXd &displacements)
  {
    const Eigen::VectorXd own = model->working_set().gather(q);
    q                         = displacements;
    model->working_set().scatter(own, q);
  }

  ContactState
  ContactHistory::of_candidates(const ContactState   &end,
                                const ContactHistory &before) const
  {
    const WorkingSet    &set    = model->working_set();
    const ContactSystem &layout = model->coordinates.layout();
    ContactState         state{q - before.q, r, set.scatter(end.node)};
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      state.v[layout.normal(i)] = initial_gap[i] + q[layout.normal(i)];
    set.scatter(end.v, state.v);
    return state;
  }
} // namespace conetact

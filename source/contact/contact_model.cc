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
                                                     motions.null_space(),
                                                     may_be_mechanism());
      }
    catch (const SingularMatrix &error)
      {
        throw InputError(singular_sentence(error));
      }
    return *condensed;
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

  ContactProblem
  ContactHistory::problem(const Condensation::Load &load)
  {
    const auto    &system = model->condensation().system();
    ContactProblem problem;
    problem.system = system;
    problem.load   = load.f;
    problem.load.noalias() +=
      system->matrix.selfadjointView<Eigen::Lower>() * shift();
    problem.gap.resize(system->n_nodes());
    for (Eigen::Index i = 0; i < system->n_nodes(); ++i)
      problem.gap[i] = initial_gap[i] + q[system->normal(i)];
    problem.reference_force = largest;
    if (load.f.size() > 0)
      largest = std::max(largest, load.f.cwiseAbs().maxCoeff());
    return problem;
  }

  ContactState
  ContactHistory::start() const
  {
    const ContactSystem &layout = model->coordinates.layout();
    ContactState         state;
    state.v = Eigen::VectorXd::Zero(q.size());
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      state.v[layout.normal(i)] = initial_gap[i] + q[layout.normal(i)];
    state.r    = r;
    state.node = states;
    return state;
  }

  void
  ContactHistory::advance(const ContactState &end)
  {
    const ContactSystem &layout = model->coordinates.layout();
    q += end.v;
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      q[layout.normal(i)] = end.v[layout.normal(i)] - initial_gap[i];
    r      = end.r;
    states = end.node;
    if (r.size() > 0)
      largest = std::max(largest, r.cwiseAbs().maxCoeff());
  }
} // namespace conetact

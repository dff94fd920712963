// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/condensed_compliance.h"
#include "conetact/contact/condensed_stiffness.h"
#include "conetact/contact/contact_model.h"
#include "conetact/contact/elasticity_row.h"
#include "conetact/contact/iterative_elasticity.h"
#include "conetact/contact/iterative_limits.h"

namespace conetact::contact
{
  namespace
  {
    std::string
    nothing(const ContactModel &)
    {
      return "";
    }

    std::string
    what_cannot_be_iterated(const ContactModel &model)
    {
      return why_not_iterative(model.bodies, model.rules, model.points);
    }

    std::unique_ptr<Elasticity>
    condense(const ContactModel &m, const condensed::Condenser &condenser)
    {
      if (m.condensed_form() == solvers::Form::compliance)
        return std::make_unique<CondensedCompliance>(
          m.elastic, m.points, m.coordinates, m.motions, condenser);
      return std::make_unique<CondensedStiffness>(m.elastic,
                                                  m.points,
                                                  m.coordinates,
                                                  m.motions,
                                                  m.may_be_mechanism(),
                                                  condenser);
    }

    std::unique_ptr<Elasticity>
    make_levels(const ContactModel &m, const condensed::Condenser &)
    {
      return std::make_unique<IterativeElasticity>(
        m.elastic, m.rules, m.points, m.motions, m.preconditioner);
    }
  } // namespace

  const std::vector<ElasticityRow> &
  elasticity_table()
  {
    static const std::vector<ElasticityRow> table = {
      {"condensed", &nothing, &condense},
      {"iterative", &what_cannot_be_iterated, &make_levels}};
    return table;
  }

  const ElasticityRow &
  condensed_row()
  {
    return elasticity_table()[0];
  }

  const ElasticityRow &
  iterative_row()
  {
    return elasticity_table()[1];
  }

  condensed::FactorEstimate
  estimate_condensed(const ContactModel         &m,
                     const condensed::Condenser &condenser)
  {
    if (m.condensed_form() == solvers::Form::compliance)
      return CondensedCompliance::estimate(
        m.elastic, m.points, m.coordinates, m.motions, condenser);
    return CondensedStiffness::estimate(m.elastic,
                                        m.points,
                                        m.coordinates,
                                        condenser);
  }
} // namespace conetact::contact

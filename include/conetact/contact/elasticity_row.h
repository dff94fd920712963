// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_elasticity_row_h
#define conetact_contact_elasticity_row_h

#include "conetact/contact/elasticity.h"

#include <memory>
#include <string>
#include <vector>

namespace conetact::contact
{
  class ContactModel;

  /** A way to answer forces by displacements that a scene may name. */
  struct ElasticityRow
  {
    const char *name;
    /** What it cannot do, as the end of a sentence; empty: it can. */
    std::string (*why_not)(const ContactModel &model);
    /** Throws SingularMatrix. The model must outlive the result. */
    std::unique_ptr<Elasticity> (*create)(
      const ContactModel         &model,
      const condensed::Condenser &condenser);
  };
  /** The default first. */
  const std::vector<ElasticityRow> &
  elasticity_table();

  /** Rows by themselves. */
  const ElasticityRow &
  condensed_row();
  const ElasticityRow &
  iterative_row();

  /** What the factorisations of condensed bodies will take. */
  condensed::FactorEstimate
  estimate_condensed(const ContactModel         &model,
                     const condensed::Condenser &condenser);
} // namespace conetact::contact

#endif

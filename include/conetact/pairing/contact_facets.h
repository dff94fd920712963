// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_contact_facets_h
#define conetact_pairing_contact_facets_h

#include "conetact/pairing/contact_nodes.h"
#include "conetact/pairing/facets.h"

#include <optional>

namespace conetact::pairing
{
  /** The facets of both sides of a contact. */
  class ContactFacets
  {
  public:
    ContactFacets(const Contact                                &contact,
                  const std::vector<const bodies::Structure *> &structures);

    /**
     * By how much facets may change the gap of a node [length]: where gaps are
     * means over faces, those of both sides; else those of the other side, and
     * of its own where it is no vertex of them.
     */
    double
    in_gap(const ContactNode &node) const;
    /** How far the facets of both sides stand off around it [length]. */
    double
    around(const ContactNode &node) const;
    /** The same, or by how much the gap of a mean over bent faces may be below
     * those that it is a mean of. */
    double
    allowance(const ContactNode &node) const;
    /** Of each side [length]. */
    double
    largest_of_slave() const
    {
      return slave ? slave->largest() : 0;
    }
    double
    largest_of_master() const
    {
      return master ? master->largest() : 0;
    }

  private:
    double
    of_other_side(const ContactNode &node) const;

    std::optional<Facets> slave, master; ///< none: it has no facets
  };
} // namespace conetact::pairing

#endif

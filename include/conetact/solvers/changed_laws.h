// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_changed_laws_h
#define conetact_solvers_changed_laws_h

#include "conetact/solvers/nodal_laws.h"

#include <utility>

namespace conetact::solvers
{
  /** Laws that are those of others, but for what a class that derives from it
   * changes: limits are no cones then. */
  class ChangedLaws : public NodalLaws
  {
  public:
    explicit ChangedLaws(std::shared_ptr<const NodalLaws> l)
      : laws(std::move(l))
    {}

    Aspect
    aspect(const Index  node,
           const double s,
           const double slip,
           const double gap) const override
    {
      return laws->aspect(node, s, slip, gap);
    }
    bool
    has_ellipses() const override
    {
      return laws->has_ellipses();
    }
    Layer
    layer(const Index node, const double r_n, const double slip) const override
    {
      return laws->layer(node, r_n, slip);
    }
    bool
    has_cones() const override
    {
      return false;
    }
    bool
    has_layers() const override
    {
      return laws->has_layers();
    }
    Bond
    bond(const Index node, const double slip, const double gap) const override
    {
      return laws->bond(node, slip, gap);
    }
    bool
    is_bonded(const Index node) const override
    {
      return laws->is_bonded(node);
    }
    bool
    has_bonds() const override
    {
      return laws->has_bonds();
    }
    bool
    is_apart(const Index node) const override
    {
      return laws->is_apart(node);
    }
    bool
    is_joined(const Index node) const override
    {
      return laws->is_joined(node);
    }

  protected:
    std::shared_ptr<const NodalLaws> laws;
  };
} // namespace conetact::solvers

#endif

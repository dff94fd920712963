// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_local_system_h
#define conetact_solvers_local_system_h

#include "conetact/solvers/large_system.h"

#include <utility>

namespace conetact::solvers
{
  /** A LargeVector as it comes, of systems of one process. */
  struct LocalVector : LargeVector
  {
    explicit LocalVector(Eigen::VectorXd numbers)
      : x(std::move(numbers))
    {}
    const Eigen::VectorXd x;
  };

  /** A LargeSystem of this process, whose vectors are as they come. */
  class LocalSystem : public LargeSystem
  {
  public:
    Kept
    keep(const Array &x) const override
    {
      return std::make_shared<LocalVector>(x);
    }
    Array
    numbers(const Kept &x) const override
    {
      return array(x);
    }
    Array
    of_contact(const Kept &x) const override
    {
      return array(x).tail(n_contact_unknowns());
    }
    Kept
    add(const Kept &x, const double factor, const Kept &y) const override
    {
      return keep(array(x) + factor * array(y));
    }
    double
    product_elsewhere(const Kept &x, const Kept &y) const override
    {
      const Index n = n_unknowns() - n_contact_unknowns();
      return array(x).head(n).dot(array(y).head(n));
    }

  protected:
    virtual Index
    n_contact_unknowns() const = 0;

    static const Array &
    array(const Kept &x)
    {
      return static_cast<const LocalVector &>(*x).x;
    }
  };
} // namespace conetact::solvers

#endif

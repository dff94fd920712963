// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_shared_vector_h
#define conetact_contact_shared_vector_h

#include <Eigen/Core>

#include <memory>
#include <utility>

namespace conetact::contact
{
  /** Numbers of all dofs or unknowns that several keep, and nobody changes:
   * copies would be most of the memory of a large scene. */
  using SharedVector = std::shared_ptr<const Eigen::VectorXd>;

  /** Shares numbers; where there are none, nothing. */
  inline SharedVector
  shared(Eigen::VectorXd x)
  {
    return x.size() > 0 ?
             std::make_shared<const Eigen::VectorXd>(std::move(x)) :
             nullptr;
  }
  /** The numbers that are shared; empty where there are none. */
  inline const Eigen::VectorXd &
  numbers(const SharedVector &x)
  {
    static const Eigen::VectorXd none;
    return x ? *x : none;
  }
} // namespace conetact::contact

#endif

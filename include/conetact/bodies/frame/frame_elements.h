// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_frame_frame_elements_h
#define conetact_bodies_frame_frame_elements_h

#include "conetact/bodies/elements.h"
#include "conetact/bodies/frame/members.h"

#include <vector>

namespace conetact::bodies
{
  /** Members with the dofs of their nodes. */
  class FrameElements : public Elements
  {
  public:
    /** References must outlive the object. */
    FrameElements(const FrameModel          &model,
                  const std::vector<Member> &members,
                  const unsigned int         n_components);

    void
    for_each(const ElementVisitor &visit) const override;
    void
    add_forces(const Eigen::VectorXd &u, Eigen::VectorXd &f) const override;

    /** Adds what loads exert on nodes. */
    void
    assemble(const std::vector<MemberLoad> &loads, Eigen::VectorXd &f) const;
    /** The twelve dofs of a member, zero where it has none. */
    Member::Vector
    displacements(const Member &member, const Eigen::VectorXd &u) const;

  private:
    /** The dof of entry `k` of the twelve dofs of a member. */
    unsigned int
    dof(const Member &member, const unsigned int k) const;

    const FrameModel          &model;
    const std::vector<Member> &members;
  };
} // namespace conetact::bodies

#endif

// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_warnings_h
#define conetact_analysis_warnings_h

#include "conetact/base/log.h"
#include "conetact/contact/contact_model.h"

#include <set>
#include <string>
#include <vector>

namespace conetact::analysis
{
  /**
   * What the reader of a result must know, each said once: displacements that
   * are not unique, and motions, rotations and strains for which small-strain
   * theory is wrong.
   */
  class Warnings
  {
  public:
    Warnings(const contact::ContactModel &model, Log &log);

    /**
     * False where a motion exists that no contact, friction or support opposes:
     * forces are determined, positions are not.
     */
    bool
    is_determinate(const solvers::ContactState &state,
                   const double                 largest_force,
                   const solvers::NodalLaws    *laws);
    /**
     * False where contacts of a node may share its force otherwise: the law
     * holds for many shares, of which the solver found one.
     */
    bool
    are_forces_determinate(const std::vector<solvers::NodeState> &states,
                           const Eigen::VectorXd                 &r);
    /** `amounts` of rigid motions, deformation w of all dofs. */
    void
    check_size(const Eigen::VectorXd &amounts, const Eigen::VectorXd &w);

    /** Says the sentence the first time that one of this kind comes. */
    void
    once(const std::string &kind, const std::string &sentence);
    bool
    has_said(const std::string &kind) const
    {
      return said.count(kind) > 0;
    }

  private:
    /** Distance of an element's nodes from its first one [length]. */
    double
    shortest_side(const unsigned int body);
    /** Of the lines between nodes of elements, at most. */
    struct Strained
    {
      double strain = 0, turn = 0; ///< [-], [rad]
    };
    /** Both 0: none is large. */
    Strained
    strained(const unsigned int body, const Eigen::VectorXd &w);

    const contact::ContactModel &model;
    Log                         &log;
    std::set<std::string>        said;
    std::vector<double>          shortest_sides; ///< 0: not known yet
  };
} // namespace conetact::analysis

#endif

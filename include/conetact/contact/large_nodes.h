// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_large_nodes_h
#define conetact_contact_large_nodes_h

#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/iterative/elements.h"
#include "conetact/iterative/further_contacts.h"

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace conetact::contact
{
  /** Rotations of frames move the ends of such arms: entries of K are alike
   * then [length]. A power of two, that nothing is rounded. */
  double
  arm_of_rotations(const ElasticSystem &elastic);

  /** The node of each unknown as a LargeSystem has it, with `dim` unknowns at
   * most: the rotations of a node are one by themselves. */
  std::vector<unsigned int>
  nodes_of_unknowns(const Coordinates &coordinates);

  /** Its number in Coordinates. */
  unsigned int
  number_of_node(const unsigned int node);

  /** Entries of K on its diagonal, of all dofs [force/length]. */
  Eigen::VectorXd
  diagonal_of(const ElasticSystem &elastic, const Eigen::Index n_dofs);

  /** Unknowns that elements connect with one of a body, itself included. */
  double
  stencil_of(const bodies::Structure &body);

  /** The hardness of the hardest slave over that of its master, from diagonals
   * of K; 0 where no body meets another one. */
  double
  hardest_slave(const ElasticSystem &elastic,
                const Coordinates   &coordinates,
                const ContactPoints &points);

  /** Nodes of a LargeSystem that are not left to iterations. */
  struct SpecialNodes
  {
    std::set<unsigned int> direct;   ///< see DirectSystem
    std::set<unsigned int> together; ///< see SurfaceSmoother
  };

  /** Slaves that are much harder than their masters are smoothed with these,
   * and so are frames with what meets them, unless there is little of it. */
  SpecialNodes
  special_nodes(const ElasticSystem &elastic,
                const Coordinates   &coordinates,
                const ContactPoints &points);

  /** What contacts without axes of their own (ContactAxes) see of the unknowns;
   * none: no such contact. */
  std::optional<iterative::FurtherContacts>
  further_contacts(const ElasticSystem &elastic,
                   const Coordinates   &coordinates,
                   const ContactPoints &points);

  /** H^T S H of these, which is to be of the system; no longer than they live.
   */
  iterative::Elements
  springs_of(const iterative::FurtherContacts &further);

  /** Displacements of all dofs as these contacts see them, and their reactions
   * on all dofs. */
  Eigen::SparseMatrix<double, Eigen::RowMajor>
  rows_of_further(const model::Bodies &bodies,
                  const Coordinates   &coordinates,
                  const ContactPoints &points);

  /**
   * Sides, as iterative::LargeStiffness has them, of nodes of bodies that
   * forces draw to others (Cut): as such a tie opens one of its sides moves as
   * a whole, which aggregates of nodes of both could not. The node of the
   * opening stays alone.
   */
  std::map<unsigned int, int>
  sides_of_ties(const model::Bodies &bodies, const Coordinates &coordinates);
} // namespace conetact::contact

#endif

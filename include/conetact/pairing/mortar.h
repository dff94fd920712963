// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_mortar_h
#define conetact_pairing_mortar_h

#include "conetact/pairing/contact_nodes.h"

#include <set>
#include <vector>

namespace conetact::pairing
{
  /**
   * Mortar pairing with dual functions: the relative displacement of slave
   * node j is the mean @f$v_j = D_j^{-1} \int \psi_j (u_s - u_m)@f$ over the
   * parts of its faces that see the master, with the dual functions
   * @f$\psi_j@f$ (dual_functions.h) and @f$D_j = \int \psi_j@f$: its area. So
   * @f$v_j = u_j - D_j^{-1} \sum_l M_{jl} u_l,\ M_{jl} = \int \psi_j N_l@f$;
   * both sides are integrated at the same points, hence a constant pressure
   * passes between any two meshes, and no force is lost. Moments are kept
   * where gaps are closed and faces plane. The gap is that mean of the
   * distance, along the mean of the area-weighted normals of both sides
   * (master_normals.h).
   *
   * A node beyond the rim of the master has no function of its own, for on a
   * sliver a force would be a large pressure: on each face it is shared by the
   * nodes that face the master, so that what is covered passes all the same
   * (dual_functions.h; MortarRows::keep_upright where these are too few). On
   * faces of second degree whose contacts stand at corners the functions are
   * those of corner_functions(). A
   * node that hangs gives its function to those it follows. Who takes over
   * meets the master with a mean over both (ContactNode::slaves). Nodes that no
   * face sees, because an edge or a corner meets a face, are paired node to
   * face. (Wohlmuth, Acta Numerica 20 (2011) 569-734; Popp, Gitterle, Gee,
   * Wall, IJNME 83 (2010) 1428-1465.)
   */
  PairedNodes
  pair_by_mortar(const Contact                                &contact,
                 const std::vector<const bodies::Structure *> &structures);

  /**
   * The same of a contact that slides, and of which these slave nodes faced the
   * master last: they do until they are a tenth of a face beyond its rim, and
   * faces meet up to the whole angle of a sharp edge in place of half of it.
   */
  PairedNodes
  pair_by_mortar(const Contact                                &contact,
                 const std::vector<const bodies::Structure *> &structures,
                 const std::set<unsigned int>                 &faced);
} // namespace conetact::pairing

#endif

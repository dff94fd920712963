// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_master_normals_h
#define conetact_pairing_master_normals_h

#include "conetact/bodies/structure.h"

#include <map>
#include <utility>
#include <vector>

namespace conetact::pairing
{
  /** From the master to the slave: the mean of the normals of both. `outward`:
   * unit normal of the slave; `of_master`: any length. */
  Tensor<1, 3>
  normal_between(const Tensor<1, 3> &outward, const Tensor<1, 3> &of_master);

  /**
   * Normals between two surfaces that close a gap. Where they touch they become
   * one, which lies between them if both deform: of two equal bodies it is
   * their plane of symmetry, along which nothing slips while they are pressed.
   */
  class MasterNormals
  {
  public:
    explicit MasterNormals(const bodies::Surface &master);

    /** The same at a node that meets these masters. */
    Tensor<1, 3>
    between(const Tensor<1, 3>                                 &outward,
            const std::vector<std::pair<unsigned int, double>> &masters) const;

  private:
    std::map<unsigned int, std::vector<Tensor<1, 3>>> normals;
  };
} // namespace conetact::pairing

#endif

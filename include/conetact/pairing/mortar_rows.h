// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_mortar_rows_h
#define conetact_pairing_mortar_rows_h

#include "conetact/pairing/face_net.h"

#include <limits>
#include <map>
#include <set>
#include <vector>

namespace conetact::pairing
{
  /**
   * In 2D lengths are areas over the thickness of the slave; round an axis,
   * lengths times radii are areas over 2 pi.
   */
  double
  thickness_of(const bodies::Surface            &surface,
               const std::vector<FaceNet::Face> &faces,
               const bool                        axisymmetric);

  /** Integrals over the faces at a node of a slave surface, on one side of its
   * sharp edge if it has one. */
  struct MortarRow
  {
    unsigned int node = 0;
    Tensor<1, 3> normal;    ///< outward, times area [length^2]
    double       whole = 0; ///< area of the faces' shares, about [length^2]
    double       area  = 0; ///< D_j, of what is covered [length^2]
    double       size  = 0; ///< longest edge of the faces that it meets
    /** The smallest gap of points that see the master [length]. */
    double lowest = std::numeric_limits<double>::max();
    double least  = 0; ///< part of `whole` that a row must have to stand
    /** Whether its node has a function of its own: it faces the master, or too
     * few do around it. */
    bool   kept    = false;
    double covered = 0; ///< integral of its shape function [length^2]
    /** @f$\int \psi_j N_k@f$ of slave and of master nodes [length^2]. */
    std::map<unsigned int, double> slaves, masters;
    /** @f$\int \psi_j n@f$ of the outward normals of either side where its
     * faces are bent, else 0 [length^2]. */
    Tensor<1, 3>          slave_normals, master_normals;
    std::set<std::size_t> neighbours; ///< rows of the same faces
  };

  /** Integrals over their sum; what is rounding of it is left out. */
  std::vector<std::pair<unsigned int, double>>
  weights_of(const std::map<unsigned int, double> &integrals, const double sum);

  /** A mean cosine of ContactNode, which is no mean at rims that are hardly
   * covered, within bounds. */
  double
  bounded_cosine(const double mean);

  /** The rows of a slave surface. */
  class MortarRows
  {
  public:
    /** Axisymmetric: areas contain the radius. */
    MortarRows(const std::vector<FaceNet::Face> &faces,
               const double                      sharp_edge,
               const bool                        axisymmetric = false);

    /** The row of a corner of a face. */
    MortarRow &
    at(const std::size_t face, const std::size_t corner)
    {
      return rows[row_of[face][corner]];
    }
    const std::vector<MortarRow> &
    all() const
    {
      return rows;
    }

    /** Whether it is a node that contacts stand at. */
    bool
    has(const unsigned int node) const
    {
      return rows_at.count(node) > 0;
    }

    /** Faces that have integrals make their rows neighbours. */
    void
    join(const std::size_t face);
    /**
     * Where the nodes that face the master are one, or lie on a line, it could
     * turn about them: those that see most of it are kept as well.
     */
    void
    keep_upright(const bodies::Structure &body);
    /** Hanging nodes have no rows: those that they follow take theirs. */
    void
    give_up(const std::vector<bodies::HangingNode> &hanging);
    /**
     * Rows that are not kept, or that have next to no area, give what they have
     * to neighbours that stand, in shares of their areas. Where none does, what
     * is small beside its neighbours goes to these.
     */
    void
    give_up_beyond_rims();

  private:
    void
    add_row(const unsigned int node);
    void
    give(const std::size_t from, const std::size_t to, const double part);
    bool
    stands(const MortarRow &row) const;
    std::vector<std::size_t>
    takers_of(const MortarRow &row) const;
    std::vector<std::size_t>
    patch_of(const std::size_t row, std::vector<bool> &done) const;
    bool
    spans(const std::vector<std::size_t> &patch,
          const bodies::Structure        &body) const;
    std::size_t
    row_like(const MortarRow &row, const unsigned int node);

    std::vector<MortarRow>                   rows;
    std::multimap<unsigned int, std::size_t> rows_at; ///< nodes
    std::vector<std::vector<std::size_t>>    row_of;  ///< faces' corners
    bool is_space = false; ///< else faces are segments
  };
} // namespace conetact::pairing

#endif

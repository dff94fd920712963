// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/retained_unknowns.h"

#include "conetact/base/index.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;

    /** The distance of p from a point, or from the line through two. */
    double
    distance(const Point<3> &p, const std::vector<Point<3>> &from)
    {
      const Tensor<1, 3> arm = p - from[0];
      if (from.size() < 2)
        return arm.norm();
      const Tensor<1, 3> line = from[1] - from[0];
      return cross_product_3d(line / line.norm(), arm).norm();
    }
  } // namespace

  void
  RetainedUnknowns::operator()(const unsigned int body,
                               std::vector<bool> &kept) const
  {
    AssertDimension(H.cols(), own.n_unknowns());
    AssertDimension(kept.size(), at(own.end(body) - own.begin(body)));
    for (Index p = own.begin(body); p < own.end(body); ++p)
      // A column of H that is not empty: contacts see this unknown.
      if (H.outerIndexPtr()[p + 1] > H.outerIndexPtr()[p])
        kept[at(p - own.begin(body))] = true;
    for (const auto &[of, node] : bodies.nodes_to_keep)
      if (of == body)
        for (unsigned int c = 0; c < bodies.dim; ++c)
          own.for_row(coordinates.dof(body, node) + c,
                      [&](const Index unknown, double) {
                        kept[at(unknown - own.begin(body))] = true;
                      });
    if (std::count(motions.body_of_own().begin(),
                   motions.body_of_own().end(),
                   body) > 0)
      keep_anchors(body, kept);
  }

  // A body that floats keeps some nodes far apart, or digits would go with the
  // lever from its contacts to its ends; and a contact may be a single node.
  void
  RetainedUnknowns::keep_anchors(const unsigned int body,
                                 std::vector<bool> &kept) const
  {
    AssertDimension(kept.size(),
                    static_cast<std::size_t>(own.end(body) - own.begin(body)));
    const bodies::Structure &structure = *bodies.structures[body];
    std::vector<Point<3>>    chosen    = {structure.position(0)};
    for (unsigned int k = 0; k < bodies.dim; ++k)
      {
        unsigned int best     = 0;
        double       furthest = -1;
        for (unsigned int i = 0; i < structure.n_nodes(); ++i)
          {
            const auto [begin, end] = own.unknowns_of(body, i);
            const double d          = distance(structure.position(i), chosen);
            // Only nodes that no support holds have all their unknowns.
            if (end - begin >= bodies.dim && d > furthest)
              {
                furthest = d;
                best     = i;
              }
          }
        // The node furthest from any, then the one furthest from that, in space
        // the one furthest from the line through both: they span the body.
        if (k == 0) // the first one only served to find it
          chosen.clear();
        chosen.push_back(structure.position(best));
        const auto [begin, end] = own.unknowns_of(body, best);
        for (Index p = begin; p < end; ++p)
          kept[at(p - own.begin(body))] = true;
      }
  }
} // namespace conetact::contact

// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_element_reduction_h
#define conetact_contact_element_reduction_h

#include "conetact/contact/coordinates.h"

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace conetact::contact
{
  using RowMajorMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /** An element in the unknowns q: C^T k C on the unknowns it touches. */
  struct ReducedElement
  {
    std::vector<Eigen::Index> unknowns; ///< ascending
    RowMajorMatrix            matrix;
  };

  /** Takes elements from dofs to unknowns; the map must outlive it. */
  class ElementReduction
  {
  public:
    explicit ElementReduction(const LinearMap &c)
      : coordinates(c)
    {}

    void
    find_unknowns(const std::vector<unsigned int> &dofs,
                  std::vector<Eigen::Index>       &unknowns) const
    {
      unknowns.clear();
      for (const unsigned int dof : dofs)
        coordinates.for_row(dof, [&](const Eigen::Index unknown, double) {
          unknowns.push_back(unknown);
        });
      std::sort(unknowns.begin(), unknowns.end());
      unknowns.erase(std::unique(unknowns.begin(), unknowns.end()),
                     unknowns.end());
    }

    /** Entries (unknown, factor) of the rows, as a dense matrix. */
    void
    reduce(const std::vector<unsigned int> &dofs,
           const double                    *matrix,
           ReducedElement                  &element)
    {
      find_unknowns(dofs, element.unknowns);
      const auto n = static_cast<Eigen::Index>(dofs.size());
      const auto m = static_cast<Eigen::Index>(element.unknowns.size());
      map.setZero(n, m);
      for (Eigen::Index i = 0; i < n; ++i)
        coordinates.for_row(dofs[static_cast<std::size_t>(i)],
                            [&](const Eigen::Index unknown,
                                const double       factor) {
                              map(i,
                                  std::lower_bound(element.unknowns.begin(),
                                                   element.unknowns.end(),
                                                   unknown) -
                                    element.unknowns.begin()) += factor;
                            });
      // C^T k C, the element in the unknowns.
      half.noalias() = Eigen::Map<const RowMajorMatrix>(matrix, n, n) * map;
      element.matrix.noalias() = map.transpose() * half;
    }

  private:
    const LinearMap &coordinates;
    RowMajorMatrix   map, half;
  };

  /** Whether each dof of the element is one unknown of its own. */
  inline bool
  is_plain(const std::vector<unsigned int> &dofs, const LinearMap &coordinates)
  {
    return std::all_of(dofs.begin(), dofs.end(), [&](const unsigned int dof) {
      return coordinates.plain(dof) >= 0;
    });
  }
  inline void
  find_plain(const std::vector<unsigned int> &dofs,
             const LinearMap                 &coordinates,
             std::vector<Eigen::Index>       &unknowns)
  {
    unknowns.resize(dofs.size());
    for (std::size_t i = 0; i < dofs.size(); ++i)
      unknowns[i] = coordinates.plain(dofs[i]);
  }
} // namespace conetact::contact

#endif

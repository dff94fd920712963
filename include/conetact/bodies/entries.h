// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_entries_h
#define conetact_bodies_entries_h

#include "conetact/base/expression.h"
#include "conetact/bodies/structure.h"

#include <deal.II/base/parameter_handler.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace conetact::bodies
{
  /** Index of a body by name. Throws InputError that names the entry. */
  unsigned int
  find_body(const std::string              &body,
            const std::vector<std::string> &bodies,
            const std::string              &entry);

  /** Throws InputError for the first of these entries that is not empty: `why`
   * stands behind its name. */
  void
  refuse_given(const dealii::ParameterHandler &prm,
               const std::vector<std::string> &entries,
               const std::string              &in,
               const std::string              &why);

  /** The ids of an entry; each one must be a face's. Throws InputError. */
  BoundaryIds
  find_boundary(const std::string &ids,
                const Structure   &structure,
                const std::string &body,
                const std::string &entry);

  /**
   * The entry `Active`, of t only: `instead` says what else would do. Nothing
   * where it is never 0. Throws InputError that names it by what it is `in`.
   */
  std::optional<Expression>
  read_active(const dealii::ParameterHandler &prm,
              const std::string              &in,
              const std::string              &instead = "");

  /**
   * The unit vector of an entry `Turn axis`; in 2D everything turns about z.
   * Throws InputError that names the entry by what it is `in`.
   */
  Tensor<1, 3>
  turn_axis(const std::string &text,
            const unsigned int dim,
            const std::string &in);

  /**
   * n expressions of an entry, separated by ';'; a single 0 stands for all.
   * Throws InputError.
   */
  std::vector<Expression>
  parse_components(const std::string &text,
                   const std::size_t  n,
                   const std::string &entry);
} // namespace conetact::bodies

#endif

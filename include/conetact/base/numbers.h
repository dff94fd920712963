// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_numbers_h
#define conetact_base_numbers_h

#include <deal.II/base/tensor.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace conetact
{
  /**
   * A finite number, or a constant expression such as 1/80 or sqrt(2). Throws
   * InputError that names the entry.
   */
  double
  to_number(const std::string &text, const std::string &entry);

  /** A number as Fortran writes it, also 1.D0; nothing: it is none. */
  std::optional<double>
  fortran_number(std::string word);

  /** Numbers separated by commas. */
  std::vector<double>
  to_numbers(const std::string &text, const std::string &entry);

  /** `dim` numbers separated by commas, brackets allowed; z = 0 in 2D. */
  dealii::Tensor<1, 3>
  to_vector(const std::string &text,
            const unsigned int dim,
            const std::string &entry);

  /** Non-negative whole numbers separated by commas; at least one. */
  std::set<unsigned int>
  to_ids(const std::string &text, const std::string &entry);
} // namespace conetact

#endif

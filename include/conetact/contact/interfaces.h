// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_interfaces_h
#define conetact_contact_interfaces_h

#include "conetact/contact/substructure_solver.h"

namespace conetact
{
  /** The places of a part's unknowns p, those of its interface last. */
  struct InterfaceOrder
  {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic> place;
    Eigen::Index                                             n_interface = 0;
  };

  /** Where substructures meet each other and the unknowns C. */
  struct Interfaces
  {
    std::vector<InterfaceOrder> of_part;
    /** Unknowns q at interfaces, E and then C. */
    std::vector<Eigen::Index> kept;
    /** Of each unknown q: its place among them, or -1: inside a use. */
    std::vector<Eigen::Index> place;
    Eigen::Index              n_E = 0;
  };

  /**
   * The smallest interfaces that are alike in all uses of a part and leave
   * nothing else coupled: p and q are sorted into classes of those that see
   * each other in some use; a class with an unknown C, or one q that several
   * uses see, is interface.
   */
  Interfaces
  find_interfaces(const Substructures &substructures);

  /** The same matrix in another order. */
  Substructure
  sorted(const Substructure &part, const InterfaceOrder &order);

  /** Rows of a map T of part k for its interface, columns for `kept`. */
  Substructure::Map
  interface_rows(const Substructure::Map &T,
                 const Interfaces        &interfaces,
                 const std::size_t        k);
  /**
   * @f$T^{-T}@f$ inside a use of part k: T with columns, which are orthogonal,
   * divided by their squares. Rows of the interface are empty.
   */
  Substructure::Map
  inside_rows(const Substructure::Map &T,
              const Interfaces        &interfaces,
              const std::size_t        k);
} // namespace conetact

#endif

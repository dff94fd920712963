// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_units_h
#define conetact_output_units_h

#include "conetact/base/vtu_grid.h"

#include <map>
#include <string>

namespace conetact::output
{
  /** Names of the units that a scene is in. Nothing is computed with them. */
  class Units
  {
  public:
    /** None: they are not known. */
    Units() = default;
    /**
     * Of force and length, and where they are told time and temperature: "N,
     * mm, s, K". Throws InputError, which begins with `entry`.
     */
    Units(const std::string &text, const std::string &entry);

    /** Tells a picture the units of its points and fields. */
    void
    label(VtuGrid &grid) const;

  private:
    enum class Quantity
    {
      force,
      length,
      moment,
      stress
    };
    static const std::map<std::string, Quantity> &
    quantities();

    std::string                     all;
    std::map<Quantity, std::string> names;
  };
} // namespace conetact::output

#endif

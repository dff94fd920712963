// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_automatic_contacts_h
#define conetact_application_automatic_contacts_h

#include "conetact/pairing/near_sides.h"

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace conetact::application
{
  /** The name in `Contacts` that stands for all pairs that are near. */
  inline const std::string automatic_contacts = "automatic";
  /** What its errors begin with. */
  inline const std::string in_automatic = "Automatic contact, ";

  /** Declares `subsection Automatic contact`. */
  void
  declare_automatic_contact(dealii::ParameterHandler &prm);

  /** Throws InputError if the section says something although no contact is
   * found by itself. */
  void
  refuse_idle_automatic_contact(const dealii::ParameterHandler &prm);

  /** The names of two sides that meet, or are not to meet; one: it meets
   * nothing. */
  using SideNames = std::set<std::string>;

  /** What contacts with names of their own meet. */
  std::vector<SideNames>
  named_sides(dealii::ParameterHandler       &prm,
              const std::vector<std::string> &contacts);

  /**
   * All pairs of bodies, and of a body and an obstacle, that are near, but
   * those that are `named` already and those that the section excepts. Throws
   * InputError.
   */
  pairing::NearPairs
  find_near_sides(dealii::ParameterHandler                     &prm,
                  const std::vector<std::string>               &bodies,
                  const std::vector<const bodies::Structure *> &structures,
                  const std::vector<pairing::Obstacle>         &obstacles,
                  const std::vector<SideNames>                 &named);

  /** A contact as a scene would have it. */
  struct WrittenContact
  {
    std::string                               name;
    std::unique_ptr<dealii::ParameterHandler> entries; ///< of its subsection
    /** The subsection, with what is not its default. */
    std::string
    text() const;
  };

  /** Writes down what was found, with the law of the section. */
  std::vector<WrittenContact>
  write_contacts(const dealii::ParameterHandler               &prm,
                 const pairing::NearPairs                     &pairs,
                 const std::vector<std::string>               &names,
                 const std::vector<const bodies::Structure *> &structures,
                 const std::vector<pairing::Obstacle>         &obstacles);
} // namespace conetact::application

#endif

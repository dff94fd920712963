// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_body_table_h
#define conetact_bodies_body_table_h

#include "conetact/bodies/structure.h"

#include <deal.II/base/parameter_handler.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace conetact::bodies
{
  /** One row for each kind of body. */
  struct BodyRow
  {
    const char *name;
    const char *description;
    void (*declare)(dealii::ParameterHandler &);
    std::unique_ptr<Structure> (*create)(dealii::ParameterHandler    &prm,
                                         const unsigned int           dim,
                                         const std::filesystem::path &folder,
                                         const std::string           &name,
                                         const Refinements &refinements);
  };
  const std::vector<BodyRow> &
  body_table();

  /**
   * Entries of `subsection Body NAME`, of all kinds. The handler stands inside
   * the subsection.
   */
  void
  declare_body(dealii::ParameterHandler &prm);
  /**
   * The body of the parsed entries, its mesh refined further where it has one;
   * files are relative to `folder`. Throws InputError.
   */
  std::unique_ptr<Structure>
  create_body(dealii::ParameterHandler    &prm,
              const unsigned int           dim,
              const std::filesystem::path &folder,
              const std::string           &name,
              const Refinements           &refinements = {});
} // namespace conetact::bodies

#endif

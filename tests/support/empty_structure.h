// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_tests_empty_structure_h
#define conetact_tests_empty_structure_h

#include "conetact/bodies/without_elements.h"

namespace conetact::test
{
  using namespace bodies;

  /** A body without elements: what a test needs of it is overridden. */
  class EmptyStructure : public WithoutElements
  {
  public:
    const std::vector<HangingNode> &
    hanging_nodes() const override
    {
      return hanging;
    }
    std::string
    description() const override
    {
      return "nothing";
    }

    std::vector<HangingNode> hanging;
  };
} // namespace conetact::test

#endif

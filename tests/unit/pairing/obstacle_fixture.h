// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_tests_pairing_obstacle_fixture_h
#define conetact_tests_pairing_obstacle_fixture_h

#include "conetact/pairing/obstacle_table.h"

#include <string>

/** `entries`: lines "entry = value" separated by '|'. */
inline conetact::pairing::Obstacle
make_obstacle(const std::string &entries, const unsigned int dim = 2)
{
  std::string text = "set ";
  for (const char c : entries)
    text += c == '|' ? std::string("\nset ") : std::string(1, c);
  dealii::ParameterHandler prm;
  conetact::pairing::declare_obstacle(prm);
  prm.parse_input_from_string(text + "\n");
  return conetact::pairing::create_obstacle(prm, "disc", dim);
}

#endif

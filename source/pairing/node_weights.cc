// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/node_weights.h"

#include <map>

namespace conetact::pairing
{
  NodeWeights
  mean_of(const NodeWeights &first,
          const double       first_part,
          const NodeWeights &second,
          const double       second_part)
  {
    std::map<unsigned int, double> sum;
    for (const auto &[node, weight] : first)
      sum[node] += first_part * weight;
    for (const auto &[node, weight] : second)
      sum[node] += second_part * weight;
    return {sum.begin(), sum.end()};
  }

  NodeWeights
  own_side(const ContactNode &node)
  {
    NodeWeights weights;
    for_each_slave(node, [&](const unsigned int slave, const double weight) {
      weights.emplace_back(slave, weight);
    });
    return weights;
  }
} // namespace conetact::pairing

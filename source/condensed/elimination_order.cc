// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/condensed/elimination_order.h"

#include <deal.II/base/exceptions.h>

#include <metis.h>

#include <algorithm>
#include <new>
#include <numeric>
#include <utility>

namespace conetact::condensed
{
  namespace
  {
    using Numbers = std::vector<int>;

    // Consecutive numbers 0, 1, ... for the nodes of the eliminated unknowns.
    Numbers
    number_vertices(const std::vector<unsigned int> &node_of,
                    const Eigen::Index               n_eliminated)
    {
      std::vector<unsigned int> nodes(node_of.begin(),
                                      node_of.begin() + n_eliminated);
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      Numbers vertex_of(static_cast<std::size_t>(n_eliminated));
      for (std::size_t i = 0; i < vertex_of.size(); ++i)
        vertex_of[i] = static_cast<int>(
          std::lower_bound(nodes.begin(), nodes.end(), node_of[i]) -
          nodes.begin());
      return vertex_of;
    }



    // Pairs of vertices that share an entry of the matrix: the upper triangle
    // has each once, but for every pair of their unknowns. Columns of one
    // vertex follow each other, so that the vertex from which another one was
    // seen last tells these repetitions, at the cost of one number a vertex.
    // Where the unknowns of a node do not stand together, a pair may come more
    // than once.
    std::vector<std::pair<int, int>>
    coupled_vertices(const Eigen::SparseMatrix<double> &upper,
                     const Numbers                     &vertex_of,
                     const int                          n_vertices)
    {
      std::vector<std::pair<int, int>> pairs;
      Numbers                          last_seen_from(n_vertices, -1);
      const int                        n = static_cast<int>(vertex_of.size());
      for (int column = 0; column < n; ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator entry(upper, column);
             entry;
             ++entry)
          {
            const int v = vertex_of[column], w = vertex_of[entry.row()];
            if (v == w || last_seen_from[w] == v)
              continue;
            last_seen_from[w] = v;
            pairs.emplace_back(v, w);
          }
      return pairs;
    }



    // The neighbors of vertex v are neighbors[first[v]] to
    // neighbors[first[v + 1] - 1].
    struct Graph
    {
      std::vector<idx_t> first, neighbors;
    };

    /**
     * Sorts and shortens the lists of neighbours in place. Entries that are
     * kept never reach beyond the beginning of their own list, so that later
     * lists are still whole, and each first[v] is read before it is written.
     */
    void
    remove_repetitions(Graph &graph)
    {
      idx_t      kept       = 0;
      const auto n_vertices = graph.first.size() - 1;
      const auto begin      = graph.neighbors.begin();
      for (std::size_t v = 0; v < n_vertices; ++v)
        {
          const auto from = begin + graph.first[v];
          const auto to   = begin + graph.first[v + 1];
          std::sort(from, to);
          const auto end = std::unique(from, to);
          graph.first[v] = kept;
          for (auto w = from; w != end; ++w)
            graph.neighbors[kept++] = *w;
        }
      graph.first[n_vertices] = kept;
    }

    /**
     * Lists of neighbours from pairs, each of which stands in two of them.
     * Neighbours of v are counted in first[v + 1]: partial sums of these are
     * where lists begin.
     */
    Graph
    make_graph(const std::vector<std::pair<int, int>> &pairs,
               const int                               n_vertices)
    {
      Graph graph;
      graph.first.assign(n_vertices + 1, 0);
      for (const auto &pair : pairs)
        {
          ++graph.first[pair.first + 1];
          ++graph.first[pair.second + 1];
        }
      std::partial_sum(graph.first.begin(),
                       graph.first.end(),
                       graph.first.begin());

      graph.neighbors.resize(2 * pairs.size());
      std::vector<idx_t> next(graph.first);
      for (const auto &pair : pairs)
        {
          graph.neighbors[next[pair.first]++]  = pair.second;
          graph.neighbors[next[pair.second]++] = pair.first;
        }
      remove_repetitions(graph);
      return graph;
    }



    // Vertices in the order of elimination, `perm` of METIS; its inverse is not
    // needed. Weights are numbers of unknowns.
    std::vector<idx_t>
    nested_dissection(Graph graph, std::vector<idx_t> weights)
    {
      idx_t              n_vertices = static_cast<idx_t>(weights.size());
      std::vector<idx_t> order(weights.size()), places(weights.size());
      std::iota(order.begin(), order.end(), 0);
      if (graph.neighbors.empty())
        return order; // METIS wants an edge

      idx_t options[METIS_NOPTIONS];
      METIS_SetDefaultOptions(options);
      options[METIS_OPTION_COMPRESS] = 0; // one vertex a node already
      if (METIS_NodeND(&n_vertices,
                       graph.first.data(),
                       graph.neighbors.data(),
                       weights.data(),
                       options,
                       order.data(),
                       places.data()) != METIS_OK)
        throw std::bad_alloc();
      return order;
    }
  } // namespace



  std::vector<int>
  elimination_order(const Eigen::SparseMatrix<double> &upper,
                    const Eigen::Index                 n_eliminated,
                    const std::vector<unsigned int>   &node_of)
  {
    AssertDimension(upper.rows(), upper.cols());
    AssertDimension(node_of.size(), static_cast<std::size_t>(upper.cols()));
    Assert(n_eliminated <= upper.cols(),
           dealii::ExcMessage("There are no more unknowns than those."));
    Numbers places(static_cast<std::size_t>(upper.cols()));
    std::iota(places.begin(), places.end(), 0);
    if (n_eliminated == 0)
      return places;

    const Numbers vertex_of = number_vertices(node_of, n_eliminated);
    const int     n_vertices =
      1 + *std::max_element(vertex_of.begin(), vertex_of.end());
    std::vector<idx_t> n_unknowns(n_vertices, 0);
    for (const int v : vertex_of)
      // METIS balances unknowns, not nodes: supports leave some with fewer.
      ++n_unknowns[v];

    const auto pairs = coupled_vertices(upper, vertex_of, n_vertices);
    int        place = 0;
    Numbers    next_place(n_vertices);
    for (const idx_t v :
         nested_dissection(make_graph(pairs, n_vertices), n_unknowns))
      {
        next_place[v] = place;
        place += n_unknowns[v];
      }
    for (std::size_t i = 0; i < vertex_of.size(); ++i)
      places[i] = next_place[vertex_of[i]]++;
    return places;
  }
} // namespace conetact::condensed

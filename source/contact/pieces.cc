// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/pieces.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <Eigen/SVD>

#include <algorithm>
#include <map>
#include <numeric>

namespace conetact::contact
{
  /* Sets of joined nodes as trees, whose roots stand for them (union and find).
     Paths are halved as they are walked. */
  std::vector<unsigned int>
  pieces(const bodies::Structure &structure)
  {
    std::vector<unsigned int> parent(structure.n_nodes());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](unsigned int node) {
      while (parent[node] != node)
        node = parent[node] = parent[parent[node]];
      return node;
    };
    const unsigned int n_c = structure.n_components();
    structure.elements().for_each_connection(
      [&](const std::vector<unsigned int> &dofs) {
        // All nodes of an element are in one piece.
        const unsigned int first = root(dofs.front() / n_c);
        for (const unsigned int dof : dofs)
          parent[root(dof / n_c)] = first;
      });
    std::map<unsigned int, unsigned int> numbers;
    std::vector<unsigned int>            piece;
    piece.reserve(parent.size());
    for (unsigned int node = 0; node < structure.n_nodes(); ++node)
      piece.push_back(
        numbers.emplace(root(node), static_cast<unsigned int>(numbers.size()))
          .first->second);
    return piece;
  }

  unsigned int
  n_pieces(const bodies::Structure &structure)
  {
    const std::vector<unsigned int> piece = pieces(structure);
    return piece.empty() ? 0 :
                           1 + *std::max_element(piece.begin(), piece.end());
  }

  namespace
  {
    using Eigen::Index;

    /** The number of independent columns of R over all directions that are
     * given, by products row^T row. */
    Index
    rank(const Eigen::MatrixXd &products)
    {
      constexpr double least_part = 1e-12;
      if (products.size() == 0 || products.isZero(0))
        return 0;
      const Eigen::VectorXd values =
        Eigen::JacobiSVD<Eigen::MatrixXd>(products).singularValues();
      return (values.array() > least_part * values[0]).count();
    }

    /** A piece, its place and what holds it. */
    struct Piece
    {
      unsigned int    n_nodes = 0;
      Tensor<1, 3>    sum;
      Eigen::MatrixXd held, all; ///< products of rows

      Index
      n_loose() const
      {
        return rank(all) - rank(held);
      }
    };

    std::vector<Piece>
    pieces_of(const model::Bodies &bodies,
              const NodeRules     &rules,
              const RigidMotions  &motions,
              const unsigned int   body)
    {
      const bodies::Structure        &structure = *bodies.structures[body];
      const std::vector<unsigned int> number    = pieces(structure);
      std::vector<Piece>              found(
        number.empty() ? 0 :
                         1 + *std::max_element(number.begin(), number.end()));
      if (found.size() < 2)
        return {};
      const auto add = [&](Eigen::MatrixXd    &products,
                           const unsigned int  node,
                           const Tensor<1, 3> &direction) {
        const Eigen::RowVectorXd row =
          motions.row(body, structure.position(node), direction);
        if (products.size() == 0)
          products = row.transpose() * row;
        else
          products += row.transpose() * row;
      };
      for (unsigned int node = 0; node < structure.n_nodes(); ++node)
        {
          Piece &piece = found[number[node]];
          ++piece.n_nodes;
          piece.sum += structure.position(node) - Point<3>();
          for (const Tensor<1, 3> &e : complement({}, bodies.dim))
            add(piece.all, node, e);
        }
      for (const NodeRule &rule : rules.rules())
        if (rule.body == body)
          for (const HeldDirection &held : rule.held)
            add(found[number[rule.node]].held, rule.node, held.direction);
      return found;
    }

    std::string
    sentence(const std::string &body, const std::vector<Piece> &all)
    {
      constexpr std::size_t    few = 4;
      std::vector<std::string> words;
      std::size_t              n_loose = 0;
      for (const Piece &piece : all)
        if (piece.n_loose() > 0 && n_loose++ < few)
          words.push_back(std::to_string(piece.n_nodes) + " nodes around " +
                          to_text(Point<3>(piece.sum / piece.n_nodes)));
      if (n_loose > few)
        words.push_back(std::to_string(n_loose - few) + " more");
      return "Body '" + body + "' is of " + std::to_string(all.size()) +
             " pieces that are not joined, and supports hold not all of them: "
             "loose are " +
             join(words) +
             ". Make each piece a body of its own (Group in Mesh takes a group "
             "of the cells of a file), join them in the program that wrote "
             "the mesh or by Merge in Mesh, or add a Support that holds each.";
    }
  } // namespace

  /* Pieces have motions of their own where all that are not held are more than
     those of the body. */
  void
  refuse_loose_pieces(const model::Bodies &bodies,
                      const NodeRules     &rules,
                      const RigidMotions  &motions)
  {
    for (unsigned int body = 0; body < bodies.n_elastic(); ++body)
      {
        if (bodies.structures[body]->may_be_mechanism())
          continue;
        const std::vector<Piece> all = pieces_of(bodies, rules, motions, body);
        Index loose = -std::count(motions.body_of_own().begin(),
                                  motions.body_of_own().end(),
                                  body);
        for (const Piece &piece : all)
          loose += piece.n_loose();
        if (all.size() > 1 && loose > 0)
          throw InputError(sentence(bodies.names[body], all));
      }
  }
} // namespace conetact::contact

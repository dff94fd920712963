// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/mortar_rows.h"

#include "conetact/pairing/nodal_shapes.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace conetact::pairing
{
  namespace
  {
    /** A row that covers less than this part of its faces' shares leaves its
     * pressure to others, for D_j^-1 would blow up. */
    constexpr double next_to_nothing = 1e-3;
    /**
     * Rows on faces of second degree must cover more: functions of their
     * corners change their sign, so that near a rim their integrals cancel, and
     * a mean over what is left reaches far.
     */
    constexpr double next_to_cancelled = .1;
    /**
     * Where no neighbour stands, a row that does not stand goes to those that
     * have more than this many times its area: on a sliver beside them its
     * forces would be large pressures.
     */
    constexpr double much_more = 4;

    /** The area of a face; round an axis the length times the mean radius,
     * which leaves the factor 2 pi to thickness_of(). */
    double
    area_of(const FaceNet::Face &face, const bool axisymmetric)
    {
      const auto &x = face.corners;
      return face_area(x) * (axisymmetric ? .5 * (x[0][0] + x[1][0]) : 1);
    }

    using Corner = std::pair<std::size_t, std::size_t>; ///< of a face

    /** The corners of faces at each node that contacts stand at. */
    std::map<unsigned int, std::vector<Corner>>
    corners_by_node(const std::vector<FaceNet::Face> &faces)
    {
      std::map<unsigned int, std::vector<Corner>> corners;
      for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t c = 0; c < faces[f].n_functions; ++c)
          corners[faces[f].nodes[c]].emplace_back(f, c);
      return corners;
    }

    /** Numbers the sides of an edge: corners are on one where their faces turn
     * little, neighbours of neighbours with them. */
    std::vector<std::size_t>
    sides_of(const std::vector<Corner>        &corners,
             const std::vector<FaceNet::Face> &faces,
             const double                      cosine)
    {
      std::vector<std::size_t> side(corners.size());
      std::iota(side.begin(), side.end(), std::size_t{0});
      // Few faces meet in a node: all pairs are compared.
      for (std::size_t i = 0; i < side.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (faces[corners[i].first].outward *
                faces[corners[j].first].outward >=
              cosine)
            std::replace(side.begin(),
                         side.end(),
                         std::size_t(side[j]),
                         std::size_t(side[i]));
      return side;
    }
  } // namespace

  namespace
  {
    /** The length of a segment that may be bent, the integral of |dx/da| by
     * three Gauss points at .5 and .5 -+ .5 sqrt(3/5). */
    double
    length_of(const FaceNet::Face &face)
    {
      if (face.middles.empty())
        return face.size;
      const double off    = .5 * std::sqrt(.6);
      double       length = 0;
      for (const auto &[at, weight] : {std::make_pair(.5 - off, 5. / 18),
                                       std::make_pair(.5, 8. / 18),
                                       std::make_pair(.5 + off, 5. / 18)})
        {
          const auto   slope = nodal_shape_slopes(3, 2, {{at, 0}})[0];
          Tensor<1, 3> along = slope[2] * Tensor<1, 3>(face.middles[0]);
          for (std::size_t i = 0; i < 2; ++i)
            along += slope[i] * Tensor<1, 3>(face.corners[i]);
          length += weight * along.norm();
        }
      return length;
    }
  } // namespace

  double
  thickness_of(const bodies::Surface            &surface,
               const std::vector<FaceNet::Face> &faces,
               const bool                        axisymmetric)
  {
    Assert(!faces.empty(), dealii::ExcMessage("A thickness is that of faces."));
    if (axisymmetric)
      return 2 * M_PI;
    if (faces.front().corners.size() > 2)
      return 1;
    // Tributary areas of nodes contain the thickness, lengths of faces do not.
    double area = 0, length = 0;
    for (const bodies::SurfaceNode &node : surface.nodes)
      area += node.area;
    for (const FaceNet::Face &face : faces)
      length += length_of(face);
    return area / length;
  }

  std::vector<std::pair<unsigned int, double>>
  weights_of(const std::map<unsigned int, double> &integrals, const double sum)
  {
    Assert(sum > 0,
           dealii::ExcMessage("Weights are parts of a sum above zero."));
    // Biorthogonal functions leave rounding in place of zeros. As weights these
    // would join nodes that have nothing to do with each other, and fill the
    // matrices of those who use them.
    constexpr double                             rounding = 1e-13;
    std::vector<std::pair<unsigned int, double>> result;
    for (const auto &[node, integral] : integrals)
      if (std::abs(integral) > rounding * sum)
        result.emplace_back(node, integral / sum);
    return result;
  }

  double
  bounded_cosine(const double mean)
  {
    constexpr double least = .5;
    return std::clamp(mean, least, 1 / least);
  }

  /* One row for each node and each side of a sharp edge at it: faces on both
     sides of an edge have normals of their own, and would press against each
     other in one mean. */
  MortarRows::MortarRows(const std::vector<FaceNet::Face> &faces,
                         const double                      sharp_edge,
                         const bool                        axisymmetric)
    : row_of(faces.size())
    , is_space(!faces.empty() && faces.front().corners.size() > 2)
  {
    for (std::size_t f = 0; f < faces.size(); ++f)
      row_of[f].resize(faces[f].n_functions);
    // An edge of just this angle is not sharp, whatever the rounding.
    const double cosine = std::cos(sharp_edge) - 1e-12;
    for (const auto &[node, corners] : corners_by_node(faces))
      {
        const auto side = sides_of(corners, faces, cosine);
        std::map<std::size_t, std::size_t> row_of_side;
        for (std::size_t i = 0; i < corners.size(); ++i)
          {
            const auto [f, c] = corners[i];
            if (row_of_side.emplace(side[i], rows.size()).second)
              add_row(node);
            row_of[f][c]   = row_of_side[side[i]];
            MortarRow &row = at(f, c);
            // Shares of a parallelogram are near enough: they weigh normals,
            // and tell which part of a node's faces is covered.
            const std::size_t n         = faces[f].n_functions,
                              n_corners = faces[f].corners.size();
            if (n > n_corners)
              row.least = next_to_cancelled;
            const double share =
              area_of(faces[f], axisymmetric) * nodal_shares(n, n_corners)[c];
            row.whole += share;
            row.normal += share * faces[f].outward;
          }
      }
  }

  void
  MortarRows::add_row(const unsigned int node)
  {
    rows_at.emplace(node, rows.size());
    rows.emplace_back();
    rows.back().node  = node;
    rows.back().least = next_to_nothing;
  }

  /* Rows that a face connects may take each other over. */
  void
  MortarRows::join(const std::size_t face)
  {
    AssertIndexRange(face, row_of.size());
    for (const std::size_t row : row_of[face])
      for (const std::size_t other : row_of[face])
        if (row != other)
          rows[row].neighbours.insert(other);
  }

  /** All rows that faces connect with one, and itself. */
  std::vector<std::size_t>
  MortarRows::patch_of(const std::size_t row, std::vector<bool> &done) const
  {
    AssertIndexRange(row, rows.size());
    AssertDimension(done.size(), rows.size());
    std::vector<std::size_t> patch = {row};
    done[row]                      = true;
    for (std::size_t i = 0; i < patch.size(); ++i)
      for (const std::size_t other : rows[patch[i]].neighbours)
        if (!done[other])
          {
            done[other] = true;
            patch.push_back(other);
          }
    return patch;
  }

  /**
   * Tells whether the kept nodes of a patch hold it upright: two do in the
   * plane, in space three that are not on a line. About fewer it could turn,
   * and no row would see it.
   */
  bool
  MortarRows::spans(const std::vector<std::size_t> &patch,
                    const bodies::Structure        &body) const
  {
    constexpr double      off_line = .1; // of a cell
    std::vector<Point<3>> x;
    double                cell = 0;
    for (const std::size_t i : patch)
      if (rows[i].kept)
        {
          x.push_back(body.position(rows[i].node));
          cell = std::max(cell, std::sqrt(rows[i].whole));
        }
    if (x.size() < 2 || !is_space)
      return x.size() > 1;
    // The line leads from the first node to the one that is furthest from it.
    const auto far =
      std::max_element(x.begin(),
                       x.end(),
                       [&](const Point<3> &a, const Point<3> &b) {
                         return a.distance(x[0]) < b.distance(x[0]);
                       });
    const Tensor<1, 3> line = (*far - x[0]) / far->distance(x[0]);
    return std::any_of(x.begin(), x.end(), [&](const Point<3> &p) {
      return cross_product_3d(line, p - x[0]).norm() > off_line * cell;
    });
  }

  void
  MortarRows::keep_upright(const bodies::Structure &body)
  {
    // All that see about as much as the best one are kept with it: what is
    // symmetric differs by rounding and must stay symmetric.
    constexpr double  as_much = .5;
    std::vector<bool> done(rows.size(), false);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!done[i] && !rows[i].neighbours.empty())
        for (const std::vector<std::size_t> patch = patch_of(i, done);
             !spans(patch, body);)
          {
            const auto part = [&](const std::size_t r) {
              return rows[r].kept ? 0. : rows[r].covered / rows[r].whole;
            };
            double most = 0;
            for (const std::size_t r : patch)
              most = std::max(most, part(r));
            if (most == 0)
              break;
            for (const std::size_t r : patch)
              if (part(r) >= as_much * most)
                rows[r].kept = true;
          }
  }

  /**
   * Adds a part of one row's integrals to another row. Area and weights move in
   * one proportion: the weights of the taker still sum to 1, and no force is
   * lost.
   */
  void
  MortarRows::give(const std::size_t from,
                   const std::size_t to,
                   const double      part)
  {
    Assert(from != to, dealii::ExcMessage("A row cannot give to itself."));
    Assert(part >= 0 && part <= 1 + 1e-12,
           dealii::ExcMessage("A part is no more than the whole."));
    const MortarRow &giver = rows[from];
    MortarRow       &taker = rows[to];
    taker.area += part * giver.area;
    taker.size   = std::max(taker.size, giver.size);
    taker.lowest = std::min(taker.lowest, giver.lowest);
    for (const auto &[node, integral] : giver.slaves)
      taker.slaves[node] += part * integral;
    for (const auto &[node, integral] : giver.masters)
      taker.masters[node] += part * integral;
    taker.slave_normals += part * giver.slave_normals;
    taker.master_normals += part * giver.master_normals;
    // Who takes over meets the giver's faces: their rows are its neighbours
    // now.
    for (const std::size_t other : giver.neighbours)
      if (other != to)
        {
          taker.neighbours.insert(other);
          rows[other].neighbours.insert(to);
        }
  }

  /**
   * Finds the row of another node that is on the same side of an edge as this
   * row, by the smallest angle between their normals that is below a right one;
   * makes a row where there is none.
   */
  std::size_t
  MortarRows::row_like(const MortarRow &row, const unsigned int node)
  {
    std::size_t best        = rows.size();
    double      largest     = 0;
    const auto [begin, end] = rows_at.equal_range(node);
    for (auto found = begin; found != end; ++found)
      if (const Tensor<1, 3> &n = rows[found->second].normal;
          n * row.normal > largest * n.norm())
        {
          best    = found->second;
          largest = n * row.normal / n.norm();
        }
    if (best == rows.size())
      add_row(node);
    return best;
  }

  void
  MortarRows::give_up(const std::vector<bodies::HangingNode> &hanging)
  {
    std::map<unsigned int, const bodies::HangingNode *> follows;
    for (const bodies::HangingNode &node : hanging)
      follows[node.node] = &node;
    // The rows that row_like() adds behind these are those of masters.
    const std::size_t n = rows.size();
    for (std::size_t i = 0; i < n; ++i)
      if (const auto found = follows.find(rows[i].node); found != follows.end())
        {
          // Its shape function is part of those of its masters.
          for (const auto &[master, weight] : found->second->masters)
            {
              const std::size_t to = row_like(rows[i], master);
              rows[to].whole += weight * rows[i].whole;
              rows[to].normal += weight * rows[i].normal;
              give(i, to, weight);
            }
          rows[i].area = 0;
        }
  }

  /* A row keeps its own multiplier where its node faces the master and its
     functions integrate to enough: D_j^-1 is bounded then. */
  bool
  MortarRows::stands(const MortarRow &row) const
  {
    return row.kept && row.area > row.least * row.whole;
  }

  /** Finds who takes a row over: neighbours that stand, else those that are
   * much larger. The latter may have to give on what they take. */
  std::vector<std::size_t>
  MortarRows::takers_of(const MortarRow &row) const
  {
    std::vector<std::size_t> standing, larger;
    for (const std::size_t other : row.neighbours)
      {
        if (stands(rows[other]))
          standing.push_back(other);
        if (rows[other].area > much_more * std::max(row.area, 0.))
          larger.push_back(other);
      }
    return standing.empty() ? larger : standing;
  }

  /* Rows that do not stand give their functions away: with a multiplier of
     their own on a sliver they would have pressures many times too large. As
     all functions still sum to 1, a constant pressure passes as before. */
  void
  MortarRows::give_up_beyond_rims()
  {
    struct Gift
    {
      std::size_t                                 from;
      double                                      area;
      std::vector<std::pair<std::size_t, double>> takers;
    };
    // All takers are found before anything is given: what is symmetric stays
    // so.
    std::vector<Gift> gifts;
    for (std::size_t i = 0; i < rows.size(); ++i)
      // Areas of functions of second degree may be negative near a rim.
      if (rows[i].area != 0 && !stands(rows[i]))
        {
          Gift   gift{i, rows[i].area, {}};
          double sum = 0;
          for (const std::size_t to : takers_of(rows[i]))
            {
              gift.takers.emplace_back(to, rows[to].area);
              sum += rows[to].area;
            }
          for (auto &[to, share] : gift.takers)
            share /= sum;
          gifts.push_back(std::move(gift));
        }
    // The smallest first: who takes it may be small as well and then has more
    // to give on.
    std::stable_sort(gifts.begin(),
                     gifts.end(),
                     [](const Gift &a, const Gift &b) {
                       return a.area < b.area;
                     });
    for (const Gift &gift : gifts)
      {
        for (const auto &[to, share] : gift.takers)
          give(gift.from, to, share);
        if (!gift.takers.empty()) // else nobody around has more
          rows[gift.from].area = 0;
      }
  }
} // namespace conetact::pairing

// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/foot_tree.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    /** Faces that turn by more do not go into clusters: their cones would be
     * wide, and they are as few as edges are. */
    constexpr double steep_turn         = .3;
    constexpr double rounding_of_angles = 1e-6;

    /** The axis along which vectors differ most. */
    struct Range
    {
      unsigned int axis = 0;
      double       low = 0, high = 0;
    };

    template <class Iterator, class VectorOf>
    Range
    widest(const Iterator begin, const Iterator end, const VectorOf &vector_of)
    {
      Range widest;
      for (unsigned int d = 0; d < 3; ++d)
        {
          Range range{d, vector_of(*begin)[d], vector_of(*begin)[d]};
          for (auto i = begin; i != end; ++i)
            {
              const double x = vector_of(*i)[d];
              range.low      = std::min(range.low, x);
              range.high     = std::max(range.high, x);
            }
          if (d == 0 || range.high - range.low > widest.high - widest.low)
            widest = range;
        }
      return widest;
    }
  } // namespace

  FootTree::FootTree(const FaceNet &net)
    : has_lines(!net.all().empty() && net.all()[0].corners.size() == 2)
  {
    for (std::size_t f = 0; f < net.all().size(); ++f)
      if (const FaceNet::Face &face = net.all()[f];
          face.turn > steep_turn || face.is_line_in_space())
        single.push_back(f);
      else
        order.push_back(f);
    if (order.empty())
      return;
    clusters.emplace_back();
    clusters[0].end = order.size();
    split(net, 0);
  }

  void
  FootTree::measure(const FaceNet &net, Cluster &cluster) const
  {
    const double n    = static_cast<double>(cluster.end - cluster.begin);
    const auto   each = [&](const auto &visit) {
      for (std::size_t i = cluster.begin; i < cluster.end; ++i)
        visit(net.all()[order[i]]);
    };
    each([&](const FaceNet::Face &face) {
      cluster.centre += Tensor<1, 3>(face.centre) / n;
      cluster.axis += face.outward / n;
    });
    const double length = cluster.axis.norm();
    if (length > 0)
      cluster.axis /= length;
    each([&](const FaceNet::Face &face) {
      cluster.spread =
        std::max(cluster.spread, cluster.centre.distance(face.centre));
      cluster.angle =
        std::max(cluster.angle,
                 std::acos(std::clamp(cluster.axis * face.outward, -1., 1.)) +
                   rounding_of_angles);
      cluster.beside = std::max(cluster.beside, 1.1 * face.radius);
      cluster.turn   = std::max(cluster.turn, face.turn);
    });
  }

  /** Parts the faces of a cluster in two where normals differ most, or centres
   * where all look about the same way; tells where the second part begins. */
  std::size_t
  FootTree::part(const FaceNet &net, const Cluster &cluster)
  {
    constexpr double about_one_way = .5;
    const auto       begin =
      order.begin() + static_cast<std::ptrdiff_t>(cluster.begin);
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(cluster.end);
    const auto normal = [&](const std::size_t f) {
      return net.all()[f].outward;
    };
    const auto place = [&](const std::size_t f) {
      return Tensor<1, 3>(net.all()[f].centre);
    };
    const Range  of_normals = widest(begin, end, normal);
    const bool   by_normals = of_normals.high - of_normals.low > about_one_way;
    const Range  range = by_normals ? of_normals : widest(begin, end, place);
    const double half  = .5 * (range.low + range.high);
    const auto   cut =
      std::stable_partition(begin, end, [&](const std::size_t f) {
        return (by_normals ? normal(f) : place(f))[range.axis] < half;
      });
    return static_cast<std::size_t>(cut - order.begin());
  }

  void
  FootTree::split(const FaceNet &net, const std::size_t number)
  {
    constexpr std::size_t few = 8;
    measure(net, clusters[number]);
    const std::size_t begin = clusters[number].begin;
    const std::size_t end   = clusters[number].end;
    if (end - begin <= few)
      return;
    const std::size_t middle = part(net, clusters[number]);
    if (middle == begin || middle == end) // they are all in one place
      return;
    const std::size_t first = clusters.size();
    clusters[number].first  = first;
    clusters.resize(first + 2);
    clusters[first].begin     = begin;
    clusters[first].end       = middle;
    clusters[first + 1].begin = middle;
    clusters[first + 1].end   = end;
    split(net, first);
    split(net, first + 1);
  }

  /** Tells whether p may stand off a face along its normal, by bounds for all
   * faces of a cluster (FaceNet::Face::may_have_foot). */
  bool
  FootTree::may_have_foot(const Cluster &cluster, const Point<3> &p)
  {
    const Tensor<1, 3> arm      = p - cluster.centre;
    const double       distance = arm.norm();
    if (distance <= cluster.spread)
      return true;
    const double cosine = std::min(1., std::abs(arm * cluster.axis) / distance);
    // The least angle between the normal of a face, either way, and the arm
    // from its centre to p.
    const double least =
      std::acos(cosine) - cluster.angle - std::asin(cluster.spread / distance);
    const double sine = least > 0 ? std::sin(least) : 0;
    return (distance - cluster.spread) * (sine - cluster.turn) <=
           cluster.beside;
  }

  std::vector<std::size_t>
  FootTree::faces_with_foot(const FaceNet &net, const Point<3> &p) const
  {
    AssertDimension(order.size() + single.size(), net.all().size());
    std::vector<std::size_t> found, open;
    const auto               ask = [&](const std::size_t f) {
      if (net.all()[f].may_have_foot(p))
        found.push_back(f);
    };
    std::for_each(single.begin(), single.end(), ask);
    if (!clusters.empty())
      open.push_back(0);
    const bool all = has_lines && p[2] != 0; // normals of lines are all around
    while (!open.empty())
      {
        const Cluster &cluster = clusters[open.back()];
        open.pop_back();
        if (!all && !may_have_foot(cluster, p))
          continue;
        if (cluster.first == 0)
          for (std::size_t i = cluster.begin; i < cluster.end; ++i)
            ask(order[i]);
        else
          open.insert(open.end(), {cluster.first, cluster.first + 1});
      }
    // Callers break ties by the first one.
    std::sort(found.begin(), found.end());
    return found;
  }
} // namespace conetact::pairing

// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/found_nodes.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace conetact::pairing
{
  namespace
  {
    using Weights = std::vector<std::pair<unsigned int, double>>;

    [[noreturn]] void
    refuse(const std::string &what)
    {
      throw InputError("The checkpoint does not fit the scene: " + what +
                       ". Meshes, contacts and their bodies must be those of "
                       "the run that is continued.");
    }

    /** Reads numbers one by one; refuses what cannot have been written. */
    class Numbers
    {
    public:
      explicit Numbers(const std::vector<double> &v)
        : values(v)
      {}
      double
      next()
      {
        if (i == values.size() || !std::isfinite(values[i]))
          refuse("numbers of contact nodes are missing");
        return values[i++];
      }
      unsigned int
      next_below(const std::size_t limit)
      {
        const double value = next();
        if (!(value >= 0 && value < static_cast<double>(limit)) ||
            value != std::floor(value))
          refuse("contact nodes face others that do not exist");
        return static_cast<unsigned int>(value);
      }
      bool
      at_end() const
      {
        return i == values.size();
      }

    private:
      const std::vector<double> &values;
      std::size_t                i = 0;
    };

    /** One of the two sides of contact nodes, means over nodes of a body. */
    struct SideRow
    {
      const char *name;
      Weights ContactNode::*weights;
      unsigned int ContactNode::*body;
    };
    constexpr SideRow sides[] = {
      {"masters", &ContactNode::masters, &ContactNode::master},
      {"slaves", &ContactNode::slaves, &ContactNode::body}};

    /** Writes how many others each node has, then these and their weights. */
    std::vector<double>
    to_numbers(const std::vector<ContactNode> &nodes, const SideRow &side)
    {
      std::vector<double> result;
      for (const ContactNode &node : nodes)
        {
          const Weights &weights = node.*side.weights;
          result.push_back(static_cast<double>(weights.size()));
          for (const auto &[other, weight] : weights)
            {
              result.push_back(other);
              result.push_back(weight);
            }
        }
      return result;
    }

    /**
     * Reads what to_numbers() has written, and refuses numbers of nodes that
     * the bodies do not have: a file may be damaged, or that of another mesh.
     */
    void
    take(const std::vector<double>                    &values,
         const SideRow                                &side,
         const std::vector<const bodies::Structure *> &structures,
         std::vector<ContactNode>                     &nodes)
    {
      Numbers numbers(values);
      for (ContactNode &node : nodes)
        {
          const unsigned int n_nodes = structures[node.*side.body]->n_nodes();
          Weights           &weights = node.*side.weights;
          weights.clear();
          for (unsigned int n = numbers.next_below(values.size()); n > 0; --n)
            {
              const unsigned int other = numbers.next_below(n_nodes);
              weights.emplace_back(other, numbers.next());
            }
        }
      if (!numbers.at_end())
        refuse("there are weights of other contact nodes");
    }

    /** The numbers that tell nodes apart, as they are at the start. */
    std::vector<double>
    fingerprint(const std::vector<ContactNode> &nodes)
    {
      std::vector<double> numbers;
      for (const ContactNode &node : nodes)
        {
          numbers.push_back(node.contact);
          numbers.push_back(node.node);
          for (unsigned int d = 0; d < 3; ++d)
            numbers.push_back(node.position[d]);
        }
      return numbers;
    }

    struct VectorRow
    {
      const char  *name;
      Tensor<1, 3> ContactNode::*member;
    };
    constexpr VectorRow vectors[] = {{"n", &ContactNode::n},
                                     {"t1", &ContactNode::t1},
                                     {"t2", &ContactNode::t2},
                                     {"axis 1", &ContactNode::axis_1},
                                     {"axis 2", &ContactNode::axis_2},
                                     {"moved", &ContactNode::moved}};

    struct LengthRow
    {
      const char *name;
      double ContactNode::*member;
    };
    constexpr LengthRow lengths[] = {{"gap", &ContactNode::gap},
                                     {"area", &ContactNode::area}};

    using BodyPair = std::pair<unsigned int, unsigned int>;

    const std::string found_names = "found/",
                      placed      = "frames/"; // in checkpoints
    const std::string entries     = found_names + "inside";
  } // namespace

  /* What finite sliding has changed of nodes: a run that goes on must begin
     with the rows that it ended with, to the last digit, and not with those
     that a search of its own would find. */
  namespace
  {
    /** The largest change of a distance between nodes of a body, which no
     * motion of the whole makes, over the largest such distance. */
    double
    stretch(const bodies::Structure &body, const bodies::Structure &displaced)
    {
      double size = 0, change = 0;
      for (unsigned int i = 1; i < body.n_nodes(); ++i)
        {
          const double before = body.position(i).distance(body.position(0));
          const double now =
            displaced.position(i).distance(displaced.position(0));
          size   = std::max(size, before);
          change = std::max(change, std::abs(now - before));
        }
      return size > 0 ? change / size : 0;
    }
  } // namespace

  /* What is stretched to twice its length no smaller increment helps. */
  std::string
  why_not_found(const Contact                                &contact,
                const std::vector<const bodies::Structure *> &structures,
                const std::vector<const bodies::Structure *> &displaced)
  {
    const std::string in = "contact '" + contact.name + "': ";
    for (const unsigned int b : {contact.body, contact.master})
      if (const double by = stretch(*structures[b], *displaced[b]); by > 1)
        return in + "distances in one of its bodies change by " + to_text(by) +
               " of its size, and its nodes do not find their places again. "
               "Loads are far too large for bodies so soft: look at their "
               "units, and at those of Young modulus";
    return in + "bodies come so deep into each other, or bend so much, that "
                "its nodes do not find their places again. Use smaller "
                "increments";
  }

  void
  save_found(const std::vector<ContactNode> &nodes, Archive &archive)
  {
    archive.put(found_names + "nodes", fingerprint(nodes));
    for (const VectorRow &row : vectors)
      {
        std::vector<Tensor<1, 3>> values;
        for (const ContactNode &node : nodes)
          values.push_back(node.*row.member);
        archive.put(found_names + row.name, values);
      }
    for (const LengthRow &row : lengths)
      {
        std::vector<double> values;
        for (const ContactNode &node : nodes)
          values.push_back(node.*row.member);
        archive.put(found_names + row.name, values);
      }
    for (const SideRow &side : sides)
      archive.put(found_names + side.name, to_numbers(nodes, side));
  }

  void
  restore_found(const Archive                                &archive,
                const std::vector<const bodies::Structure *> &structures,
                std::vector<ContactNode>                     &nodes)
  {
    const std::vector<double> now  = fingerprint(nodes);
    std::vector<double>       then = now;
    archive.fill(found_names + "nodes", then);
    if (now != then)
      refuse("contact nodes are others, or at other places");
    for (const VectorRow &row : vectors)
      {
        std::vector<Tensor<1, 3>> values(nodes.size());
        archive.fill(found_names + row.name, values);
        for (std::size_t i = 0; i < nodes.size(); ++i)
          nodes[i].*row.member = values[i];
      }
    for (const LengthRow &row : lengths)
      {
        std::vector<double> values(nodes.size());
        archive.fill(found_names + row.name, values);
        for (std::size_t i = 0; i < nodes.size(); ++i)
          nodes[i].*row.member = values[i];
      }
    for (const SideRow &side : sides)
      take(archive.get(found_names + side.name), side, structures, nodes);
  }

  void
  save_entries(const Entries &inside, Archive &archive)
  {
    std::vector<double> numbers;
    for (const auto &[node, face] : inside)
      for (const unsigned int number : {node[0], node[1], node[2], face})
        numbers.push_back(number);
    archive.put(entries, numbers);
  }

  Entries
  restore_entries(const Archive                                &archive,
                  const std::vector<const bodies::Structure *> &structures,
                  const std::vector<ContactNode>               &nodes)
  {
    Entries                          inside;
    std::map<unsigned int, BodyPair> pairs; // of contacts
    for (const ContactNode &node : nodes)
      if (node.slides && node.obstacle == nullptr)
        pairs[node.contact] = {node.body, node.master};
    for (Numbers numbers(archive.get(entries)); !numbers.at_end();)
      {
        constexpr auto     any     = std::numeric_limits<unsigned int>::max();
        const unsigned int contact = numbers.next_below(any);
        const unsigned int body    = numbers.next_below(structures.size());
        const auto         pair    = pairs.find(contact);
        if (pair == pairs.end() ||
            (body != pair->second.first && body != pair->second.second))
          refuse("nodes are in bodies that they do not meet");
        const unsigned int other =
          body == pair->second.first ? pair->second.second : pair->second.first;
        const unsigned int node =
          numbers.next_below(structures[body]->n_nodes());
        const bodies::Structure &around = *structures[other];
        inside[{{contact, body, node}}] = numbers.next_below(
          around.surface(around.boundary_ids()).faces.size());
      }
    return inside;
  }

  void
  save_frames(const std::vector<RigidMotion> &frames, Archive &archive)
  {
    std::vector<Tensor<1, 3>> translations, rows;
    for (const RigidMotion &frame : frames)
      {
        translations.push_back(frame.translation);
        for (unsigned int d = 0; d < 3; ++d)
          rows.push_back(frame.rotation[d]);
      }
    archive.put(placed + "translations", translations);
    archive.put(placed + "rotations", rows);
  }

  /* Frames of bodies that turn far, as the last increment left them: nodes and
     unknowns of the next one are told in them. */
  void
  restore_frames(const Archive &archive, std::vector<RigidMotion> &frames)
  {
    constexpr double          rounding = 1e-9;
    std::vector<Tensor<1, 3>> translations(frames.size());
    std::vector<Tensor<1, 3>> rows(3 * frames.size());
    archive.fill(placed + "translations", translations);
    archive.fill(placed + "rotations", rows);
    for (std::size_t b = 0; b < frames.size(); ++b)
      {
        frames[b].translation = translations[b];
        for (unsigned int d = 0; d < 3; ++d)
          frames[b].rotation[d] = rows[3 * b + d];
        // Rows of a rotation are orthonormal; written with all digits they are
        // so to rounding.
        const Tensor<2, 3> one =
          frames[b].rotation * transpose(frames[b].rotation);
        if (!((one - dealii::unit_symmetric_tensor<3>()).norm() < rounding))
          refuse("a body is turned by what is no rotation");
      }
  }
} // namespace conetact::pairing

// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/obstacle_motion.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/entries.h"
#include "conetact/pairing/obstacle_entries.h"

#include <algorithm>

namespace conetact::pairing
{
  namespace
  {
    using Handler = dealii::ParameterHandler;

    const std::array<std::string, 6> component_names = {
      {"x", "y", "z", "rx", "ry", "rz"}};

    /** Functions of t only. */
    void
    check_rigid(const std::vector<Expression> &expressions,
                const std::string             &text,
                const std::string             &entry)
    {
      for (const Expression &e : expressions)
        if (e.uses_space())
          throw InputError(entry + ": '" + text +
                           "' depends on position. A rigid obstacle is moved "
                           "and loaded as a whole: use t only.");
    }

    bool
    is_zero(const std::vector<Expression> &expressions)
    {
      return std::all_of(expressions.begin(),
                         expressions.end(),
                         [](const Expression &e) { return e.is_zero(); });
    }

    void
    read_displacement(Handler           &prm,
                      const unsigned int dim,
                      const std::string &in,
                      Obstacle          &obstacle)
    {
      const std::string text = prm.get("Displacement");
      obstacle.displacement  = parse_expressions(text, in + "Displacement");
      check_rigid(obstacle.displacement, text, in + "Displacement");
      const bool still =
        obstacle.displacement.size() == 1 && obstacle.displacement[0].is_zero();
      if (still)
        obstacle.displacement.clear();
      else if (obstacle.displacement.size() != dim)
        throw InputError(in + "Displacement: '" + text + "' has " +
                         std::to_string(obstacle.displacement.size()) +
                         " expressions. Give " + std::to_string(dim) +
                         " functions of t, separated by ';', or a single 0.");
    }

    void
    read_turn(Handler           &prm,
              const unsigned int dim,
              const std::string &in,
              Obstacle          &obstacle)
    {
      obstacle.reference = point(prm, "Reference point", dim, in);
      obstacle.turn_axis = bodies::turn_axis(prm.get("Turn axis"), dim, in);
      std::vector<Expression> turn;
      turn.emplace_back(prm.get("Turn"), in + "Turn");
      check_rigid(turn, prm.get("Turn"), in + "Turn");
      if (!turn[0].is_zero())
        obstacle.turn = std::move(turn[0]);
    }

    std::array<bool, 6>
    free_components(const std::string &text,
                    const unsigned int dim,
                    const std::string &in)
    {
      std::array<bool, 6> free{};
      for (const std::string &word : split(text, ','))
        {
          const auto *const found =
            std::find(component_names.begin(), component_names.end(), word);
          const auto c =
            static_cast<std::size_t>(found - component_names.begin());
          if (c == 6 || (dim == 2 && c > 1 && c < 5))
            throw InputError(in + "Free: '" + word +
                             "' is no component of its motion. Give some of " +
                             (dim == 2 ? "x, y, rz." : "x, y, z, rx, ry, rz."));
          if (free.at(c))
            throw InputError(in + "Free: '" + word +
                             "' stands there twice. Remove one.");
          free.at(c) = true;
        }
      return free;
    }

    /** Loads that nothing lets move, and motions both free and prescribed. */
    void
    check_free(const Obstacle &obstacle, const std::string &in)
    {
      const FreeMotion &free = obstacle.free;
      if (!free.any())
        {
          for (const auto &[values, key] :
               {std::pair(&free.force, "Force"), {&free.moment, "Moment"}})
            if (!is_zero(*values))
              throw InputError(in + key +
                               ": the obstacle does not move by a load, it "
                               "is fixed or prescribed. Set Free to the "
                               "components that the load may move, or remove "
                               "it.");
          return;
        }
      if (obstacle.turn)
        throw InputError(in + "Turn: an obstacle with Free components does "
                              "not turn by an angle that is prescribed. "
                              "Remove one of both.");
      for (std::size_t c = 0; c < obstacle.displacement.size(); ++c)
        if (free.components.at(c) && !obstacle.displacement[c].is_zero())
          throw InputError(in + "Displacement: its component " +
                           component_names.at(c) +
                           " is prescribed and Free. Give 0 there, or take "
                           "it out of Free.");
    }
  } // namespace

  void
  declare_motion(Handler &prm)
  {
    const auto declare =
      [&](const char *key, const char *value, const char *text) {
        prm.declare_entry(key, value, dealii::Patterns::Anything(), text);
      };
    declare("Displacement",
            "0",
            "Translation d(t) of the obstacle since the start, a "
            "function of t each component, separated by ';'. A "
            "single 0: it stands still. [length]");
    declare("Turn",
            "0",
            "Angle by which the obstacle has turned since the start about its "
            "Reference point, a function of t. With Kinematics = small normals "
            "stay those of the undeformed nodes: turns must be small then. "
            "[degrees]");
    declare("Turn axis",
            "0, 0, 1",
            "Axis of Turn, three components; in 2D it is z.");
    declare("Reference point",
            "",
            "Turn and Moment are about this point, which Displacement moves. "
            "Empty: the origin. [length]");
    declare("Free",
            "",
            "Components of its motion that loads and contacts find: some of "
            "x, y, z, rx, ry, rz (2D: x, y, rz), separated by commas; turns "
            "are about the Reference point. Empty: all is prescribed.");
    declare("Force",
            "0",
            "Force on a free obstacle at its Reference point: a function of t "
            "for each component, separated by ';'. A single 0: no force. "
            "[force]");
    declare("Moment",
            "0",
            "Moment on a free obstacle about its Reference point: one "
            "function of t in 2D, three in 3D, separated by ';'. A single 0: "
            "no moment. [force x length]");
  }

  /* A rigid motion d(t) and an angle about a point, or free components with
     loads on them. Which of these exclude each other is checked in the end. */
  void
  read_motion(Handler           &prm,
              const unsigned int dim,
              const std::string &in,
              Obstacle          &obstacle)
  {
    read_displacement(prm, dim, in, obstacle);
    read_turn(prm, dim, in, obstacle);
    obstacle.free.components = free_components(prm.get("Free"), dim, in);
    const auto read = [&](const std::string &key, const std::size_t n) {
      std::vector<Expression> values =
        bodies::parse_components(prm.get(key), n, in + key);
      check_rigid(values, prm.get(key), in + key);
      return values;
    };
    obstacle.free.force  = read("Force", dim);
    obstacle.free.moment = read("Moment", dim == 2 ? 1 : 3);
    check_free(obstacle, in);
  }
} // namespace conetact::pairing

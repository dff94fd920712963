#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random scenes with friction that varies, layers, wear and contacts that are not always there, judged from tables.

usage: law_scenes.py [--build FOLDER] [--scenes N] [--seed N] [--keep FOLDER] [--family NAME]

A block on a floor, or on another block with a mesh of its own (both pairings), is pressed, lifted and sheared at random
by its top, by displacements or by loads against springs. `node_judge.py` computes all laws anew, and the sums of forces
and moments of each body. Runs without equilibrium are counted; increments before are judged.
"""
from judged_runs import Account, reader, table  # first: it knows the way to tests
from node_judge import Contact, Known, Text, faults
from statics import Load
from support.scenes import box, contact, floor, joint, load, support
from support.vectors import unit

TIMES = 6
TEMPERATURE = "20*t*(1 + x)"


def number(chance, low, high):
    return float(f"{chance.uniform(low, high):.3g}")


def of_place_and_way(chance):
    """A coefficient of some of x, t, T, s."""
    factors = [f"(1 + {number(chance, -.3, .3)}*x)", f"(1 + {number(chance, -.1, .2)}*t)", f"(1 - {number(chance, 0, .002)}*T)",
               f"(1 + {number(chance, -.7, 1)}*exp(-s/{number(chance, .001, .01)}))", f"if(t < {chance.randint(1, 5)}.5, 1, 0.3)",
               f"table(s; 0 : 1; {number(chance, .001, .004)} : 0.5; 0.01 : 0.8)"]
    return "*".join([f"{number(chance, .1, .6)}", *chance.sample(factors, chance.randint(1, 3))])


def of_pressure(chance):
    mu = number(chance, .2, .6)
    return chance.choice((f"min({mu}, {number(chance, 1, 6)}/max(p, 1e-9))", f"{mu}/(1 + p/{number(chance, 5, 50)})",
                          f"{mu}*(0.3 + 0.7*exp(-p/{number(chance, 20, 60)}))", f"{mu}*(1 + p/{number(chance, 5, 50)})",
                          f"table(p; 0 : {mu}; 10 : {mu * .9!r}; 50 : {mu * .6!r})"))


def of_speed(chance):
    mu, speed = number(chance, .1, .4), number(chance, .001, .01)
    return chance.choice((f"{mu}*(1 + v/(v + {speed}))", f"{mu}*(1 + 0.2*exp(-v/{speed}))", f"{mu} + {number(chance, 1, 10)}*v",
                          f"table(v; 0 : {mu}; {speed} : {mu * 1.5!r})"))


def of_speed_steeply(chance):
    """One that changes faster than bodies resist: within slips of next to nothing, or so that what slips jumps."""
    mu, speed = number(chance, .1, .5), number(chance, 1e-4, 3e-3)
    return chance.choice((f"{mu}*(0.4 + 0.6*exp(-v/{speed}))", f"{mu}*(1 - 0.6*min(v/{speed}, 1))", f"{mu}*v/(v + {speed / 30!r})",
                          f"{mu}*min(v/{speed / 30!r}, 1)", f"{mu}*(0.4 + 0.6/(1 + v/{speed}))"))


def varying(chance, dim):
    return {"Friction coefficient": of_place_and_way(chance)}


def by_pressure(chance, dim):
    return {"Friction coefficient": of_pressure(chance)}


def by_speed(chance, dim):
    return {"Friction coefficient": of_speed(chance)}


def by_speed_steeply(chance, dim):
    return {"Friction coefficient": of_speed_steeply(chance)}


def limited(chance, dim):
    limit = chance.choice((f"{number(chance, .5, 3)} + {number(chance, 0, .3)}*t", f"{number(chance, .5, 3)}*(1 + 0.3*x)",
                           f"{number(chance, .5, 3)}*(1 + exp(-s/0.003))", f"{number(chance, 1, 3)} - 0.005*T"))
    return {"Friction coefficient": chance.choice((number(chance, .2, .8), of_place_and_way(chance), of_pressure(chance))),
            "Shear limit": limit}


def elliptic(chance, dim):
    def axis():
        return chance.choice((number(chance, .05, .7), of_place_and_way(chance), of_pressure(chance), of_speed(chance)))
    law = {"Friction coefficient": axis(), "Second friction coefficient": axis(), "Friction angle": number(chance, -90, 90)}
    if chance.random() < .2:
        law["Shear limit"] = number(chance, .5, 3)
    if chance.random() < .2:
        law["Shear compliance"] = number(chance, 5e-5, 1e-3)
    return law


def wearing(chance, dim):
    k = number(chance, 1e-4, 3e-3)
    return {"Friction coefficient": chance.choice((0, number(chance, .05, .5), of_place_and_way(chance))),
            "Wear coefficient": chance.choice((k, f"{k}*(1 + 0.3*x)*(1 + exp(-s/0.003))", f"{k}*(1 + 0.01*T)/(1 + 0.1*t)",
                                               f"{k}*(1 + p/20)", f"{k}*(1 + v/(v + 0.003))")),
            "Wear share": chance.choice((0, .5, 1)), "Wear acceleration": chance.choice((1, 1, 5)),
            "Wear integration": chance.choice(("explicit", "implicit"))}


def layered(chance, dim):
    C = number(chance, 5e-5, 1e-3)
    law = {"Friction coefficient": chance.choice((0, number(chance, .1, .5), of_place_and_way(chance), of_pressure(chance)))}
    if chance.random() < .8:
        law["Compliance"] = chance.choice((C, f"{C}*(1 + 0.4*x)", f"table(p; 0 : {C}; 10 : {C * .8!r}; 40 : {C * .5!r})",
                                           f"{C}/(1 + p/100)"))
    if chance.random() < .7:
        law["Shear compliance"] = chance.choice((C, f"{2 * C!r}*(1 + 0.2*x)"))
    return law


def passing(chance, dim):
    a, b = sorted(chance.sample(range(1, TIMES), 2))
    return {"Friction coefficient": chance.choice((0, number(chance, .1, .5), of_place_and_way(chance))),
            "Active": chance.choice((f"t > {a}.5", f"(t < {a}.5) + (t > {b}.5)", f"(t > {a}.5)*(t < {b}.5)"))}


def together(chance, dim):
    """Any of these beside each other."""
    law = {**layered(chance, dim), **limited(chance, dim)}
    if chance.random() < .5:
        law.update(wearing(chance, dim))
    if chance.random() < .3:
        law["Active"] = passing(chance, dim)["Active"]
    law["Friction coefficient"] = chance.choice((of_place_and_way, of_pressure, of_speed))(chance)
    return law


FAMILIES = {"x t T s": varying, "pressure": by_pressure, "speed": by_speed, "steep in speed": by_speed_steeply, "shear limit": limited,
            "elliptic": elliptic, "wear": wearing, "layers": layered, "active": passing, "together": together}


def motion(chance, dim):
    """Displacements of the top."""
    up = [number(chance, -.012, .002) for _ in range(TIMES)]
    side = [number(chance, -.008, .008) for _ in range(TIMES)]
    across = [number(chance, -.008, .008) for _ in range(TIMES)]
    return " ; ".join(map(table, (side, up) if dim == 2 else (side, across, up)))


def resultant(of, table_of_times, point, direction, size):
    """A load of a face or a body, by its values at t = 1, 2, ..."""
    return Load(of, point, tuple(size * d for d in direction), lambda t: ([0.0] + table_of_times)[round(t)])


def top_of(body, dim, low, size, chance, scene, known):
    """What drives the block."""
    top = 3 if dim == 2 else 5
    axes = "x, y" if dim == 2 else "x, y, z"
    known.supports["top"] = body
    up = [0.0] * (dim - 1) + [1.0]
    if chance.random() < .5:
        scene["Support top"] = support(top, axes, motion(chance, dim), body)
    else:
        scene["Support top"] = support(top, axes, body=body, Stiffness=number(chance, 30, 2000))
        area = 1.0
        for length in size[:-1]:
            area *= length
        press = [number(chance, -1, 12) for _ in range(TIMES)]
        middle = tuple(a + b / 2 for a, b in zip(low, size))
        above = (*middle[:-1], low[-1] + size[-1])
        scene["Load press"] = load("pressure", table(press), top, body)
        known.loads.append(resultant(body, press, above, up, -area))
        push = [number(chance, -6, 6) for _ in range(TIMES)]
        along = unit(tuple(chance.uniform(-1, 1) for _ in range(dim - 1)) + (0.0,) * (4 - dim))[:dim]
        scene["Load push"] = load("traction", " ; ".join(f"{d!r}*{table(push)}" for d in along), top, body)
        known.loads.append(resultant(body, push, above, along, area))
    if chance.random() < .3:
        weight = [number(chance, -3, 3) for _ in range(TIMES)]
        scene["Load weight"] = load("body force", " ; ".join(["0"] * (dim - 1) + [table(weight)]), body=body)
        volume = 1.0
        for length in size:
            volume *= length
        known.loads.append(resultant(body, weight, tuple(a + b / 2 for a, b in zip(low, size)), up, volume))


def block(chance, dim, size, low, element):
    cells = (chance.randint(2, 8), chance.randint(1, 4), chance.randint(1, 3))[:dim]
    body = box(cells, size, low, poisson=chance.choice((0.0, .3)))
    body["Material"]["Expansion coefficient"] = 1e-6
    body["Element"] = element
    return body


def scene_of(chance, law_of):
    dim = 3 if law_of is elliptic else chance.choice((2, 2, 3))
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    size, low = (2.0, 1.0, 1.0)[:dim], (0.0,) * dim
    law = law_of(chance, dim)
    mu = law.pop("Friction coefficient")
    # means of a face on a coarse mesh of second degree are no places where a scene's expressions are known
    element = chance.choice(("Q1", "Q1", "Q1 B-bar", "Q1 incompatible modes"))
    scene = {"Dimension": dim, "Body block": block(chance, dim, size, low, element)}
    known = Known(dim, {}, [], {}, 1000.0, Text(TEMPERATURE))
    scene["Load heat"] = load("temperature", TEMPERATURE)
    known.contacts["bottom"] = Contact("block", entries={"Friction coefficient": mu, **law})
    if chance.random() < .5:
        tilt = chance.choice((0.0, number(chance, -.004, .004)))
        n = unit((tilt, *(0.0,) * (dim - 2), 1.0) + (0.0,) * (3 - dim))[:dim]
        scene["Obstacle floor"] = floor(dim, Normal=n)
        scene["Contact bottom"] = contact(ids=bottom, mu=mu, **law)
        known.contacts["bottom"].gap = lambda place: sum(a * b for a, b in zip(n, place))
    else:
        wide = (2.0,) + size[1:]
        scene["Body lower"] = block(chance, dim, wide, (0.0,) * (dim - 1) + (-1.0,), element)
        scene["Support ground"] = support(bottom, "x, y" if dim == 2 else "x, y, z", body="lower")
        scene["Contact bottom"] = {**joint("block", bottom, "lower", top, **{"Friction coefficient": mu}, **law),
                                   "Pairing": chance.choice(("mortar", "node to face"))}
        known.contacts["bottom"].master = "lower"
        known.supports["ground"] = "lower"
    top_of("block", dim, low, size, chance, scene, known)
    scene.update({"Solver": {"Backend": chance.choice(("condensed", "iterative"))},
                  "Time": {"End": TIMES, "Increments": TIMES}, "Output": {"VTU": 0}})
    return scene, known


def main():
    options = reader(__doc__, family={"choices": list(FAMILIES), "action": "append"}).parse_args()
    account = Account(options)
    for name in options.family or FAMILIES:
        account.family(name, lambda chance: scene_of(chance, FAMILIES[name]), faults)
    raise SystemExit(account.wrong > 0)


if __name__ == "__main__":
    main()

# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What rolls because something else turns: no-slip kinematics, statics and work in closed form.

caster: a rigid ball whose centre stays and that may turn, pressed on an elastic plate that turns about an axis
beside it; planet: an elastic disc between a fixed sun and a ring that turns.
"""
import math

from laws.sliding import FAR
from support.scenes import box, contact, joint, support
from support.tables import MOTION, Run, in_space
from support.vectors import plus

RADIUS, ARM, LOAD, MU, DEGREES = 2.0, .5, 8.0, .3, 20.0


def caster_scene(brake, increments):
    """The plate turns about the vertical axis through (-ARM, 0); a moment -brake about x acts against the rolling."""
    centre = (0, 0, RADIUS)
    return {"Dimension": 3, "Body plate": box((14, 14, 3), (2.8, 2.8, .6), (-1.4, -1.4, -.6)),
            "Support base": {"Body": "plate", "Boundary ids": 4, "Turn": f"{DEGREES}*max(t - 1, 0)", "Turn axis": (0, 0, 1),
                             "Reference point": (-ARM, 0, 0)},
            "Obstacle ball": {"Shape": "sphere", "Center": centre, "Radius": RADIUS, "Free": "z, rx, ry, rz",
                              "Reference point": centre, "Force": f"0 ; 0 ; -{LOAD}*min(t, 1)",
                              "Moment": f"-{brake!r}*min(1, max(t - 1, 0)/0.2) ; 0 ; 0"},
            "Contact top": contact("plate", 5, "ball", MU, **FAR),
            "Time": {"Stages": f"1 : 1, 2 : {increments}"}, "Output": {"VTU": 0}}


def balance_gap(run):
    """Of the whole history from t = 1 on: bodies that turn keep it increment by increment to first order only."""
    rolling = [row for row in run.increments if row["time"] > 1]
    change = rolling[-1]["strain_energy"] - run.increments[0]["strain_energy"]
    taken = sum(row["dissipation"] + row["contact_work_normal"] for row in rolling)
    return abs(sum(row["external_work"] for row in rolling) - change - taken) / rolling[-1]["strain_energy"]


def lost(run):
    return sum(row["dissipation"] for row in run.increments if row["time"] > 1)


def caster(laws):
    """No slip: the ball turns about x as fast as the plate passes below it, about z as the plate does."""
    angle = math.radians(DEGREES)
    rolls = ARM * angle / RADIUS
    for increments in (10, 20):
        run = laws.run(caster_scene(0.0, increments))
        last = run.increments[-1]
        laws.check(f"caster in {increments} increments: it rolls", abs(last["obstacle_ball_rot_x"] / rolls - 1), 2e-3)
        laws.check("  it spins with the plate", abs(last["obstacle_ball_rot_z"] / angle - 1), 2e-3)
        laws.check("  friction over normal force",
                   max(math.hypot(row["top_f_x"], row["top_f_y"]) for row in run.increments) / LOAD, .01)
        laws.check("  the load", max(abs(row["top_f_z"] / LOAD + 1) for row in run.increments), 1e-9)
        laws.check("  dissipation over that of sliding falls as increments do",
                   increments * abs(lost(run)) / (MU * LOAD * ARM * angle), .015)
        laws.check("  work, strain energy, dissipation and normal part", balance_gap(run), 5e-4)
    brake = .25 * MU * LOAD * RADIUS
    run = laws.run(caster_scene(brake, 20))
    last = run.increments[-1]
    moment = last["obstacle_ball_m_x"] + RADIUS * last["obstacle_ball_f_y"]  # about the centre
    laws.check("braked caster: friction times radius and shifted pressure are the brake", abs(moment / brake - 1), 1e-9)
    lag = rolls - last["obstacle_ball_rot_x"]
    laws.check(f"  it rolls, and lags by {lag / rolls:.2g}", abs(lag) / rolls, .015)
    laws.demand(f"  what is lost, {lost(run):.3g}, is less than brake times lag, {brake * lag:.3g}", 0 < lost(run) < brake * lag)
    laws.check("  work, strain energy, dissipation and normal part", balance_gap(run), 5e-4)


def planet_scene(sun, ring, mu, degrees, increments):
    """The disc is larger than what is between them."""
    return {"Dimension": 2,
            "Body disc": {"Mesh": {"Generator": "hyper_ball_balanced", "Arguments": "0, 0 : 1", "Global refinements": 4,
                                   "Translation": (0, (sun + ring) / 2)},
                          "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}},
            "Obstacle sun": {"Shape": "cylinder", "Point": (0, 0), "Radius": sun},
            "Obstacle ring": {"Shape": "implicit", "Function": f"{ring} - sqrt(x^2 + y^2)", "Turn": f"{degrees}*max(t - 1, 0)",
                              "Reference point": (0, 0)},
            "Contact low": contact("disc", 0, "sun", mu, **FAR), "Contact high": contact("disc", 0, "ring", mu, **FAR),
            "Time": {"Stages": f"1 : 1, 2 : {increments}"}, "Output": {"VTU": 0}}


def planet(laws):
    """No slip on the sun nor on the ring: the middle goes by ring / (sun + ring) of the ring's angle."""
    sun, ring, mu, degrees = 3.0, 4.98, .5, 40.0
    run = laws.run(planet_scene(sun, ring, mu, degrees, 40))
    rolling = [row for row in run.increments if row["time"] > 1]
    normal = [math.hypot(row["low_f_x"], row["low_f_y"]) for row in rolling]
    laws.check("planet: normal force from facet to facet", max(normal) / min(normal) - 1, .02)
    laws.check("  moments of sun and ring about their centre",
               max(abs(row["low_m_z"] + row["high_m_z"]) for row in rolling) / (mu * normal[-1] * ring), 1e-9)
    laws.check("  each over that of sliding", max(abs(row["low_m_z"]) for row in rolling) / (mu * normal[-1] * sun), .01)
    laws.check("  what is lost, over sliding all the way", abs(lost(run)) / (mu * normal[-1] * ring * math.radians(degrees)), 1e-3)
    laws.check("  work, strain energy, dissipation and normal part", balance_gap(run), 1e-3)
    last = [row for row in run.last() if row["contact"] == "low"]
    places = [plus((row["x"], row["y"], 0), in_space(row, 2, MOTION)) for row in last]
    middle = [sum(p[c] for p in places) / len(places) for c in range(2)]
    goes = degrees * ring / (sun + ring)
    laws.check("  its middle goes round", abs(math.degrees(math.atan2(-middle[0], middle[1])) / goes - 1), 2e-3)
    turns = [math.atan2(p[1] - middle[1], p[0] - middle[0]) - math.atan2(row["y"] - (sun + ring) / 2, row["x"])
             for row, p in zip(last, places)]
    turned = math.degrees(sum(t % (2 * math.pi) for t in turns) / len(turns))
    laws.check("  and it turns", abs(turned / (goes * (1 + 2 * sun / (ring - sun))) - 1), 2e-3)


def groove(laws):
    """A roller in a groove of 90 degrees under its weight W spins at the moment sqrt(2) mu W R / (1 + mu^2), or a little more
    on a facet. What is turned by more spins until its dead load turns it by no more, or has no equilibrium; feet that stay
    where they were would hold any moment."""
    radius, mu, weight, young = 10.0, .1, 100.0, 210e3
    limit = math.sqrt(2) * mu * weight * radius / (1 + mu * mu)

    def scene(part, refinements):
        foot = radius / math.sqrt(2)
        return {"Dimension": 2,
                "Body roller": {"Mesh": {"Generator": "hyper_ball", "Arguments": f"0, 0 : {radius} : false",
                                         "Global refinements": refinements, "Boundary ids": "1: y < 0 ; 2: y > 0"},
                                "Material": {"Young modulus": young, "Poisson ratio": .3}},
                "Obstacle left": {"Shape": "half space", "Normal": "1, 1", "Point": (-foot, -foot)},
                "Obstacle right": {"Shape": "half space", "Normal": "-1, 1", "Point": (foot, -foot)},
                "Contact l": contact("roller", 1, "left", mu), "Contact r": contact("roller", 1, "right", mu),
                "Load w": {"Body": "roller", "Kind": "body force", "Value": f"0 ; {-weight / (math.pi * radius**2)!r}*min(t, 1)"},
                "Load m": {"Body": "roller", "Boundary ids": 2, "Kind": "moment", "Value": f"{part * limit!r}*max(t - 1, 0)"},
                "Time": {"Times": "1, 2"}, "Output": {"VTU": 0}}
    for refinements in (4, 5):
        run = laws.run(scene(.9, refinements), bounds=False)
        laws.demand(f"groove, {refinements} refinements: nine tenths of the moment are held", run.increments[-1]["time"] == 2)
        lever = radius * math.sin(math.pi / (4 * 2**refinements))  # half a facet
        for part in (1.7, 2.5) if refinements == 4 else (1.4,):
            done, folder = laws.start(scene(part, refinements))
            last = Run(folder).increments[-1]
            held = last["time"] == 2
            laws.demand(f"  {part} of it: {'it spins to where that is less' if held else 'refused'}", done.returncode == (0 if held else 2))
            if held:
                pressed = sum((math.copysign(last[f"{c}_f_x"], 1) + last[f"{c}_f_y"]) / math.sqrt(2) for c in "lr")
                laws.check("  moment over what friction and half a facet hold",
                           abs(last["l_m_z"] + last["r_m_z"]) / (pressed * (mu * radius + lever)), 1.001)


def wall(laws):
    """A roller on a floor that a force pushes up against an elastic wall: friction on both is the same, for both turn it, but
    for what facets shift normal forces by. How far it rolls until then depends on the wall, that there is an end does not."""
    radius, weight, push = 10.0, 1000.0, 500.0
    spread = f"/{32 * radius**2 * math.sin(math.pi / 32)!r}"  # over 64 facets

    def scene(young, mu):
        return {"Dimension": 2,
                "Body roller": {"Mesh": {"Generator": "hyper_ball", "Arguments": f"0, {radius} : {radius} : false", "Global refinements": 4},
                                "Material": {"Young modulus": 1e5, "Poisson ratio": .3}},
                "Body wall": box((4, 16), (10.0, 20.0), (radius, 0.0), young=young),
                "Obstacle floor": {"Shape": "half space", "Normal": "0, 1", "Point": (0, 0)},
                "Contact under": contact("roller", 0, "floor", mu),
                "Contact beside": joint("roller", 0, "wall", 0, **{"Friction coefficient": mu}),
                "Support back": support(1, "x, y", body="wall"),
                "Load all": {"Body": "roller", "Kind": "body force",
                             "Value": f"{push}*max(t - 1, 0){spread} ; {-weight}*min(t, 1){spread}"},
                "Time": {"Times": "1, 2"}, "Output": {"VTU": 0}}
    lever = radius * math.sin(math.pi / 64)  # half a facet
    for young, mu in ((1e5, .4), (2000.0, .4), (1000.0, .4), (500.0, .6)):
        run = laws.run(scene(young, mu), bounds=False)
        last = run.increments[-1]
        laws.check(f"roller against a wall, E = {young}: forces of floor and wall",
                   max(abs(last["under_f_x"] + last["beside_f_x"] + push), abs(last["under_f_y"] + last["beside_f_y"] - weight)) / weight, 1e-9)
        laws.check("  moment of friction about the middle, over that of half a facet",
                   abs(last["beside_f_y"] + last["under_f_x"]) * radius / (lever * (last["under_f_y"] - last["beside_f_x"])), 1)


def rolling(laws):
    caster(laws)
    groove(laws)
    wall(laws)
    planet(laws)

# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shipped scenes by both backends, and by one to four processes: the same tables, or the same sentences."""
import re

from laws.processes import ITERATIVE, ours
from support.scenes import SHIPPED, box, contact, floor, joint, load, support

# what the iterative backend says of scenes that are not for it
PATH = "does not go with Solver, Method = load path, which needs the matrix"
REFUSED = {"bar-pull-release": PATH, "block-in-groove": PATH,
           "pushed-block": PATH, "pushed-block-3d": PATH, "retaining-wall": PATH}

# worth several processes, also more than there are cores: how many, and what makes meshes finer, histories shorter
SHARED = {"ball-on-plane": ((3,), ()),
          "block-press-shear": ((2, 3, 4), ("Time/Times=1, 4, 11",)),
          "floating-block": ((2, 3), ("Body block/Mesh/Arguments=140, 70 : 0, 0 : 2, 1 : true",)),
          "inclined-obstacle": ((4,), ("Body block/Mesh/Arguments=90, 90 : 0, 0 : 80, 80 : true", "Time/Times=1, 12")),
          # the wall is more than is factorised as a whole
          "sheet-pile": ((2,), ("Body left/Mesh/Arguments=80, 40 : 0, 0 : 10, 5 : true",
                                "Body right/Mesh/Arguments=80, 40 : 10, 0 : 20, 5 : true")),
          "shrink-fit": ((3,), ("Body inner/Mesh/Global refinements=5", "Body outer/Mesh/Global refinements=5")),
          "sphere-on-layer": ((2, 4), ("Time/Times=1, 4, 6",))}


def changed(*changes):
    return [word for change in ("Output/VTU=0", *changes) for word in ("-s", change)]


def sums(laws, what, a, b, bound=1e-8):
    """Forces, moments and energies of increments; moments over the largest force at the furthest node."""
    force = max(abs(row[name]) for row in a.increments for name in row if re.search("_f_[xyz]$", name))
    arm = max(abs(row[axis]) for row in a.rows for axis in "xyz")
    energy = max(abs(row["external_work"]) + abs(row["strain_energy"]) for row in a.increments)
    worst = 0.0
    for pattern, size in (("_f_[xyz]$", force), ("_m_[xyz]$", force * arm), ("energy$|work|dissipation$", energy)):
        for row, other in zip(a.increments, b.increments):
            worst = max([worst, *(abs(row[name] - other[name]) / size for name in row if re.search(pattern, name))])
    laws.check(f"{what}: sums and energies", worst if len(a.increments) == len(b.increments) else 1, bound)


def same(laws, what, a, b):
    laws.same(what, a, b, 1e-8)
    sums(laws, what, a, b)


def shipped(laws):
    """Each scene by both backends."""
    for file in sorted(SHIPPED.glob("*.prm")):
        if file.stem in REFUSED:
            done, folder = laws.start(file, *ITERATIVE)
            laws.demand(f"{file.stem}: {REFUSED[file.stem]}", done.returncode == 1 and not folder.exists()
                        and len(ours(done.stderr)) == 1 and REFUSED[file.stem] in done.stderr)
        else:
            same(laws, file.stem, *(laws.run(file, *changed(f"Solver/Backend={name}")) for name in ("condensed", "iterative")))


def shared(laws):
    """Those that are worth it by several processes."""
    for name, (numbers, changes) in SHARED.items():
        scene, arguments = SHIPPED / f"{name}.prm", changed("Solver/Backend=iterative", *changes)
        one = laws.run(scene, *arguments)
        for n in numbers:
            same(laws, f"{name}, {n} processes", one, laws.run(scene, *arguments, "--processes", str(n)))


def ways(dim, mu, push, pair=False):
    """A block that only friction holds, on a floor or on another block; pushed in its middle by so much of its weight."""
    low, high, n = (2, 3, 10) if dim == 2 else (4, 5, 5)
    sides = dim - 1
    block = {"Body block": box((n,) * dim, (1.0,) * dim),
             "Load weight": load("body force", " ; ".join(["0"] * sides + ["-min(t, 1)"])),
             "Load push": load("body force", " ; ".join([f"{push}*max(t - 1, 0)"] + ["0"] * sides)),
             "Dimension": dim, "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
    if pair:
        return {**block, "Body base": box((7,) * sides + (3,), (1.4,) * sides + (.6,), (-.2,) * sides + (-.6,)),
                "Contact joint": joint("block", low, "base", high, **{"Friction coefficient": mu}),
                "Support ground": support(low, "x, y, z"[:3 * dim - 2], body="base")}
    return {**block, "Obstacle floor": floor(dim), "Contact bottom": contact(ids=low, mu=mu)}


def refusals(laws):
    """Loads beyond what contacts carry, and motions beyond what scenes are for: the sentence and the increments before it."""
    by_two = (("condensed", ()), ("iterative", ()), ("iterative", ("--processes", "2")))
    beyond = [(f"{dim}D, {'pair' if pair else 'floor'}, {what}", ways(dim, mu, push, pair), ())
              for dim in (2, 3) for pair in (False, True) for what, mu, push in (("slides", .3, .4), ("tips", 2, 1.25))]
    beyond += [("floating-block, slides", SHIPPED / "floating-block.prm", ("Load push/Value=0.6*t",)),
               ("floating-block, lifts off", SHIPPED / "floating-block.prm", ("Load weight/Value=-0.1*t", "Load push/Value=0*t")),
               ("stacked-blocks, too far", SHIPPED / "stacked-blocks.prm",
                ("Contact joint 1/Friction coefficient=0.01", "Contact joint 1/Gap=0", "Support top/Displacement=0.4*max(t - 1, 0) ; -0.01*min(t, 1)")),
               ("sphere-on-layer, curved", SHIPPED / "sphere-on-layer.prm",
                ("Contact top/Prestress=1e-6", "Obstacle sphere/Displacement=2*t ; 0 ; -0.2*t", "Body layer/Mesh/Arguments=20, 20, 3 : -20, -20, -4 : 20, 20, 0 : true"))]
    for what, scene, changes in beyond:
        ends = [laws.start(scene, *changed(f"Solver/Backend={name}", *changes), *more)
                for name, more in by_two[:2 if isinstance(scene, dict) else 3]]
        said = {re.sub(r"node at \(.*?\)", "node", "".join(ours(done.stderr))) for done, _ in ends}  # nodes may be alike
        written = {len((folder / "increments.csv").read_text().splitlines()) for _, folder in ends}
        laws.demand(f"{what}: {'; '.join(sorted(said)).strip()}", len(said) == 1 and len(written) == 1
                    and all(done.returncode == 2 and len(ours(done.stderr)) == 1 for done, _ in ends))


def disc(radius, centre, element="Q1", refinements=2):
    return {"Mesh": {"Generator": "hyper_ball_balanced", "Arguments": f"0, 0 : {radius}", "Global refinements": refinements,
                     "Translation": centre},
            "Material": {"Young modulus": 1e4, "Poisson ratio": .3}, "Element": element}


def pyramid():
    """Two discs between walls carry a third one; some nodes are slaves of one disc and masters of another."""
    places = (("a", (.5, .5)), ("b", (1.5, .5)), ("c", (1, .5 + .75**.5)))
    friction = {"Friction coefficient": .3, "Gap": "adjust"}
    scene = {"Dimension": 2, **{f"Body {name}": disc(.5, centre, refinements=1) for name, centre in places},
             "Obstacle floor": floor(2), "Obstacle left": {"Normal": (1, 0)}, "Obstacle right": {"Normal": (-1, 0), "Point": (2, 0)}}
    for name, body, obstacle in (("al", "a", "left"), ("af", "a", "floor"), ("br", "b", "right"), ("bf", "b", "floor")):
        scene[f"Contact {name}"] = contact(body, 0, obstacle, **friction)
    for slave, master in ("ba", "ac", "bc"):
        scene[f"Contact {slave}{master}"] = {"Body": slave, "Boundary ids": 0, "Master body": master, "Master boundary ids": 0, **friction}
    return {**scene, **{f"Load w{body}": load("body force", "0 ; -t", None, body) for body in "abc"}, "Output": {"VTU": 0}}


def in_bowl():
    """Second degree on a round obstacle: pressures are means of neighbours that meet something, too."""
    return {"Dimension": 2, "Body disc": disc(1, (0, 0), "Q2"),
            "Obstacle bowl": {"Shape": "sphere", "Side": "inside", "Center": (0, .5), "Radius": 1.5},
            "Contact rim": contact("disc", 0, "bowl", .3), "Load w": load("body force", "0 ; -t", None, "disc"), "Output": {"VTU": 0}}


def blocks():
    """A block on a floor, and what becomes of it."""
    block = {"Dimension": 2, "Body block": box((4, 2), (2.0, 1.0)), "Obstacle floor": floor(2), "Contact bottom": contact(mu=.3),
             "Support top": support(3, "x, y", "0 ; -0.01"), "Output": {"VTU": 0}}
    side = {**block, "Contact bottom": {**contact(), "Kind": "bilateral"},
            "Obstacle wall": {"Normal": (1, 0)}, "Contact side": {**contact(ids=0, obstacle="wall"), "Kind": "bilateral"}}
    tie = {**block, "Contact bottom": {"Body": "block", "Boundary ids": 2, "Obstacle": "floor", "Kind": "tie"},
           "Support side": support(0, "(1, 2)"), "Support top": support(3, "x, y", "0 ; 0")}
    moved = {**block, "Obstacle floor": floor(2, Free="y", Force="0 ; 1", Displacement="0.1*t ; 0")}
    dragged = {**block, "Support side": support(2, "x", "0.01*t")}
    return {"is in several": side, "that supports hold askew": tie, "is rigid and free, and moved as well": moved,
            "no friction along what supports hold": dragged}


def condensed_at_once(laws):
    """What the iterative backend does not know is condensed from the start: a sentence says why, tables are the same."""
    for why, scene in {"does both, in two contacts": pyramid(), "knows means over nodes": in_bowl(), **blocks()}.items():
        condensed, other = (laws.run(scene, *changed(f"Solver/Backend={name}")) for name in ("condensed", "iterative"))
        laws.same(why, condensed, other, 1e-9)
        said = [line for line in (other.folder / "log.txt").read_text().splitlines() if "Backend = iterative" in line]
        laws.demand(f"  {said}", len(said) == 1 and why in said[0] and said[0].endswith(". Bodies are condensed."))


def backends(laws):
    condensed_at_once(laws)
    shipped(laws)
    refusals(laws)


def backends_shared(laws):
    shared(laws)

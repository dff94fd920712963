# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run that goes on from a checkpoint leaves the tables of one that was never interrupted."""
import random
import signal
import subprocess
import time

from laws.far_turns import bar, rolled, shell
from laws.kill import readable, rows_on_disk
from laws.sliding import FAR, disc, slab
from support.scenes import SHIPPED, box, contact, floor, joint, load, merge, press_and_shear, stack, support, write_scene
from support.tables import TEXTS, Run, read

# how a result was found, not what it is
PATH_COLUMNS = ("iterations", "residual", "equilibrium", "err1", "err2", "balance", "solver", "substeps")


def difference(whole, parts):
    """The largest one of a column of numbers over the largest number of that column, texts as they are."""
    worst = 0.0
    for name in ("reactions", "increments", "history"):
        a, b = read_table(whole, name), read_table(parts, name)
        if len(a) != len(b) or (a and a[0].keys() != b[0].keys()):
            return float("inf")
        for column in a[0] if a else ():
            if column in PATH_COLUMNS or column.startswith("balance_"):
                continue
            first, second = [row[column] for row in a], [row[column] for row in b]
            if column in TEXTS or isinstance(first[0], str):
                worst = max(worst, 0.0 if first == second else float("inf"))
                continue
            size = scale_of(column, a)
            worst = max(worst, max(apart(x, y) for x, y in zip(first, second)) / size)
    return worst


def apart(x, y):
    """Gaps to nothing are no numbers, in both runs or in none."""
    nothing = (x != x) + (y != y)
    return abs(x - y) if nothing == 0 else 0.0 if nothing == 2 else float("inf")


def read_table(folder, name):
    if name != "history":
        return read(folder / f"{name}.csv")
    lines = (folder / "history.csv").read_text().splitlines()
    rows = [dict(zip(lines[0].split(","), line.split(","))) for line in lines[1:]]
    return [{k: v if k.endswith(("_body", "_contact")) else float(v) for k, v in row.items()} for row in rows]


def scale_of(column, rows):
    """Components of a vector are compared with its largest one, works with all energies."""
    groups = (("_f_x", "_f_y", "_f_z"), ("_m_x", "_m_y", "_m_z"), ("u_n", "u_t1", "u_t2", "du_t1", "du_t2", "gap"),
              ("r_n", "r_t1", "r_t2"), ("pressure", "traction_t1", "traction_t2"),
              ("strain_energy", "external_work", "dissipation", "contact_work_normal"), ("_u_x", "_u_y", "_u_z"),
              ("_rot_x", "_rot_y", "_rot_z"))
    ends = next((group for group in groups if column.endswith(group)), (column,))
    return max([abs(row[c]) for row in rows for c in row if c.endswith(ends) and not isinstance(row[c], str) and row[c] == row[c]] + [1e-300])


def go_on(laws, scene, folder, *arguments):
    """Continues in the same folder."""
    done = laws.batch.run(scene, "--restart", folder, "-o", folder, "--quiet", *arguments)
    laws.demand(f"{scene.stem} goes on: exit code {done.returncode}: {done.stderr.strip()}", done.returncode == 0)
    return done.returncode == 0


def kinds():
    """Scenes whose states are kept in different places."""
    shear = merge(press_and_shear(2, increments=12), {"Output": {"Probes": "edge: 2, 1"}})
    foundation = merge(shear, {"Support top": {"Stiffness": "2e4"}})
    floating = {"Dimension": 2, "Body block": box((8, 4), (2.0, 1.0)), "Obstacle floor": floor(2),
                "Contact bottom": contact(mu=.3), "Load weight": load("body force", "0 ; -1"),
                "Load push": load("traction", "0.3*sin(t) ; 0", 1), "Time": {"End": 12, "Increments": 12},
                "Output": {"VTU": 0}}
    plate = merge(shear, {"Obstacle floor": {"Free": "y", "Force": "0 ; 40 + t"}, "Support top": {"Displacement": "0.0005*t ; 0"}})
    blocks = merge(stack(2, ((6, 3), (5, 3)), (1.0, .7), .4, .2), {"Time": {"End": 6, "Increments": 12}})
    tied = merge(blocks, {"Contact joint 1": {"Kind": "tie", "Friction coefficient": None}})
    space = merge(press_and_shear(3, increments=12), {"Output": {"VTU": 0}})
    return {"sheared block": shear, "on springs": foundation, "floating": floating, "pressed by a free plate": plate,
            "two blocks": blocks, "tied blocks": tied, "in space": space}


def far_kinds():
    """Scenes in which contacts are found again and bodies turn."""
    pushed = press_and_shear(2, increments=12)
    pushed["Support top"]["Displacement"] = pushed["Support top"]["Displacement"].replace("0.004", "0.21")
    pairs = {f"slab, {pairing}": slab(pushed, (26, 4), (6.5, 1.0), (-2.25, -1.0), "bottom", Pairing=pairing)
             for pairing in ("mortar", "node to face")}
    turning = merge(bar(2, 70.0, steps=10), {"Load end": load("traction", "3*t ; -2*t", 1, "bar")})
    cut_in_parts = disc(9, way=3.75, mu=.03)  # turns further than is taken at once
    cut_in_parts["Obstacle disc"]["Turn"] = "25*max(t - 1, 0)*9"
    worn = disc(10, way=1.0)
    worn["Contact top"]["Wear coefficient"] = 1e-5
    return {"swept disc": disc(10, way=1.0), "increments in parts": cut_in_parts, **pairs, "turned bar": turning,
            "rolled disc": rolled(10, way=1.0, cells=3), "turned press fit": press_fit(11), "worn": worn,
            "free roller": {"Dimension": 2, "Body layer": box((24, 3), (3.0, .6), (-1.5, -.6)),
                            "Obstacle disc": {"Shape": "cylinder", "Point": (-.8, 4.0), "Radius": 4.0, "Free": "y, rz",
                                              "Reference point": (-.8, 4.0), "Force": "0 ; -10*min(t, 1)",
                                              "Displacement": "1.6*max(t - 1, 0) ; 0"},
                            "Contact top": contact("layer", 3, "disc", .3, **FAR),
                            "Support base": support(2, "x, y", body="layer"), "Time": {"Stages": "1 : 2, 2 : 10"}, "Output": {"VTU": 0}}}


def press_fit(increments, degrees=5):
    """A shaft that turns in a hub, with friction."""
    return {"Dimension": 2, "Body shaft": shell(.5, 1.001, 32), "Body hub": shell(1.0, 2.0, 32),
            "Contact fit": joint("shaft", 1, "hub", 0, **{"Friction coefficient": .2, **FAR}),
            "Support drive": {"Body": "shaft", "Boundary ids": 0, "Turn": f"{degrees}*max(t - 1, 0)"},
            "Support frame": support(1, "x, y", body="hub"),
            "Time": {"Stages": f"1 : 1, {increments + 1} : {increments}"}, "Output": {"VTU": 0}}


def far_without_condensing():
    """The same by the iterative backend."""
    return {f"{name}, iterative": merge(scene, {"Solver": {"Backend": "iterative"}}) for name, scene in far_kinds().items()
            if name in ("swept disc", "increments in parts", "slab, mortar", "turned bar", "turned press fit")}


def same_as_in_one_go(laws):
    for name, scene in {**kinds(), **far_kinds(), **far_without_condensing()}.items():
        scene = merge(scene, {"Output": {"Checkpoint": 5}})
        whole = laws.run(scene)
        plain = laws.run(merge(scene, {"Output": {"Checkpoint": 0}}))
        laws.check(f"{name}: checkpoints change the tables by", difference(plain.folder, whole.folder), 1e-12)
        times = [row["time"] for row in whole.increments]
        file = laws.folder / f"{laws.n_runs}-short.prm"
        write_scene(merge(scene, {"Time": {"End": None, "Increments": None, "Stages": None, "Times": times[:7]}}), file)
        folder = laws.folder / f"{laws.n_runs}-parts"
        laws.batch.run(file, "-o", folder, "--quiet").check_returncode()
        full = laws.folder / f"{laws.n_runs}-full.prm"
        write_scene(scene, full)
        if go_on(laws, full, folder):
            laws.check(f"{name}: 7 increments and 5 more, difference from 12", difference(whole.folder, folder), 1e-12)


def killed_far(laws):
    """The same where contacts are found again and bodies turn, by both backends."""
    for backend in ("condensed", "iterative"):
        file = laws.folder / f"kill-far-{backend}.prm"
        write_scene(merge(press_fit(40, degrees=4), {"Solver": {"Backend": backend}, "Output": {"Checkpoint": 3}}), file)
        whole = laws.run(file)
        goes_on_after_a_kill(laws, file, whole, random.Random().randrange(4, 34))


def goes_on_after_a_kill(laws, file, whole, n):
    """Where n increments are on disk. Returns the folder; none: it did not go on."""
    folder = laws.folder / f"{file.stem}-{n}"
    process = subprocess.Popen([laws.program, file, "-o", folder, "--quiet"], cwd=laws.folder)
    while process.poll() is None and rows_on_disk(folder) < n:
        time.sleep(.001)
    process.kill()
    ended = process.wait() != -signal.SIGKILL
    laws.demand(f"{file.stem}: killed when {rows_on_disk(folder)} increments are on disk", not ended)
    if not go_on(laws, file, folder):
        return None
    readable(laws, folder, "goes on after the kill")
    laws.check("  difference from the whole run", difference(whole.folder, folder), 1e-12)
    return folder


def after_a_kill(laws):
    scene = merge(press_and_shear(3, cells=(6, 6, 6), increments=90), {
        "Output": {"VTU": 10, "Checkpoint": 4}, "Support top": {"Displacement": "0.001*max(t - 1, 0) ; 0 ; -0.01*min(t, 1)"}})
    file = laws.folder / "kill.prm"
    write_scene(scene, file)
    whole = laws.run(file)
    chance = random.Random()
    for n in sorted(chance.sample(range(5, 85), 2)):
        folder = goes_on_after_a_kill(laws, file, whole, n)
        if folder is not None:
            names = sorted(p.name for p in folder.glob("*.vtu"))
            laws.demand("  the same pictures", names == sorted(p.name for p in whole.folder.glob("*.vtu")))
            for pvd in ("scene.pvd", "solution.pvd"):
                laws.demand(f"  the same {pvd}", (folder / pvd).read_text() == (whole.folder / pvd).read_text())


def with_other_loads(laws):
    """Pressed by a support, which is taken away; then a load pulls. The same at once, by a support that is soft."""
    first = merge(press_and_shear(2, increments=4), {"Output": {"Checkpoint": 1}})
    one, folder = laws.start(first)
    laws.demand("the first part is done", one.returncode == 0)
    other = merge(first, {"Support top": None, "Load down": load("traction", "0 ; -1", 3),
                          "Time": {"End": 8, "Increments": 8}})
    file = laws.folder / "other.prm"
    write_scene(other, file)
    after = laws.folder / "after"
    done = laws.batch.run(file, "--restart", folder, "-o", after, "--quiet")
    laws.demand(f"other supports and loads: exit code {done.returncode} {done.stderr.strip()}", done.returncode == 0)
    if done.returncode != 0:
        return
    run = Run(after)
    laws.demand("all increments are in the tables", [row["increment"] for row in run.increments] == list(range(1, 9)))
    last = run.increments[-1]
    laws.check("the floor carries the load alone", abs(last["bottom_f_y"] - 2.0) / 2.0, 1e-10)
    laws.demand("columns of the support that is gone are left out", "support_top_f_x" not in last)
    laws.demand("those of the load are new", last["load_down_f_y"] != 0 and run.increments[0]["load_down_f_y"] == 0)
    energy = [row["strain_energy"] for row in run.increments]
    work, size = 0.0, max(energy)
    for before, row in zip([0.0, *energy], run.increments):
        work = max(work, abs(row["external_work"] - (row["strain_energy"] - before) - row["dissipation"]
                             - row["contact_work_normal"]))
    laws.check("energies balance across the change", work / size, 1e-9)


def with_a_support_let_go(laws):
    """A support that holds nodes of the contact is taken away, or comes: as by its Active in one run."""
    for dim in (2, 3):
        for active, before, after in (("t < 1.5", True, False), ("t > 1.5", False, True)):
            bottom, top = (2, 3) if dim == 2 else (4, 5)
            axes = ", ".join("xyz"[:dim])
            scene = {"Dimension": dim, "Body block": box((4,) + (2,) * (dim - 1), (2.0,) + (1.0,) * (dim - 1)), "Obstacle floor": floor(dim),
                     "Contact bottom": contact(ids=bottom, mu=.3), "Support side": support(0, axes), "Support top": support(top, axes, Stiffness=100),
                     "Load press": load("pressure", "5*t", top), "Time": {"Times": "1, 2, 3"}, "Output": {"VTU": 0}}
            whole = laws.run(merge(scene, {"Support side": {"Active": active}}))
            parts = [scene if here else merge(scene, {"Support side": None}) for here in (before, after)]
            one, folder = laws.start(merge(parts[0], {"Output": {"Checkpoint": 1}, "Time": {"Times": "1"}}))
            laws.demand(f"{dim}D, {active}: the first part is done", one.returncode == 0)
            file = laws.folder / f"let-go-{dim}-{after}.prm"
            write_scene(parts[1], file)
            if go_on(laws, file, folder):
                run = Run(folder)
                laws.same(f"{dim}D, side with Active = {active}: in two parts", whole, run)


def by_the_other_backend(laws):
    """A state is that of either backend."""
    far = far_kinds()
    for name, scene in {**kinds(), **{name: far[name] for name in ("slab, mortar", "swept disc", "turned bar")}}.items():
        whole = laws.run(scene)
        for first, then in (("condensed", "iterative"), ("iterative", "condensed")):
            file = laws.folder / f"{laws.n_runs}-{first}.prm"
            folder = laws.folder / f"{laws.n_runs}-{then}"
            write_scene(merge(scene, {"Solver": {"Backend": first}, "Output": {"Checkpoint": 1},
                                      "Time": {"End": None, "Increments": None, "Stages": None,
                                               "Times": [row["time"] for row in whole.increments[:7]]}}), file)
            laws.batch.run(file, "-o", folder, "--quiet").check_returncode()
            write_scene(merge(scene, {"Solver": {"Backend": then}}), file)
            if go_on(laws, file, folder):
                laws.check(f"{name}: {first}, then {then}, difference", difference(whole.folder, folder), 1e-8)


def restart(laws):
    same_as_in_one_go(laws)
    after_a_failure(laws)
    after_a_kill(laws)
    killed_far(laws)
    with_other_loads(laws)
    with_a_support_let_go(laws)
    by_the_other_backend(laws)
    refusals(laws)


def after_a_failure(laws):
    """A block slides off a slab: the checkpoint is that of the last increment on disk, whatever was tried after it."""
    scene = merge(far_kinds()["slab, mortar"], {"Output": {"Checkpoint": 5}})
    scene["Support top"] = {**scene["Support top"], "Directions": "y", "Displacement": "-0.01*min(t, 1)"}
    scene["Load push"] = load("traction", "0.3*max(t - 1, 0) ; 0", 3)
    done, folder = laws.start(scene)
    laws.demand(f"pushed until it slides ({done.returncode}): {done.stderr.strip()[:100]}", done.returncode == 2)
    n = rows_on_disk(folder)
    laws.demand(f"{n} increments are on disk, more than at the last regular checkpoint", n % 5 != 0 and n > 0)
    gentle = merge(scene, {"Load push": {"Value": f"0.3*max(min(t, {n + .2!r}) - 1, 0) ; 0"}})
    whole = laws.run(gentle)
    file = laws.folder / "gentle.prm"
    write_scene(gentle, file)
    if go_on(laws, file, folder):
        laws.check("difference from a run without the failure", difference(whole.folder, folder), 1e-12)


def refusals(laws):
    """What cannot be continued is refused with a sentence, and the old results stay."""
    scene = merge(press_and_shear(2), {"Output": {"Checkpoint": 2}})
    folder = laws.run(scene).folder
    before = {p.name: p.read_bytes() for p in folder.iterdir()}
    path = SHIPPED / "pushed-block.prm"
    cases = (
        ("nothing left to do", scene, (), "has no increment after that"),
        ("another body", merge(scene, {"Body block": {"Material": {"Young modulus": 5.0}}, "Time": {"End": 9}}), (),
         "Body block/Material/Young modulus was '1000.0'"),
        ("other friction", merge(scene, {"Contact bottom": {"Friction coefficient": .9}, "Time": {"End": 9}}), (),
         "Contact bottom/Friction coefficient was '0.3'"),
        ("another body in the list", merge(scene, {"Body two": box((2, 2), (1.0, 1.0), (9.0, 9.0))}), (), "Bodies was"),
        ("a load path", path, (), "a load path cannot be continued"),
        ("an adaptive scene", merge(scene, {"Adaptive refinement": 1, "Output": {"Checkpoint": 0}}), (),
         "Adaptive refinement cannot be continued"))
    for what, tree, more, sentence in cases:
        done, result = laws.start(tree, "--restart", folder, *more)
        laws.demand(f"{what}: exit code {done.returncode}: {done.stderr.strip()}",
                    done.returncode == 1 and sentence in done.stderr and not result.exists())
    spelled = merge(scene, {"Body block": {"Material": {"Young modulus": "1e3", "Poisson ratio": ".30"}}, "Time": {"End": 9}})
    done, _ = laws.start(spelled, "--restart", folder)
    laws.demand(f"the same numbers in another spelling: {done.stderr.strip()}", done.returncode == 0)
    checkpoint = folder / "checkpoint.bin"
    longer = merge(scene, {"Time": {"End": 9, "Increments": 9}})
    for what, content in (("half a checkpoint", before["checkpoint.bin"][:1000]), ("an empty one", b""),
                          ("a picture", b"<VTKFile/>\n")):
        checkpoint.write_bytes(content)
        done, result = laws.start(longer, "--restart", folder)
        laws.demand(f"{what}: exit code {done.returncode}: {done.stderr.strip()}",
                    done.returncode == 1 and "is not a whole checkpoint" in done.stderr and not result.exists())
    checkpoint.write_bytes(before["checkpoint.bin"])
    (folder / "increments.csv").write_text("increment\n1\n")
    done, result = laws.start(longer, "--restart", folder)
    laws.demand(f"a table that lacks rows: exit code {done.returncode}: {done.stderr.strip()}",
                done.returncode == 1 and "does not hold the increments 1 to 4" in done.stderr and not result.exists())
    (folder / "increments.csv").write_bytes(before["increments.csv"])
    laws.demand("the old results are as they were", before == {p.name: p.read_bytes() for p in folder.iterdir()})

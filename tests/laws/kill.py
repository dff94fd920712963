# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is on disk is whole, whenever and however a run ends."""
import csv
import resource
import signal
import subprocess
import time
import xml.etree.ElementTree
from pathlib import Path

from support.scenes import merge, press_and_shear, pushed_block, write_scene

TOGETHER = 16  # increments that a small scene finishes together


def root_of(file):
    """Of a file of VTK, which is XML up to the arrays behind it."""
    text, arrays, behind = file.read_bytes().partition(b'<AppendedData encoding="raw">')
    if arrays and not behind.endswith(b"</AppendedData>\n</VTKFile>\n"):
        raise xml.etree.ElementTree.ParseError("it ends within its arrays")
    return xml.etree.ElementTree.fromstring(text + b"</VTKFile>" if arrays else text)


def readable(laws, folder, what, quiet=False, killed=False):
    """Every table and picture on disk is whole, but for the last row where the program was killed."""
    faults = []
    tables = {}
    for name in ("increments.csv", "reactions.csv", "events.csv"):
        file = folder / name
        if not file.exists():
            continue
        content = file.read_text()
        if killed:
            content = content[:content.rfind("\n") + 1]
        if content and not content.endswith("\n"):
            faults.append(f"{name} ends within a line")
        rows = list(csv.reader(content.splitlines()))
        if any(len(row) != len(rows[0]) for row in rows):
            faults.append(f"{name} has incomplete rows")
        tables[name] = [row[0] for row in rows[1:]]
    written = tables.get("increments.csv", [])
    if written != [str(k + 1) for k in range(len(written))]:
        faults.append("increments have holes")
    seen = tables.get("reactions.csv", [])
    counts = [seen.count(k) for k in dict.fromkeys(seen)]
    if list(dict.fromkeys(seen)) != [str(k + 1) for k in range(len(counts))] or len(set(counts)) > 1:
        faults.append("reactions have holes")
    if abs(len(counts) - len(written)) > TOGETHER:  # a kill between the two
        faults.append(f"{len(counts)} increments of reactions, {len(written)} of resultants")
    pictures = 0
    for file in folder.glob("*.*"):
        if file.suffix in (".vtu", ".pvd"):
            try:
                root = root_of(file)
            except xml.etree.ElementTree.ParseError as error:
                faults.append(f"{file.name}: {error}")
                continue
            pictures += file.suffix == ".vtu"
            missing = [d.get("file") for d in root.iter("DataSet") if not (folder / d.get("file")).exists()]
            if missing:
                faults.append(f"{file.name} names {missing[0]}, which is not there")
    if not quiet or faults:
        laws.demand(f"{what}: {len(written)} increments, {pictures} pictures"
                    + "".join("; " + fault for fault in faults), not faults)
    return len(written)


def rows_on_disk(folder):
    """Finished increments in the table, 0 before there is one."""
    try:
        return max(0, (folder / "increments.csv").read_text().count("\n") - 1)
    except FileNotFoundError:
        return 0


def kill_at(laws, file, n, name):
    """Kills the program as soon as n increments are on disk; how many there are then, None if it ended before."""
    folder = laws.folder / name
    process = subprocess.Popen([laws.program, file, "-o", folder, "--quiet"], cwd=laws.folder)
    while process.poll() is None and rows_on_disk(folder) < n:
        time.sleep(.001)
    process.kill()
    if process.wait() != -signal.SIGKILL:
        return None
    return readable(laws, folder, f"killed at increment {n}", quiet=True, killed=True) if folder.exists() else 0


def kill(laws):
    scene = merge(press_and_shear(3, cells=(7, 7, 7), increments=120), {"Output": {"VTU": 1}})
    scene["Support top"]["Displacement"] = "0.001*max(t - 1, 0) ; 0 ; -0.01*min(t, 1)"
    file = laws.folder / "kill.prm"
    write_scene(scene, file)
    for n in (0, 1, 2, TOGETHER + 1, 40, 70):
        found = kill_at(laws, file, n, f"kill-{n}")
        laws.demand(f"kill -9 when {n} increments are on disk: {found}", found is not None and n <= found < 120)

    path = laws.folder / "kill-path.prm"
    write_scene(merge(pushed_block(2, .6, .5, cells=(80, 40)), {"Output": {"VTU": 1}}), path)
    whole = len(laws.run(path).increments)
    for n in (0, 1, 2, whole // 2):
        found = kill_at(laws, path, n, f"kill-path-{n}")
        laws.demand(f"kill -9 when {n} of {whole} points of a load path are on disk: {found}",
                    found is not None and n <= found < whole)

    def limit(size):
        def set_limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        return set_limit
    for size in (100, 2000, 30000, 100000):
        done, folder = laws.start(file, preexec_fn=limit(size))
        laws.demand(f"files up to {size} bytes: exit code {done.returncode}: {done.stderr.strip()}",
                    done.returncode == 3 and done.stderr.count("\n") == 1)
        readable(laws, folder, f"files up to {size} bytes")
        laws.demand("nothing half written is left", not list(folder.glob("*.tmp")))

    full_disk(laws, file)

    in_the_way = laws.folder / "file"
    in_the_way.write_text("")
    for folder in (in_the_way, in_the_way / "sub", Path("/proc/conetact")):
        done = subprocess.run([laws.program, file, "-o", folder, "--quiet"], cwd=laws.folder, capture_output=True,
                              text=True)
        laws.demand(f"-o {folder.name}: exit code {done.returncode}: {done.stderr.strip()}",
                    done.returncode == 3 and done.stderr.count("\n") == 1)


def full_disk(laws, file):
    """Links of others in the folder, and where one can be mounted a small disk that fills up."""
    linked = laws.folder / "linked"
    linked.mkdir()
    for table in ("reactions.csv", "increments.csv"):
        (linked / f"{table}.tmp").symlink_to("/dev/full")
    done = subprocess.run([laws.program, file, "-o", linked, "--quiet"], cwd=laws.folder, capture_output=True, text=True)
    laws.demand(f"links under temporary names are not followed: exit code {done.returncode}: {done.stderr.strip()}",
                done.returncode == 0 and readable(laws, linked, "links") > 0)
    disk, copy = laws.folder / "disk", laws.folder / "copy"
    disk.mkdir()
    command = 'mount -t tmpfs -o size=512k tmpfs "$1" || exit 77; "$2" "$3" -o "$1/result" --quiet; e=$?; ' \
              'mkdir "$4"; cp "$1"/result/* "$4"; exit $e'
    done = subprocess.run(["unshare", "-rm", "sh", "-c", command, "sh", disk, laws.program, file, copy],
                          capture_output=True, text=True)
    if done.returncode == 77 or "unshare" in done.stderr:
        print(f"  SKIPPED: no small disk can be mounted here: {done.stderr.strip()}")
        return
    laws.demand(f"full disk: exit code {done.returncode}: {done.stderr.strip()}", done.returncode == 3)
    laws.demand("full disk: some increments", readable(laws, copy, "full disk") > 0)

# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What log.txt says of a run, and what a dry run says before."""
import math
import re

from support.scenes import write_scene

# what a dry run estimates: its sentence, and that of the log
ESTIMATES = {"factor": (r"factor of (\S+) MB, ", r"factor of (\S+) MB"),
             "condensed stiffness": (r"condensed stiffness of (\S+) MB", r"condensed stiffness: (\S+) MB"),
             "memory": (r"memory of (\S+) MB", r"memory: (\S+) MB")}


def log_of(run):
    return (run.folder / "log.txt").read_text()


def work_of(run):
    """Counts of the last line of a log by what they count."""
    last = log_of(run).splitlines()[-1]
    if not last.startswith("work: "):
        raise RuntimeError(f"the log does not end with its work but with: {last}")
    return {what: int(count) for count, what in re.findall(r"(\d+) ([^,]+)", last)}


def demand_work(laws, name, run, expected):
    found = work_of(run)
    differ = {what: found.get(what) for what, count in expected.items() if found.get(what) != count}
    laws.demand(f"{name}: " + ", ".join(f"{count} {what}" for what, count in expected.items())
                + (f"; found {differ}" if differ else ""), not differ)


def dry_run(laws, scene, *arguments):
    """What is printed."""
    file = laws.folder / "dry.prm"
    write_scene(scene, file)
    done = laws.batch.run(file, "--dry-run", *arguments)
    done.check_returncode()
    return done.stdout


def check_estimates(laws, name, text, run, *kinds):
    """Estimates of a dry run against what the run took."""
    for what in kinds:
        told, found = ESTIMATES[what]
        check_ratio(laws, f"{name}: {what}", re.search(told, text)[1], re.search(found, log_of(run))[1])


def check_ratio(laws, what, estimate, found):
    ratio = float(estimate) / float(found)
    laws.check(f"{what} over that of the run, {ratio:.3g}", abs(math.log(ratio)), math.log(1.5))

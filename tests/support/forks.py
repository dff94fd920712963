# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program many times over, without starting it each time (forks.cc)."""
import os
import subprocess
from pathlib import Path


class Forks:
    def __init__(self, driver):
        self.process = subprocess.Popen([driver], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})

    def run(self, folder, *arguments):
        """Exit code, or minus the signal that ended the run (-14: it took 20 s); what it printed."""
        self.process.stdin.write("\t".join(map(str, (folder, *arguments))) + "\n")
        self.process.stdin.flush()
        code = int(self.process.stdout.readline())
        return code, *((Path(folder) / name).read_text(errors="replace") for name in ("stdout", "stderr"))

    def close(self):
        self.process.stdin.close()
        self.process.wait()

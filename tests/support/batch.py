# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program many times over, without starting it each time: runs are lines for `conetact --batch -`."""
import os
import re
import select
import shlex
import subprocess
import tempfile
import threading
from pathlib import Path


class Batch:
    """Runs one after the other; `options` are those of the process, such as its working folder."""

    def __init__(self, program, **options):
        # as the program would have it in a second start
        options["env"] = {"LD_BIND_NOW": "1", **options.get("env", os.environ)}
        self.program, self.options, self.process = program, options, None
        self.files = tempfile.TemporaryDirectory(prefix="conetact-batch-")
        self.out, self.err = (Path(self.files.name) / name for name in ("out", "err"))

    def run(self, *arguments, timeout=None):
        """As subprocess.run: with exit code and texts, or TimeoutExpired."""
        if self.process is None:
            self.process = subprocess.Popen([self.program, "--batch", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                            text=True, errors="replace", **self.options)
            self.process.stdout.readline()  # heads of columns
        words = [str(word) for word in arguments]
        self.process.stdin.write(f"{shlex.join(words)} > {self.out} 2> {self.err}\n")
        self.process.stdin.flush()
        if not select.select([self.process.stdout], [], [], timeout)[0]:
            self.process.terminate()
            self.close()
            raise subprocess.TimeoutExpired(words, timeout)
        row = self.process.stdout.readline()
        code = re.match(r" *\d+ +(\d+)  ", row)
        if not code:
            raise RuntimeError(f"the batch has ended within {words}: '{row}', exit code {self.process.poll()}")
        code = int(code[1])
        return subprocess.CompletedProcess(words, 128 - code if code > 128 else code,
                                           *(file.read_text(errors="replace") for file in (self.out, self.err)))

    def close(self):
        if self.process is not None:
            self.process.stdin.close()
            self.process.stdout.close()
            self.process.wait()
            self.process = None


THREAD = threading.local()


def of_thread(program, **options):
    """The batch of a program that this thread alone uses."""
    batches = THREAD.__dict__.setdefault("batches", {})
    if program not in batches:
        batches[program] = Batch(program, **options)
    return batches[program]

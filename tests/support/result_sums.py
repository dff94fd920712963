# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results of the Python package with what checks sum up of them."""


class Tables:
    """A result, and rows and columns of it at a time, the last one if none is given."""

    def __init__(self, result):
        self.result, self.increments, self.all = result, result.increments, result.reactions

    def _at(self, time):
        times = self.increments["time"]
        return -1 if time is None else abs(times - time).argmin()

    def rows(self, contact, time=None):
        increment = self.increments["increment"][self._at(time)]
        return self.all[(self.all["contact"] == contact) & (self.all["increment"] == increment)]

    def value(self, column, time=None):
        return self.increments[column][self._at(time)]

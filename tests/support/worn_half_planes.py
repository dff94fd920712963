# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fretting wear of two half planes of the same material by boundary elements, apart from the program.

Pressure and friction are constant in strips; displacements of the surface follow from the logarithm of Flamant and
Boussinesq (K. L. Johnson, Contact Mechanics, 1985, 2.2 and 2.3), which friction and pressure share without seeing each
other where both materials are the same. Contact and Coulomb's law are solved by active sets, wear is Archard's, taken
at the pressure before it.
"""
import numpy as np


class HalfPlanes:
    """`modulus` is E*, E/(2 (1 - nu^2)) of equal materials; the gap is x^2/(2 R) and what has worn."""

    def __init__(self, modulus, radius, mu, half_width, strips):
        edges = np.linspace(-half_width, half_width, strips + 1)
        self.x, self.width = (edges[1:] + edges[:-1]) / 2, edges[1] - edges[0]
        a, b = self.x[:, None] - edges[None, :-1], self.x[:, None] - edges[None, 1:]

        def primitive(x):
            return x * np.log(np.abs(x)) - x
        self.modulus = modulus
        self.kernel = -2 / (np.pi * modulus) * (primitive(a) - primitive(b))
        self.gap, self.mu = self.x**2 / (2 * radius), mu
        self.p, self.q, self.worn = (np.zeros(strips) for _ in range(3))
        self.stretched = np.zeros(strips)  # by friction so far
        self.moved = 0.0
        self.soft_n = self.soft_t = 0.0  # of all that is behind the half planes [length/force]

    def press(self, closing):
        """Pressures where the far ends come that near: p >= 0, gap >= 0."""
        on = self.p > 0 if self.p.any() else self.gap < closing
        for _ in range(200):
            K = self.kernel + self.soft_n * self.width
            p = np.zeros_like(self.p)
            free = np.flatnonzero(on)
            p[free] = np.linalg.solve(K[np.ix_(free, free)], (closing - self.gap - self.worn)[free])
            gap = self.gap + self.worn + K @ p - closing
            new = np.where(on, p > 0, gap < -1e-14)
            if (new == on).all():
                self.p = p
                return
            on = new
        raise RuntimeError("pressures do not settle")

    def shear(self, move):
        """Friction where the far ends are displaced that far; the slip of each strip."""
        K = self.kernel + self.soft_t * self.width
        limit, step = self.mu * self.p, move - self.moved
        state = np.where(self.p > 0, 0, 2)  # 0 sticks, +1 and -1 slips that way, 2 carries nothing
        state[(state == 0) & (np.abs(self.q) > limit)] = np.sign(self.q[(state == 0) & (np.abs(self.q) > limit)])
        for _ in range(500):
            q = np.where(np.abs(state) == 1, state * limit, 0.0)
            stuck = np.flatnonzero(state == 0)
            if len(stuck):
                right = (step + self.stretched - K @ q)[stuck]
                q[stuck] = np.linalg.solve(K[np.ix_(stuck, stuck)], right)
            slip = step - (K @ q - self.stretched)
            new = state.copy()
            new[(state == 0) & (q > limit * (1 + 1e-12))] = 1
            new[(state == 0) & (q < -limit * (1 + 1e-12))] = -1
            new[(np.abs(state) == 1) & (slip * state < -1e-16)] = 0
            if (new == state).all():
                self.q, self.stretched, self.moved = q, K @ q, move
                return np.where(np.abs(state) == 1, np.abs(slip), 0.0)
            state = new
        raise RuntimeError("friction does not settle")

    def wear(self, k, slip):
        self.worn += k * self.p * slip

    def force(self):
        return self.width * self.p.sum(), self.width * self.q.sum()

    def fit(self, closing, force, move, friction):
        """What gives way behind the half planes, by forces at the first closing and the first move, in partial slip."""
        def pressed():
            self.press(closing)
            return self.force()[0]

        def sheared():
            self.q, self.stretched, self.moved = np.zeros_like(self.q), np.zeros_like(self.q), 0.0
            self.shear(move)
            return self.force()[1]
        self.find("soft_n", pressed, force)
        self.find("soft_t", sheared, friction)

    def find(self, name, value, wanted):
        """Forces fall where more gives way."""
        low, high = -1 / self.modulus, 10 / self.modulus
        for _ in range(60):
            middle = (low + high) / 2
            setattr(self, name, middle)
            low, high = (middle, high) if value() > wanted else (low, middle)

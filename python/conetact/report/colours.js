// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
"use strict";
// What colours mean: those of one sign from dark to bright, those of both signs from blue to red.
const MAPS = {
  plain: ["440154", "482475", "414487", "355f8d", "2a788e", "21918c", "22a884", "44bf70", "7ad151", "bddf26", "fde725"],
  signed: ["3b4cc0", "6282ea", "8db0fe", "b8d0f9", "dddddd", "f5c4ad", "f49a7b", "de604d", "b40426"],
};
const STATES = [["open", "8c949c"], ["stick", "16202a"], ["slip", "dc143c"], ["bonded", "2e8b57"], ["wet", "4169e1"]];
const rgb = (text) => [0, 2, 4].map((i) => parseInt(text.slice(i, i + 2), 16));

// 256 colours between those of a map
function ramp(stops) {
  const pixels = new Uint8Array(256 * 4).fill(255);
  for (let i = 0; i < 256; i++) {
    const at = (i / 255) * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2), w = at - k;
    const [a, b] = [rgb(stops[k]), rgb(stops[k + 1])];
    for (let c = 0; c < 3; c++) pixels[4 * i + c] = Math.round((1 - w) * a[c] + w * b[c]);
  }
  return pixels;
}

const gradient = (stops) => `linear-gradient(to right, ${stops.map((c) => "#" + c).join(", ")})`;

// four figures, without an exponent where that is short; `span`: what is small beside it is 0
function told(value, span = 0) {
  const size = Math.abs(value);
  if (size <= 1e-4 * span) return "0";
  if (size === 0) return "0";
  return size >= 1e5 || size < 1e-3 ? value.toExponential(2) : String(Number(value.toPrecision(4)));
}

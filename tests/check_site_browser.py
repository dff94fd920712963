#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""All pages of the site in a browser, on a wide and on a narrow screen: formulas are drawn, pictures are there, nothing is wider
than the screen, and the console stays silent.

usage: check_site_browser.py build/site/html
"""
import json
import sys
from pathlib import Path

from support.browser import Browser, chromium

WIDTHS = (1280, 400)
# What a reader sees amiss. Wide tables and listings scroll by themselves.
FAULTS = r"""(async () => {
  if (window.MathJax && MathJax.Hub) await new Promise((good) => MathJax.Hub.Queue(() => good()));
  const faults = [...document.images].filter((i) => i.complete && !i.naturalWidth).map((i) => "no picture " + i.src);
  const main = document.querySelector("main") || document.body;
  const texts = document.createTreeWalker(main, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const text = texts.currentNode;
    if (!text.parentElement.closest("pre, code, kbd, script, style, svg, .MathJax_SVG, .MathJax_Preview")
        && /\\\(|\\\[|\$[^ $]+\$|\\frac|@f\$/.test(text.data))
      faults.push("raw formula " + text.data.trim().slice(0, 40));
  }
  const scrolls = (e) => e && (["auto", "scroll", "hidden"].includes(getComputedStyle(e).overflowX) || scrolls(e.parentElement));
  for (const e of main.querySelectorAll("*"))
    if (e.getBoundingClientRect().right > innerWidth + 1 && !scrolls(e.parentElement))
      faults.push("too wide " + e.tagName + " " + e.textContent.trim().slice(0, 30));
  if (document.documentElement.scrollWidth > innerWidth) faults.push("the page is wider than the screen");
  return JSON.stringify({faults: faults.slice(0, 5), formulas: document.querySelectorAll(".MathJax_SVG").length});
})()"""


def pages(root):
    """All pages to be looked at: without those of Doxygen, and without those that only pass on to another one at once."""
    for page in sorted(root.rglob("*.html")):
        if "cpp" not in page.relative_to(root).parts and 'http-equiv="refresh"' not in page.read_text(encoding="utf-8"):
            yield page


def look(root, width):
    """Faults of all pages, and how many formulas they draw."""
    faults, formulas, browser = [], 0, Browser(width, 900)
    try:
        for page in pages(root):
            browser.said.clear()
            browser.open(page)
            seen = json.loads(browser.run(FAULTS))
            formulas += seen["formulas"]
            faults += [f"{page.relative_to(root)}, {width}: {fault}" for fault in seen["faults"] + browser.said[:2]]
    finally:
        browser.close()
    return faults, formulas


def main(folder):
    root = Path(folder)
    if not chromium():
        print("skipped: chromium is not installed (Debian: chromium)")
        return False
    if not root.is_dir():
        print("skipped: there is no site, see the target site")
        return False
    n_faults = 0
    for width in WIDTHS:
        faults, formulas = look(root, width)
        print("\n".join([*faults, f"{width} pixels: {len(faults)} faults, {formulas} formulas"]))
        n_faults += len(faults) + (formulas == 0)
    return n_faults > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

# SPDX-License-Identifier: GPL-3.0-or-later
"""A live view of a simulation in a notebook: small, pausable, in the colours of the teaching page."""
from __future__ import annotations

import html
import threading
import time
from contextlib import contextmanager

import numpy as np

from .arguments import real
from .errors import BadInput

# Slow to fast, as on the page (web/colours.js), and the camera of its start.
RISING = np.array([[76, 84, 232], [146, 70, 205], [220, 84, 140], [250, 150, 74], [255, 238, 90]], float)
DARK = "#10151a"
TURN, TILT = 0.45, 0.22
MOST_GRAINS = 4000  # grains that are drawn: those in front


def colours(values):
    """"#rrggbb" of values from 0 (slow) to 1 (fast)."""
    at = np.clip(values, 0, 1) * (len(RISING) - 1)
    i = np.minimum(at.astype(int), len(RISING) - 2)
    rgb = RISING[i] + (at - i)[:, None] * (RISING[i + 1] - RISING[i])
    return ["#%02x%02x%02x" % tuple(one) for one in np.rint(rgb).astype(int)]


def project(points, box):
    """Points in the box as the camera sees them: x to the right, y up, depth towards the viewer; the centre is 0."""
    x, y, z = (np.asarray(points, float) - np.asarray(box) / 2).T
    x, z = x * np.cos(TURN) + z * np.sin(TURN), z * np.cos(TURN) - x * np.sin(TURN)
    return np.column_stack([x, y * np.cos(TILT) - z * np.sin(TILT), y * np.sin(TILT) + z * np.cos(TILT)])


def corners(box):
    return np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)]) * box


def picture(sim, size=360):
    """The grains at this moment as SVG text, coloured by their speeds over twice the root mean square."""
    state, grains = sim.state, sim.grains
    if grains.position is None:
        raise BadInput("a view needs positions of grains: engine: md")
    box = np.array(state.box)
    speed = np.sqrt((grains.velocity**2).sum(axis=1))
    colour = colours(speed / (2 * np.sqrt((speed**2).mean()) or 1))
    radius = np.array([one.diameter for one in sim.species])[grains.species] / 2
    places, frame = project(grains.position, box), project(corners(box), box)
    scale = size / (2 * np.abs(frame[:, :2]).max() + 2 * radius.max())
    edges = [(a, b) for a in range(8) for b in range(a) if bin(a ^ b).count("1") == 1]
    at = size / 2 + scale * places[:, :2] * [1, -1]
    lines = size / 2 + scale * frame[:, :2] * [1, -1]
    words = [f"T = {state.temperature:.4g}, {state.collisions_per_grain:.1f} collisions a grain",
             f"{len(grains)} grains; slow ones blue, fast ones yellow"]
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{size}" height="{size + 36}" role="img" aria-label="{html.escape("; ".join(words))}">',
             f'<rect width="{size}" height="{size}" fill="{DARK}"/>']
    parts += [f'<path d="M{lines[a][0]:.1f} {lines[a][1]:.1f}L{lines[b][0]:.1f} {lines[b][1]:.1f}" stroke="#8899aa"/>' for a, b in edges]
    parts += [f'<circle cx="{at[i][0]:.1f}" cy="{at[i][1]:.1f}" r="{scale * radius[i]:.1f}" fill="{colour[i]}" stroke="{DARK}" stroke-width=".5"/>'
              for i in np.argsort(places[:, 2])[-MOST_GRAINS:]]
    parts += [f'<text x="2" y="{size + 15 + 16 * i}" font-size="12" font-family="sans-serif">{html.escape(line)}</text>' for i, line in enumerate(words)]
    return "".join(parts) + "</svg>"


class View:
    """Live picture of a simulation in a notebook, from sim.view(). It moves while other cells run.

    pause(), resume()      afterwards the simulation is free, and moves on
    with view.paused():    the same for a block, as for reading grains or changing a key
    stop()                 end it; the last picture stays
    error                  what ended it, such as RunFailed; None

    While it moves, other uses of the simulation raise Busy.
    """

    def __init__(self, sim, every=None, size=360, rate=8):
        self.every = None if every is None else real(every, "every")
        self.rate, self.size, self.error = real(rate, "rate"), int(size), None
        if not self.rate > 0 or not self.size > 0 or (self.every is not None and not self.every > 0):
            raise BadInput("view: every, size and rate must be above 0")
        self._sim, self._shown, self._thread, self._over = sim, None, None, False
        self._going, self._step = threading.Event(), threading.Lock()
        self.picture = picture(sim, self.size)

    def _repr_html_(self):
        return self.picture

    def __repr__(self):
        return f"<graingas.View: {'stopped' if self._over else 'moving' if self._going.is_set() else 'paused'}>"

    def _ipython_display_(self):
        from IPython.display import HTML, display
        self._shown, self._html = display(HTML(self.picture), display_id=True), HTML
        if self._thread is None:
            self.resume()

    def resume(self):
        """Moves on."""
        if self._over:
            raise BadInput("view: it was stopped; make another with sim.view()")
        self._going.set()
        if self._thread is None:
            self._thread = threading.Thread(target=self._move, daemon=True)
            self._thread.start()
        return self

    def pause(self):
        """Waits for the present step; afterwards the simulation is free."""
        self._going.clear()
        with self._step:
            return self

    @contextmanager
    def paused(self):
        """Context in which the view pauses."""
        moving = self._going.is_set()
        self.pause()
        try:
            yield self._sim
        finally:
            if moving and not self._over:
                self.resume()

    def stop(self):
        """Ends it."""
        self.pause()
        self._over = True
        self._going.set()  # the thread sees that it is over
        if self._thread and self._thread is not threading.current_thread():
            self._thread.join()
        return self

    def _advance(self):
        """A fifth of a diameter at the thermal speed, or `every`; a new picture."""
        self._sim.advance(self.every or 0.2 / np.sqrt(self._sim.temperature))
        self.picture = picture(self._sim, self.size)
        if self._shown is not None:
            self._shown.update(self._html(self.picture))

    def _move(self):
        while not self._over:
            began = time.monotonic()
            with self._step:
                if self._going.is_set() and not self._over:
                    try:
                        self._advance()
                    except Exception as error:  # the caller's thread sees it as an attribute
                        self.error, self._over = error, True
            self._going.wait()
            time.sleep(max(0.0, 1 / self.rate - (time.monotonic() - began)))

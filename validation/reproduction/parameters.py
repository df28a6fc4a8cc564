# SPDX-License-Identifier: GPL-3.0-or-later
"""Parameters of a figure for its titles: φ, e, β, μ and N where they are the same for all points."""
from .points import meets

KEYS = {"phi": "φ", "collision.e": "e", "collision.beta": "β", "collision.mu": "μ", "particles": "N"}


def _text(key, scene, figure):
    """"φ = 0.3"; "" for what a scene does not have, or has by pair of species."""
    smooth, review = scene.text_of("collision.beta") == "-1", figure.startswith("review")
    ensemble = key == "particles" and scene["engine"] == "dsmc" and "dsmc.particles"
    value, label = scene.text_of(ensemble or key), KEYS[key]
    if key == "particles" and (ensemble or key) not in scene.given():
        return ""  # the program chooses it
    if value in ("inf", "auto") or value[0] == "{" or (key == "collision.beta" and smooth and review):
        return ""
    if key == "collision.beta" and scene.text_of("collision.mu") != "inf":
        label = "β₀"
    return f"{'α' if review and label == 'e' else label} = {value}"


def _of_panel(panel, points, figure):
    """Texts by key, of the points that a panel shows."""
    taken = [point.scene for point in points if (not panel.sweeps or point.sweep in panel.sweeps) and meets(point.scene, panel.where)]
    found = {}
    for key in KEYS:
        texts = {_text(key, scene, figure) for scene in taken}
        if len(texts) == 1 and key != panel.key and key not in panel.lines:
            found[key] = texts.pop()
    return {key: text for key, text in found.items() if text}


def titles(entry, points):
    """The title of the figure, and those of its panels. A parameter of all panels is in the first, of one panel in its
    own, unless that names it already."""
    panels = [_of_panel(panel, points, entry.figure) for panel in entry.panels]
    common = {key: text for key, text in panels[0].items() if all(panel.get(key) == text for panel in panels)}
    own = []
    for panel, texts in zip(entry.panels, panels):
        title = panel.title or ""
        more = [text for key, text in texts.items() if key not in common and text not in title.replace("_0", "₀")]
        own.append(", ".join(([title] if title else []) + more))
    return entry.figure + ": " * bool(common) + ", ".join(common.values()), own

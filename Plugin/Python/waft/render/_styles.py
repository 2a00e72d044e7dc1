# SPDX-License-Identifier: BSD-3-Clause
"""Names of views, and looks of a picture: the colours of what does not fly, how soft the sun is, and how light becomes colour."""

from dataclasses import dataclass
from typing import Optional

VIEWS = ("hero", "side", "top", "follow")


@dataclass(frozen=True)
class Style:
    """Colours are red, green and blue from 0 to 1."""

    sky: tuple
    horizon: tuple
    ground: tuple
    trail: tuple
    grid: float  # opacity of the grid on the ground
    pool: tuple = (0.7, 5.7)  # where the ground's colour begins and ends to pass into the horizon's, in volume widths
    suns: int = 1  # rays a shadow is cast along; more than one have half shades
    sun_radius: float = 0.0  # of the sun's disk, as a tangent
    shadow: float = 0.42  # opacity of a shadow at its object
    translucency: float = 0.0  # share of the sun's light that a leaf lets through
    ambient: float = 0.46  # light on a body from everywhere
    backdrop: bool = True  # sky and ground; without them all but bodies, shadows and obstacles is clear
    exposure: Optional[float] = None  # of the tone mapping; None: colours as they are


STYLES = {
    "day": Style(
        sky=(0.20, 0.33, 0.48), horizon=(0.44, 0.53, 0.59), ground=(0.50, 0.55, 0.57),
        trail=(0.15, 0.20, 0.25), grid=0.18, pool=(0.3, 4.5), shadow=0.55),
    "studio": Style(
        sky=(0.46, 0.55, 0.60), horizon=(0.60, 0.68, 0.71), ground=(0.78, 0.83, 0.84),
        trail=(0.20, 0.30, 0.36), grid=0.0, pool=(0.2, 3.0),
        suns=12, sun_radius=0.10, shadow=0.55, translucency=0.55, exposure=1.15, ambient=0.30),
    "paper": Style(
        sky=(0.99, 0.985, 0.97), horizon=(0.98, 0.97, 0.95), ground=(0.98, 0.97, 0.95),
        trail=(0.35, 0.36, 0.40), grid=0.0,
        suns=12, sun_radius=0.10, shadow=0.42, translucency=0.55, exposure=1.45, ambient=0.30),
    "dark": Style(
        sky=(0.025, 0.035, 0.050), horizon=(0.045, 0.060, 0.075), ground=(0.170, 0.215, 0.240),
        trail=(0.42, 0.47, 0.50), grid=0.0, pool=(0.1, 1.6),
        suns=12, sun_radius=0.10, shadow=0.80, translucency=0.70, exposure=1.45, ambient=0.30),
    "clear": Style(
        sky=(0.0, 0.0, 0.0), horizon=(0.0, 0.0, 0.0), ground=(0.0, 0.0, 0.0),
        trail=(0.5, 0.5, 0.5), grid=0.0, backdrop=False,
        suns=12, sun_radius=0.10, shadow=0.55, translucency=0.55, ambient=0.30),
}

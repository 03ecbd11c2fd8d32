"""Parameters of the bodies and motions: name, symbol, unit, bounds and meaning of each one, in one table.

Sliders, links, command lines, sweeps and Python signatures all read this table.  A letter that stands for several
quantities, such as h, has one constant for each.  A scene may choose another default, slider range or wording; bounds
of its own need a comment with the reason.

The library param is not used here: its parameters belong to mutable classes, while these are hashable values, and the
mechanics import no user-interface library.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal, get_args

from hess_mechanics.errors import InvalidParameter

Group = Literal["Body", "State", "Computation"]
GROUPS: tuple[Group, ...] = get_args(Group)
"""Groups of parameters: those of the body, of the motion, and of the computation."""


_LARGE = 1e6


def plain(value: float, digits: int = 6) -> str:
    """Return a number as text, without an exponent between 1 and 1e6: 1200 for 1.2e+03, but 1e6 for 1e+06.

    Parameters
    ----------
    value : float
        The number.
    digits : int, default 6
        Largest number of significant digits.

    Returns
    -------
    str
        The text.
    """
    # Adding 0 turns −0 into 0.
    text = f"{value + 0.0:.{digits}g}"
    if "e" in text and 1.0 <= abs(float(text)) < _LARGE:
        return f"{float(text):.0f}"
    return text.replace("e+", "e").replace("e0", "e").replace("e-0", "e-")


@dataclass(frozen=True)
class Parameter:
    """A numerical parameter: its name, range, default and meaning.

    Parameters
    ----------
    name : str
        Name in links, options and Python.
    symbol : str
        Symbol in formulas and pictures.
    label : str
        Title of a few words.
    default : float
        Default value.
    softbounds : (float, float)
        Usual range, which a slider covers.
    step : float
        Step of the slider.
    bounds : (float, float)
        Smallest and largest value allowed.
    doc : str, optional
        Meaning, in a sentence.
    group : {"Body", "State", "Computation"}, default "State"
        Group to which the parameter belongs.
    unit : str, default "1"
        Unit; "1" for a number in the units of the problem.
    meaning : str, optional
        Distinguishes parameters with the same label; empty to use the label.  A scene takes over a value from another
        scene only if the meanings agree.
    is_integer : bool, default False
        True for integers.
    """

    name: str
    symbol: str
    label: str
    default: float
    softbounds: tuple[float, float]
    step: float
    bounds: tuple[float, float]
    doc: str = ""
    group: Group = "State"
    unit: str = "1"
    meaning: str = ""
    is_integer: bool = False

    @property
    def range(self) -> str:
        """The bounds in words, such as "between 0.001 and 1000"."""
        low, high = self.bounds
        return f"between {plain(low)} and {plain(high)}"

    def check(self, value: float) -> float:
        """Return the value if it is allowed.

        Parameters
        ----------
        value : float
            The value.

        Returns
        -------
        float
            The same value.

        Raises
        ------
        InvalidParameter
            If it is not a number within the bounds, both included, or not an integer where one is required.
        """
        low, high = self.bounds
        if not (low <= value <= high and (not self.is_integer or value == round(value))):
            kind = "is not a whole number" if self.is_integer else "is not"
            raise InvalidParameter(f"{self.name} = {plain(value)} {kind} {self.range}: choose a value in this range.")
        return value

    def fields(self, **changes: Any) -> Mapping[str, Any]:
        """Return all fields by name, with some of them changed.

        Parameters
        ----------
        **changes
            New values of fields.

        Returns
        -------
        dict
            The fields.
        """
        return {**vars(self), **changes}


def _vector(
    names: str,
    symbols: str,
    defaults: tuple[float, ...],
    label: str,
    softbounds: tuple[float, float],
    step: float,
    bounds: tuple[float, float],
    doc: str,
    group: Group = "State",
) -> tuple[Parameter, ...]:
    """Return the components of a vector, which differ only in name, symbol and default."""
    return tuple(
        Parameter(name, symbol, label.format(symbol=symbol), default, softbounds, step, bounds, doc, group)
        for name, symbol, default in zip(names.split(), symbols.split(), defaults, strict=True)
    )


_TURN = (-3.14, 3.14)
_ANGLES = (-1e3, 1e3)
"""Bounds of angles, which are periodic."""

# ---- a body with Suslov's constraint, in the axes in which I12 = 0 --------------------------------------------------

_MOMENT = (1e-3, 1e3)
_PRODUCT = (-1e3, 1e3)
I11 = Parameter(
    "I11", "I₁₁", "Inertia I₁₁", 1.5, (0.2, 5.0), 0.01, _MOMENT, "Moment of inertia about the first body axis.", "Body"
)
I22 = Parameter(
    "I22", "I₂₂", "Inertia I₂₂", 1.5, (0.2, 5.0), 0.01, _MOMENT, "Moment of inertia about the second body axis.", "Body"
)
I13 = Parameter(
    "I13",
    "I₁₃",
    "Inertia I₁₃",
    0.4,
    (-2.0, 2.0),
    0.01,
    _PRODUCT,
    "Product of inertia. With I₂₃ it decides where volume shrinks and where it grows.",
    "Body",
)
I23 = Parameter("I23", "I₂₃", "Inertia I₂₃", 0.4, (-2.0, 2.0), 0.01, _PRODUCT, "Product of inertia.", "Body")
TENSOR = (I11, I22, I13, I23)

B1 = Parameter(
    "b1", "b₁", "Centre of mass b₁", -0.5, (-3.0, 3.0), 0.01, (-1e3, 1e3), "First component of b = −mg r.", "Body"
)
B2 = Parameter("b2", "b₂", "Centre of mass b₂", -0.5, (-3.0, 3.0), 0.01, (-1e3, 1e3), "Second component of b.", "Body")
B3 = Parameter("b3", "b₃", "Centre of mass b₃", 0.7, (-3.0, 3.0), 0.01, (-1e3, 1e3), "Third component of b.", "Body")
FIELD = (B1, B2, B3)

D = Parameter(
    "D",
    "𝒟",
    "Ball inside, 𝒟",
    10.0,
    (0.0, 20.0),
    0.05,
    (0.0, 300.0),
    "𝒟 = (R/Rₛ)² Iₛ of the ball that rolls inside; 0 is the free Suslov problem.",
    "Body",
)
K_DRIVES_I11 = Parameter(
    "k",
    "k",
    "k, which sets I₁₁",
    2.4,
    (-2.0, 7.0),
    0.05,
    (-50.0, 50.0),
    "I₁₁ = I₂₂ + k|k| (I₁₃² + I₂₃²)/I₂₂. With I₁₃ = 0 and k odd there is an additional integral F₂.",
    "Body",
)
RATIO = Parameter(
    "ratio",
    "I₁₁/I₂₂",
    "Ratio I₁₁/I₂₂",
    2.0,
    (0.2, 5.0),
    0.01,
    (1e-2, 1e2),
    "At 1 the potential is central and the motion integrable.",
    "Body",
)
C1, C2, CUBIC, QUARTIC = _vector(
    "c1 c2 cubic quartic",
    "c₁ c₂ c₃ c₄",
    (1.0, 0.8, 1.0, 0.5),
    "Potential {symbol}",
    (-2.0, 2.0),
    0.01,
    (-1e3, 1e3),
    "Coefficient of U = c₁γ₁²/2 + c₂γ₂²/2 + c₃(γ₁²γ₂ − γ₂³/3) + c₄γ₁²γ₂².",
    "Body",
)

# ---- the Suslov–Hess case -------------------------------------------------------------------------------------------

_UNITS_OF_B = "Suslov–Hess, in units b = 1"
A_HESS = Parameter(
    "a",
    "a",
    "Inertia parameter a",
    0.5,
    (0.0, 2.0),
    0.005,
    (-1e3, 1e3),
    "a = I₂₃/I₂₂ (Suslov) or √((a₃−a₂)(a₂−a₁))/a₂ (Euler–Poisson); a rigid body has |a| < 1.",
    "Body",
)
B_HESS = Parameter("b", "b", "Field b", 1.0, (0.05, 3.0), 0.01, (-1e3, 1e3), "Field of the reduced equations.", "Body")
H_HESS = Parameter(
    "h",
    "h",
    "Energy h",
    1.5,
    (-0.99, 4.0),
    0.01,
    (-1.0 + 1e-9, 1e6),
    "Energy integral in units b = 1: h > −1; separatrix at h = 1, f = 0.",
    meaning=_UNITS_OF_B,
)
H_PLANE = replace(H_HESS, bounds=(-1e6, 1e6))
"""h for sweeps and commands, which report h ≤ −1 themselves."""
F_HESS = Parameter(
    "f",
    "f",
    "Area integral f",
    0.6,
    (-3.0, 3.0),
    0.01,
    (-1e4, 1e4),
    "Area integral in units b = 1; its range depends on h.",
    meaning=_UNITS_OF_B,
)
PHI0 = Parameter(
    "phi0",
    "φ₀",
    "Phase φ₀",
    0.5,
    _TURN,
    0.01,
    _ANGLES,
    "Phase of the orbit on the section n₃ = n₃⁽¹⁾, in radians.",
    unit="rad",
)
REDUCED_OMEGA = _vector(
    "w1 w2",
    "w₁ w₂",
    (0.3, 0.9),
    "Reduced velocity {symbol}(0)",
    (-4.0, 4.0),
    0.01,
    (-1e3, 1e3),
    "Component of the reduced angular velocity at t = 0.",
)
REDUCED_GAMMA = _vector(
    "n1 n2 n3",
    "n₁ n₂ n₃",
    (0.6, 0.0, 0.8),
    "Reduced vertical {symbol}(0)",
    (-1.0, 1.0),
    0.01,
    (-1e3, 1e3),
    "Component of the reduced vertical at t = 0; normalised.",
)

# ---- a heavy body with a fixed point, in its principal axes ---------------------------------------------------------

_HEAVY = "Euler–Poisson"
I1, I2, I3 = tuple(
    Parameter(name, symbol, f"Moment {symbol}", default, (0.1, 3.0), 0.005, _MOMENT, doc, "Body")
    for name, symbol, default, doc in (
        ("I1", "I₁", 1.0, "First principal moment of inertia."),
        ("I2", "I₂", 0.625, "Middle principal moment; the Hess condition needs I₂ between I₁ and I₃."),
        ("I3", "I₃", 0.375, "Third principal moment of inertia."),
    )
)
INVERSE_MOMENTS = _vector(
    "a1 a2 a3",
    "a₁ a₂ a₃",
    (1.0, 1.25, 1.6),
    "Inverse moment {symbol}",
    (0.3, 10.0),
    0.005,
    _MOMENT,
    "Inverse of a principal moment of inertia.",
    "Body",
)
CENTRE = _vector(
    "r1 r2 r3",
    "r₁ r₂ r₃",
    (0.3, -0.5, 1.0),
    "Centre of mass {symbol}",
    (-3.0, 3.0),
    0.01,
    (-1e3, 1e3),
    "Component of the centre of mass.",
    "Body",
)
MU = Parameter("mu", "μ", "Weight μ", 0.5, (0.0, 4.0), 0.005, (-1e3, 1e3), "Weight; the potential is −μ(r, γ).", "Body")
MU_R = Parameter(
    "m",
    "μ|r|",
    "Weight times distance, μ|r|",
    9.975,
    (-20.0, 20.0),
    0.005,
    (-1e3, 1e3),
    "The product μ|r| in the potential −μ(r, γ); its sign is that of r.",
    "Body",
)
MOMENTUM = _vector(
    "M1 M2 M3",
    "M₁ M₂ M₃",
    (0.8, -0.4, 0.5),
    "Momentum {symbol}(0)",
    (-4.0, 4.0),
    0.01,
    (-1e3, 1e3),
    "Component of the angular momentum at t = 0.",
)
H_HEAVY = Parameter(
    "h",
    "h",
    "Energy h",
    50.0,
    (-9.0, 100.0),
    0.05,
    (-1e3, 1e5),
    "Energy H = h, which must exceed −μ|r|.",
    meaning=_HEAVY,
)
F_HEAVY = Parameter(
    "f",
    "f",
    "Area integral f",
    5.0,
    (-8.0, 8.0),
    0.05,
    (-1e3, 1e3),
    "Area integral f = (M, γ); its range depends on h.",
    meaning=_HEAVY,
)
L = Parameter(
    "l", "l", "Angle l", 0.0, _TURN, 0.01, _ANGLES, "Andoyer–Deprit angle of M about axis 3, at t = 0.", unit="rad"
)
X = Parameter("x", "L/G", "Inclination L/G", 0.2, (-1.0, 1.0), 0.01, (-1.0, 1.0), "M₃/|M| at t = 0.")
SHEET = Parameter(
    "sheet",
    "sheet",
    "Sheet",
    0,
    (0, 2),
    1,
    (0, 2),
    "Number of the root G of the energy equation; 0 is the largest root.",
    is_integer=True,
)
H_PENDULUM = Parameter(
    "energy",
    "h",
    "Energy h",
    1.5,
    (-0.95, 4.0),
    0.01,
    (-1.0 + 1e-4, 1e4),
    "In units of μ|r|: −1 hanging at rest, 1 the separatrix, on which the body comes to rest upright.",
)
L_PENDULUM = Parameter(
    "l",
    "l",
    "Middle axis l(0)",
    0.15,
    (0.02, 3.12),
    0.01,
    (1e-3, math.pi - 1e-3),
    "Angle of the middle axis from M, which is horizontal, when the centre of mass passes its lowest position.",
    unit="rad",
)

# ---- energies of the other problems ---------------------------------------------------------------------------------

E = Parameter("E", "E", "Energy E", 1.0, (-3.0, 6.0), 0.01, (-1e6, 1e6), "Energy, kinetic and potential.")
H_SUSLOV = Parameter(
    "h",
    "h",
    "Energy above the bottom, h",
    1.0,
    (0.01, 6.0),
    0.01,
    (1e-6, 1e6),
    "E + |b|, the energy above its smallest possible value.",
)
H_BALL = Parameter(
    "h",
    "h",
    "Energy above the minimum",
    2.0,
    (0.05, 5.0),
    0.01,
    (1e-3, 1e3),
    "E = h − √(b₁²+b₂²): every h > 0 has motions through γ₃ = 0.",
)
H_FREE_BALL = Parameter(
    "h",
    "h",
    "Energy h",
    10.0,
    (0.1, 20.0),
    0.1,
    (1e-6, 1e6),
    "Energy E = h > 0, which sets the size of the strip and the unit of time.",
)
H_QUARTIC = Parameter(
    "h",
    "h",
    "Energy E = h",
    0.8,
    (-0.9, 4.0),
    0.01,
    (-1e2, 1e3),
    "Energy E, which must exceed −|b₃|. Above |b₃| the point cannot reach the middle.",
)

# ---- where a motion starts, and how long it is followed -------------------------------------------------------------

W1, W2 = OMEGA = _vector(
    "w1 w2",
    "ω₁ ω₂",
    (0.8, -0.4),
    "Angular velocity {symbol}(0)",
    (-4.0, 4.0),
    0.01,
    (-1e3, 1e3),
    "Component of the angular velocity at t = 0.",
)
GAMMA = _vector(
    "g1 g2 g3",
    "γ₁ γ₂ γ₃",
    (0.6, 0.0, 0.8),
    "Vertical {symbol}(0)",
    (-1.0, 1.0),
    0.01,
    (-1e3, 1e3),
    "Component of the vertical at t = 0; normalised.",
)
PSI = Parameter(
    "psi",
    "ψ",
    "Start: ψ, direction of γ",
    1.0,
    _TURN,
    0.01,
    _ANGLES,
    "Angle of γ in the plane of the section, at t = 0.",
    unit="rad",
)
DELTA = Parameter(
    "delta",
    "δ",
    "Start: δ, from γ to ω",
    1.0,
    (0.01, 3.13),
    0.01,
    (0.0, math.pi),
    "Angle of ω from the direction that keeps γ in the plane of the section, at t = 0.",
    unit="rad",
)
THETA = Parameter(
    "theta",
    "θ⁻",
    "Angle θ⁻ of the initial circle",
    1.2,
    (0.0, 3.14),
    0.01,
    (0.0, math.pi),
    "The angle between ξ and γ on the circle that the motion leaves.",
    unit="rad",
)
CIRCLE_PHASE = Parameter(
    "phi",
    "φ",
    "Phase φ",
    0.5,
    _TURN,
    0.01,
    _ANGLES,
    "Angle on the initial circle at which γ starts, in radians.",
    unit="rad",
)
GAMMA_CIRCLE = Parameter(
    "Gamma",
    "Γ",
    "Γ(0) = (ξ, γ)",
    0.4984,
    (-1.0, 1.0),
    0.01,
    (-1.0, 1.0),
    "Initial component of γ along ξ, which is the height of its circle on the sphere.",
)
TIME = Parameter(
    "duration",
    "t",
    "Time",
    50.0,
    (0.0, 200.0),
    1.0,
    (-1e9, 1e9),
    "Last time; negative for backward motion.",
    "Computation",
    "time",
)
MAX_STEP = Parameter(
    "max_step",
    "Δt",
    "Longest step",
    0.0,
    (0.0, 1.0),
    0.001,
    (0.0, 1e6),
    "Longest step of the integration. Choose it below the width of the shortest pulse of the field; 0: a hundredth of "
    "the time span for a field with functions, else no limit.",
    "Computation",
    "time",
)
SPAN = Parameter(
    "duration",
    "t",
    "Time span",
    50.0,
    (1.0, 200.0),
    1.0,
    (1e-3, 1e6),
    "Duration of the motion.",
    "Computation",
    "time",
)

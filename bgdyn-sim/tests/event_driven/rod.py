"""The reference of the sliding rod of main.rs, in 40 digits: python3 rod.py (needs mpmath).

A rod of mass 1 kg slides on one end, at r = l (cos θ, sin θ) from its centre, on level ground: y = −l sin θ. With the normal
force λ and the friction −μ λ along x,
  λ (1 + l cos θ (l cos θ + μ l sin θ)/I) = g + l sin θ ω²,  ω' = λ (l cos θ + μ l sin θ)/I,  x'' = −μ λ.
"""
from mpmath import cos, mp, mpf, odefun, sin

mp.dps = 40
G, L, MU = mpf("9.81"), mpf("0.5"), 2
INERTIA = L * L / 3


def rates(_, y):
    _, angle, speed, spin = y
    arm = L * cos(angle) + MU * L * sin(angle)
    force = (G + L * sin(angle) * spin * spin) / (1 + L * cos(angle) * arm / INERTIA)
    return [speed, spin, -MU * force, force * arm / INERTIA]


end = odefun(rates, 0, [mpf(0), -mpf("0.55"), mpf(10), mpf(0)])(mpf("0.07"))
for name, value in zip(("x", "angle", "speed", "spin"), end):
    print(name, mp.nstr(value, 20))

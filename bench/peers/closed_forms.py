"""Special points that are known without either program."""

import math

from programs import KV


def _on_the_diagonal(s, command):
    """Force along the diagonal, stiffness along and across it, of the Orthoglide at (s, s)."""
    a = math.asin(s)
    theta, t, c = s - command + math.cos(a), math.tan(a), math.cos(a)
    own = 1 + t * t - theta / c**3 + KV * (1 / c**2 + a * math.sin(a) / c**3)
    mixed = -2 * t
    return math.sqrt(2) * (theta * (1 - t) + KV * a / c), own + mixed, own - mixed


def _zeros(function, low, high, parts=4000):
    values = [low + (high - low) * i / parts for i in range(parts + 1)]
    for a, b in zip(values, values[1:]):
        if function(a) * function(b) > 0:
            continue
        for _ in range(80):
            middle = 0.5 * (a + b)
            a, b = (a, middle) if function(a) * function(middle) <= 0 else (middle, b)
        yield 0.5 * (a + b)


def orthoglide_points(at, end=0.9848):
    """(label, lambda) of limit and branch points from (at, at) outwards, in the order of the curve."""
    angle = math.asin(at)
    command = at + math.cos(angle) + KV * angle / (math.cos(angle) - math.sin(angle))
    found = []
    for place, label in ((1, "LP"), (2, "BP")):
        for s in _zeros(lambda x: _on_the_diagonal(x, command)[place], at + 1e-6, end):
            found.append((s, label, _on_the_diagonal(s, command)[0]))
    return [(label, force) for _, label, force in sorted(found)]


def buckling_loads(links, up_to):
    """Of the straight column: 4 N^2 sin^2((2 j - 1) pi / (2 (2 N + 1)))."""
    loads = [4 * links**2 * math.sin((2 * j - 1) * math.pi / (2 * (2 * links + 1)))**2
             for j in range(1, min(links, 20) + 1)]
    return [load for load in loads if load < up_to]

#!/usr/bin/env python3
"""A tracer of your own as a program: cases come in as JSON lines, each goes out again with its answer.

    plumbline generate exact_edge23 | python3 ray_tracer.py | plumbline judge -
    plumbline sweep --tracer 'pipe:python3 ray_tracer.py' --tracer exact

In place of intersect, call what you want tested."""
import json
import sys


def minus(p, q):
    return [p[i] - q[i] for i in range(3)]


def cross(p, q):
    return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]


def dot(p, q):
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


def intersect(triangle, origin, direction, t_min, t_max):
    """(t, u, v), or None: the plane first, then on which side of each edge."""
    a, b, c = triangle
    normal = cross(minus(b, a), minus(c, a))
    slope = dot(normal, direction)
    if slope == 0:
        return None
    t = dot(normal, minus(a, origin)) / slope
    if not t_min <= t <= t_max:
        return None
    point = [origin[i] + t * direction[i] for i in range(3)]
    weights = [dot(cross(minus(end, start), minus(point, start)), normal) for start, end in ((b, c), (c, a), (a, b))]
    if not min(weights) >= 0:
        return None
    whole = sum(weights) or 1.0
    return t, weights[1] / whole, weights[2] / whole


def number(x, default):
    """A JSON number, null, or "inf", "-inf", "nan" and hexfloats as strings."""
    if x is None:
        return default
    return float.fromhex(x) if isinstance(x, str) else float(x)


def vector(xs):
    return [number(x, None) for x in xs]


def answer(case):
    if "triangle" not in case:
        return {"hit": None}  # a bag of triangles: this tracer takes one
    hit = intersect([vector(p) for p in case["triangle"]], vector(case["origin"]), vector(case["direction"]),
                    number(case.get("t_min"), 0.0), number(case.get("t_max"), float("inf")))
    if hit is None:
        return {"hit": False}
    return {"hit": True} | {key: repr(x) if x != x or abs(x) == float("inf") else x for key, x in zip("tuv", hit)}


for line in sys.stdin:
    case = json.loads(line)
    print(json.dumps(case | answer(case)), flush=True)  # flush: Plumbline waits for the answer

"""Writes C for the items of the benchmark by CasADi and SymPy.

    python generate.py FOLDER

Every function has the shape `int name(const double *given, double *found)`. Given are the driver's angle, or a pose, and the loads;
found are, for each set of loads, the forces in the joints as x, y and then the torque, in the benchmark's order. Poses are closed by
hand in both: neither has closed forms of its own. Each function is written twice, the second time with a name that ends in `_f32`, in
a file whose name does, to be compiled with `single.h`.

* `casadi_hand`: forces from two moment equations for each dyad, as an expert writes them; CasADi eliminates common subexpressions.
* `casadi_qr`: all equations of the free bodies, by CasADi's sparse QR, whose structure is known when the code is written.
* `casadi_symbolic`: the same by `solve` of its scalar expressions, a QR that is written out.
* `sympy`: the same by `linsolve`, then `cse`.
"""

import re
import sys
from pathlib import Path

import casadi as ca
import sympy as sp

G = 9.81


class Casadi:
    """What the formulas need of CasADi."""

    sqrt, sin, cos = staticmethod(ca.sqrt), staticmethod(ca.sin), staticmethod(ca.cos)


class Sympy:
    """What the formulas need of SymPy."""

    sqrt, sin, cos = staticmethod(sp.sqrt), staticmethod(sp.sin), staticmethod(sp.cos)


# --- poses, closed by hand ------------------------------------------------------------------------------------------------------


def dyad(m, dx, dy, r1, r2):
    """Both links' vectors to the inner joint, on the left, and their product; d is between the outer joints."""
    d2 = dx * dx + dy * dy
    s = d2 + (r1 * r1 - r2 * r2)
    root = m.sqrt(4 * r1 * r1 * d2 - s * s)
    half = 0.5 / d2
    along, across = s * half, root * half
    x, y = along * dx - across * dy, along * dy + across * dx
    return x, y, x - dx, y - dy, 0.5 * root


def four_bar_pose(m, theta):
    """crank, coupler, rocker, coupler × rocker."""
    ax, ay = 80 * m.cos(theta), 80 * m.sin(theta)
    return [ax, ay, *dyad(m, 140 - ax, -ay, 100, 120)]


def six_bar_pose(m, theta):
    """crank, coupler, rocker, their product, C from B0, rod, arm, their product."""
    ax, ay = 50 * m.cos(theta), 50 * m.sin(theta)
    x3, y3, x4, y4, first = dyad(m, 150 - ax, -ay, 140, 100)
    cx, cy = 0.8 * x4 + 0.4 * y4, 0.8 * y4 - 0.4 * x4
    return [ax, ay, x3, y3, x4, y4, first, cx, cy, *dyad(m, 180 - cx, 20 - cy, 170, 110)]


def slider_crank_pose(m, theta):
    """crank, rod."""
    ax, ay = 45 * m.cos(theta), 45 * m.sin(theta)
    return [ax, ay, m.sqrt(22500 - ay * ay), -ay]


# --- forces by hand -------------------------------------------------------------------------------------------------------------

Y = 0.5562148865321747  # of C in the coupler's frame, over the coupler's length


def four_bar_forces(pose, loads):
    ax, ay, x3, y3, x4, y4, product = pose
    f13x, f13y, f14x, f14y = loads
    m3 = 0.425 * (x3 * f13y - y3 * f13x) - Y * (x3 * f13x + y3 * f13y)
    m4 = 0.75 * (x4 * f14y - y4 * f14x)
    inverse = 1 / product
    p, q = m3 * inverse, m4 * inverse
    bx, by = p * x4 + q * x3, p * y4 + q * y3
    fx, fy = bx - f13x, by - f13y
    return [fx, fy, fx, fy, bx, by, -f14x - bx, -f14y - by, ax * fy - ay * fx]


def six_bar_forces(pose, loads):
    ax, ay, x3, y3, x4, y4, first, cx, cy, x5, y5, x6, y6, second = pose
    fx, fy, gx, gy = loads
    m5 = -0.5 * 0.7 * G * x5
    m6 = (
        70 / 110 * (x6 * gy - y6 * gx)
        - 25 / 110 * (x6 * gx + y6 * gy)
        - 0.6 * G * (50 / 110 * x6 - 8 / 110 * y6)
    )
    inverse = 1 / second
    p, q = m5 * inverse, m6 * inverse
    dx, dy = p * x6 + q * x5, p * y6 + q * y5
    px, py = dx, dy + 0.7 * G
    m3 = (
        60 / 140 * (x3 * fy - y3 * fx)
        - 35 / 140 * (x3 * fx + y3 * fy)
        - 0.9 * G * (65 / 140 * x3 - 12 / 140 * y3)
    )
    m4 = cy * px - cx * py - 0.8 * G * (0.6 * x4 + 0.1 * y4)
    inverse = 1 / first
    p, q = m3 * inverse, m4 * inverse
    bx, by = p * x4 + q * x3, p * y4 + q * y3
    axx, axy = bx - fx, by - fy + 0.9 * G
    return [
        *(axx, axy + 0.4 * G, axx, axy, bx, by, px - bx, py + 0.8 * G - by),
        *(px, py, dx, dy, -gx - dx, 0.6 * G - gy - dy),
        ax * axy - ay * axx + 0.5 * 0.4 * G * ax,
    ]


def slider_crank_forces(pose, loads):
    ax, ay, x, y = pose
    gx, gy = loads
    fx, fy = -gx, -gx * y / x
    return [fx, fy, fx, fy, fx, fy, 0, -gy - fy, ax * fy - ay * fx]


# --- forces from all equations --------------------------------------------------------------------------------------------------


def pins(links, joints, loads):
    """Lines of (coefficients, right side) for links on pins; the torque on link 0 is the last unknown.

    A joint is (first, place, second, place), places from the point of moments of each link; a load (link, place, force).
    """
    n = 3 * links
    lines = [([0] * n, 0) for _ in range(n)]

    def add(link, column, x, y, sign):
        for unit, (fx, fy) in enumerate([(1, 0), (0, 1)]):
            for line, value in enumerate([fx, fy, x * fy - y * fx]):
                lines[3 * link + line][0][column + unit] += sign * value

    for k, (first, at_first, second, at_second) in enumerate(joints):
        add(second, 2 * k, *at_second, 1)
        if first is not None:
            add(first, 2 * k, *at_first, -1)
    lines[2][0][n - 1] = 1
    for link, (x, y), (fx, fy) in loads:
        for line, value in enumerate([fx, fy, x * fy - y * fx]):
            coefficients, right = lines[3 * link + line]
            lines[3 * link + line] = (coefficients, right - value)
    return lines


def at(x, y, length, along, across):
    """A place in the frame of a link whose vector is (x, y)."""
    a, b = along / length, across / length
    return (a * x - b * y, a * y + b * x)


HERE = (0, 0)


def four_bar_lines(pose, loads):
    ax, ay, x3, y3, x4, y4, _ = pose
    joints = [
        (None, None, 0, HERE),
        (0, (ax, ay), 1, HERE),
        (1, (x3, y3), 2, (x4, y4)),
        (None, None, 2, HERE),
    ]
    forces = [(1, (0.425 * x3 - Y * y3, 0.425 * y3 + Y * x3), loads[:2]), (2, (0.75 * x4, 0.75 * y4), loads[2:])]
    return pins(3, joints, forces)


def six_bar_lines(pose, loads):
    ax, ay, x3, y3, x4, y4, _, cx, cy, x5, y5, x6, y6, _ = pose
    joints = [
        (None, None, 0, HERE),
        (0, (ax, ay), 1, HERE),
        (1, (x3, y3), 2, (x4, y4)),
        (None, None, 2, HERE),
        (2, (cx, cy), 3, HERE),
        (3, (x5, y5), 4, (x6, y6)),
        (None, None, 4, HERE),
    ]
    forces = [
        (1, at(x3, y3, 140, 60, 35), loads[:2]),
        (4, at(x6, y6, 110, 70, 25), loads[2:]),
        (0, at(ax, ay, 50, 25, 0), (0, -0.4 * G)),
        (1, at(x3, y3, 140, 65, 12), (0, -0.9 * G)),
        (2, at(x4, y4, 100, 60, -10), (0, -0.8 * G)),
        (3, at(x5, y5, 170, 85, 0), (0, -0.7 * G)),
        (4, at(x6, y6, 110, 50, 8), (0, -0.6 * G)),
    ]
    return pins(5, joints, forces)


def slider_crank_lines(pose, loads):
    """Unknowns: forces at O, A and B, the guide's force and couple, the torque; moments about O, A and B."""
    ax, ay, x, y = pose
    zero = [0] * 9
    lines = [(list(zero), 0) for _ in range(9)]
    for link in range(3):
        lines[3 * link][0][2 * link] = 1
        lines[3 * link + 1][0][2 * link + 1] = 1
    for link, (px, py) in enumerate([(ax, ay), (x, y)]):
        lines[3 * link][0][2 * link + 2] = -1
        lines[3 * link + 1][0][2 * link + 3] = -1
        lines[3 * link + 2][0][2 * link + 2] = py
        lines[3 * link + 2][0][2 * link + 3] = -px
    lines[7][0][6] = 1
    lines[8][0][7] = 1
    lines[2][0][8] = 1
    lines[6] = (lines[6][0], -loads[0])
    lines[7] = (lines[7][0], -loads[1])
    return lines


def slider_crank_results(unknowns):
    """The guide has a force across itself only, and its couple is no result."""
    return [*unknowns[:6], 0, unknowns[6], unknowns[8]]


# --- CasADi ---------------------------------------------------------------------------------------------------------------------


def casadi_function(name, count, results, kind=ca.SX):
    """A function of `count` numbers as C, with a wrapper of the common shape."""
    given = kind.sym("given", count)
    found = results([given[k] for k in range(count)])
    found = found if isinstance(found, (ca.SX, ca.MX)) else ca.vertcat(*found)
    function = ca.Function(f"{name}_body", [given], [ca.densify(found)], {"cse": True})
    generator = ca.CodeGenerator(name, {"with_header": False})
    generator.add(function)
    code = generator.dump()
    args, res, ints, reals = (max(1, n) for n in (function.sz_arg(), function.sz_res(), function.sz_iw(), function.sz_w()))
    return (
        code
        + f"""
int {name}(const double *given, double *found) {{
  const casadi_real *arg[{args}] = {{given}};
  casadi_real *res[{res}] = {{found}};
  casadi_int iw[{ints}];
  casadi_real w[{reals}];
  return {name}_body(arg, res, iw, w, 0);
}}
"""
    )


def casadi_solved(lines, solver):
    matrix = ca.vertcat(*[ca.horzcat(*coefficients) for coefficients, _ in lines])
    right = ca.vertcat(*[right for _, right in lines])
    # Entries that are zero in every pose are no entries: the matrix is sparse.
    if isinstance(matrix, ca.SX):
        matrix = ca.sparsify(matrix)
        return ca.solve(matrix, right)
    pattern = ca.DM([[0 if isinstance(c, (int, float)) and c == 0 else 1 for c in cs] for cs, _ in lines])
    matrix = ca.project(matrix, ca.sparsify(pattern).sparsity())
    return ca.solve(matrix, right, solver)


def casadi_items(method, forces, kind=ca.SX):
    """The functions of a method: `forces(linkage, pose, loads)` gives the results."""
    m = Casadi
    listed = lambda found, n: [found[k] for k in range(n)]  # noqa: E731
    p1 = lambda pose, loads: listed(forces("p1", pose, loads), 9)  # noqa: E731
    yield f"{method}_p1a", 7 + 4, lambda g: p1(g[:7], g[7:])
    yield f"{method}_p1b", 5, lambda g: p1(four_bar_pose(m, g[0]), g[1:])
    yield f"{method}_p1c", 5, lambda g: p1(four_bar_pose(m, g[0]), g[1:])[8:]

    def parts(g):
        pose = four_bar_pose(m, g[0])
        return [*p1(pose, [g[1], g[2], 0, 0]), *p1(pose, [0, 0, g[3], g[4]])]

    yield f"{method}_p1d", 5, parts
    yield f"{method}_p2b", 5, lambda g: listed(forces("p2", six_bar_pose(m, g[0]), g[1:]), 15)

    def slider(g):
        found = forces("p3", slider_crank_pose(m, g[0]), g[1:])
        return listed(found, 9) if method == "casadi_hand" else slider_crank_results(listed(found, 9))

    yield f"{method}_p3b", 3, slider


HAND = {"p1": four_bar_forces, "p2": six_bar_forces, "p3": slider_crank_forces}
LINES = {"p1": four_bar_lines, "p2": six_bar_lines, "p3": slider_crank_lines}


def casadi_files():
    yield casadi_function("casadi_pose", 1, lambda g: four_bar_pose(Casadi, g[0]))
    methods = [
        ("casadi_hand", lambda which, pose, loads: HAND[which](pose, loads), ca.SX),
        ("casadi_symbolic", lambda which, pose, loads: casadi_solved(LINES[which](pose, loads), None), ca.SX),
        ("casadi_qr", lambda which, pose, loads: casadi_solved(LINES[which](pose, loads), "qr"), ca.MX),
    ]
    for method, forces, kind in methods:
        for name, count, results in casadi_items(method, forces, kind):
            yield casadi_function(name, count, results, kind)


# --- SymPy ----------------------------------------------------------------------------------------------------------------------


def sympy_function(name, given, steps, found):
    """C for results that are expressions of named steps, each of which may use the ones before."""
    bound = {symbol for symbol, _ in steps}
    expressions = [sp.sympify(e) for e in [*(e for _, e in steps), *found]]
    shared, reduced = sp.cse(expressions, symbols=sp.numbered_symbols("t"))
    # `cse` sees steps and results as one list: its terms are written where all that they use is known.
    lines, known = [], set(given)
    waiting = list(shared) + [(symbol, reduced[k]) for k, (symbol, _) in enumerate(steps)]
    while waiting:
        ready = [(s, e) for s, e in waiting if not ((e.free_symbols & (bound | {t for t, _ in shared})) - known)]
        assert ready, name
        for symbol, expression in ready:
            lines.append(f"  const double {symbol} = {sp.ccode(expression)};")
            known.add(symbol)
        waiting = [pair for pair in waiting if pair[0] not in known]
    inputs = [f"  const double {symbol} = given[{k}];" for k, symbol in enumerate(given)]
    outputs = [f"  found[{k}] = {sp.ccode(e)};" for k, e in enumerate(reduced[len(steps) :])]
    return "\n".join(
        ["#include <math.h>", f"int {name}(const double *given, double *found) {{", *inputs, *lines, *outputs, "  return 0;", "}", ""]
    )


def symbols(prefix, count):
    return list(sp.symbols(f"{prefix}0:{count}", real=True))


def solved(lines, loads):
    """The unknowns by `linsolve`. The right sides are symbols, so that numbers do not meet the solver as decimals."""
    n = len(lines)
    unknowns = symbols("u", n)
    equations = [sum(sp.nsimplify(c, rational=True) * u for c, u in zip(cs, unknowns) if c != 0) for cs, _ in lines]
    rights = symbols("r", n)
    (found,) = sp.linsolve([e - r for e, r in zip(equations, rights)], *unknowns)
    return list(found), list(zip(rights, (right for _, right in lines)))


def sympy_poses(closed, count):
    theta = sp.Symbol("theta", real=True)
    pose = symbols("p", count)
    return theta, pose, list(zip(pose, closed(Sympy, theta)))


def sympy_files():
    loads = symbols("f", 4)
    theta, pose, steps = sympy_poses(four_bar_pose, 7)
    found, rights = solved(four_bar_lines(pose, loads), loads)
    yield sympy_function("sympy_p1a", pose + loads, rights, found)
    yield sympy_function("sympy_p1b", [theta] + loads, steps + rights, found)
    yield sympy_function("sympy_p1c", [theta] + loads, steps + rights, found[8:])
    alone = []
    for part in (loads[:2] + [0, 0], [0, 0] + loads[2:]):
        found, rights = solved(four_bar_lines(pose, part), part)
        alone += [e.subs(dict(rights)) for e in found]
    yield sympy_function("sympy_p1d", [theta] + loads, steps, alone)

    theta, pose, steps = sympy_poses(six_bar_pose, 14)
    found, rights = solved(six_bar_lines(pose, loads), loads)
    yield sympy_function("sympy_p2b", [theta] + loads, steps + rights, found)

    loads = symbols("f", 2)
    theta, pose, steps = sympy_poses(slider_crank_pose, 4)
    found, rights = solved(slider_crank_lines(pose, loads), loads)
    yield sympy_function("sympy_p3b", [theta] + loads, steps + rights, slider_crank_results(found))


def in_single(code):
    """The same under a name of its own; what its numbers are is for the compiler."""
    (name,) = re.findall(r"^int (\w+)\(const double", code, re.MULTILINE)
    return re.sub(rf"\b{name}", f"{name}_f32", code)


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for library, files in [("casadi", casadi_files()), ("sympy", sympy_files())]:
        for index, code in enumerate(files):
            (folder / f"{library}_{index}.c").write_text(code)
            (folder / f"{library}_{index}_f32.c").write_text(in_single(code))


main()

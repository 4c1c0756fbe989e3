"""Affine 4x4 matrices as lists of rows, for the rigs and the reader of glTF."""
import math


def identity():
    return [[float(i == j) for j in range(4)] for i in range(4)]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def chain(*matrices):
    out = identity()
    for matrix in matrices:
        out = product(out, matrix)
    return out


def inverse(m):
    """The inverse of an affine matrix."""
    a = [row[:3] for row in m[:3]]
    cofactor = [[a[(i + 1) % 3][(j + 1) % 3] * a[(i + 2) % 3][(j + 2) % 3]
                 - a[(i + 1) % 3][(j + 2) % 3] * a[(i + 2) % 3][(j + 1) % 3] for j in range(3)] for i in range(3)]
    scale = 1 / determinant(m)
    out = [[cofactor[j][i] * scale for j in range(3)] for i in range(3)]
    moved = [-sum(out[i][j] * m[j][3] for j in range(3)) for i in range(3)]
    return [out[i] + [moved[i]] for i in range(3)] + [[0.0, 0.0, 0.0, 1.0]]


def determinant(m):
    return sum(m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3])
               for i in range(3))


def translation(x, y, z):
    return [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z], [0.0, 0.0, 0.0, 1.0]]


def scaling(x, y, z):
    return [[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0], [0.0, 0.0, 0.0, 1.0]]


def rotation(axis, degrees):
    """A rotation about the axis 0, 1 or 2."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    out = identity()
    i, j = (axis + 1) % 3, (axis + 2) % 3
    out[i][i] = out[j][j] = c
    out[i][j], out[j][i] = -s, s
    return out


def of_quaternion(x, y, z, w):
    n = 1 / math.sqrt(x * x + y * y + z * z + w * w)
    x, y, z, w = x * n, y * n, z * n, w * n
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0.0],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0.0],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0.0], [0.0, 0.0, 0.0, 1.0]]


def quaternion(m):
    """x, y, z, w of a rotation."""
    trace = m[0][0] + m[1][1] + m[2][2]
    if trace > 0:
        w = math.sqrt(1 + trace) / 2
        return [(m[2][1] - m[1][2]) / (4 * w), (m[0][2] - m[2][0]) / (4 * w), (m[1][0] - m[0][1]) / (4 * w), w]
    i = max(range(3), key=lambda axis: m[axis][axis])
    j, k = (i + 1) % 3, (i + 2) % 3
    q = [0.0] * 4
    q[i] = math.sqrt(1 + m[i][i] - m[j][j] - m[k][k]) / 2
    q[j] = (m[j][i] + m[i][j]) / (4 * q[i])
    q[k] = (m[k][i] + m[i][k]) / (4 * q[i])
    q[3] = (m[k][j] - m[j][k]) / (4 * q[i])
    return q


def point(m, p):
    return [sum(m[i][j] * p[j] for j in range(3)) + m[i][3] for i in range(3)]


def columns(m):
    return [m[i][j] for j in range(4) for i in range(4)]


def of_columns(c):
    return [[float(c[4 * j + i]) for j in range(4)] for i in range(4)]

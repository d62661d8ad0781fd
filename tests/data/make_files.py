"""Makes the networks and meshes of tests/data/files, in the dialects that other programs write.

usage: make_files.py FOLDER

Everything is computed here from a fixed seed: nothing is taken from anybody's data.
"""

import math
import os
import random
import struct
import sys


def add(a, b, factor=1.0):
    return tuple(x + factor * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(x / length for x in a)


def in_rows(words, per_row):
    """As VTK writes: some entries a line, a blank after each."""
    return "".join(
        "".join(f"{word} " for word in words[i:i + per_row]) + "\n" for i in range(0, len(words), per_row))


def capillaries(folder, rng):
    """Binary polydata, float32, a radius per segment; six trunks, each with a branch; and the same as text."""
    node, edge, radius = [], [], []

    def grow(path, heading, n_step, r):
        """Goes on from the last node of `path`."""
        for _ in range(n_step):
            heading = unit(tuple(x + 0.25 * rng.gauss(0, 1) * scale for x, scale in zip(heading, (1, 1, 0.3))))
            node.append(add(node[path[-1]], heading, rng.uniform(0.4, 1.6) * r))
            edge.append((path[-1], len(node) - 1))
            radius.append(r * rng.uniform(0.9, 1.1))
            path.append(len(node) - 1)

    for i in range(6):
        r = 1.2 + 0.5 * i
        node.append((690 + 35 * (i % 3), 560 + 120 * (i // 3), 1880 + 4 * i))
        trunk = [len(node) - 1]
        grow(trunk, unit((rng.uniform(-1, 1), 1, 0)), 40, r)
        grow([trunk[18]], unit((1, rng.uniform(-1, 1), 0.1)), 18, 0.8 * r)
    with open(os.path.join(folder, "capillaries.vtk"), "wb") as file:
        file.write(b"# vtk DataFile Version 3.0\nvtk output\nBINARY\nDATASET POLYDATA\n")
        file.write(b"POINTS %d float\n" % len(node))
        file.write(b"".join(struct.pack(">3f", *x) for x in node))
        file.write(b"\nLINES %d %d\n" % (len(edge), 3 * len(edge)))
        file.write(b"".join(struct.pack(">3i", 2, *e) for e in edge))
        file.write(b"\nCELL_DATA %d\nFIELD FieldData 1\nradius 1 %d float\n" % (len(edge), len(edge)))
        file.write(b"".join(struct.pack(">f", r) for r in radius) + b"\n")
    single = lambda x: struct.unpack(">f", struct.pack(">f", x))[0]
    with open(os.path.join(folder, "capillaries.csv"), "w") as file:
        file.write("# nodes: id,x_um,y_um,z_um ; then edges: a,b,radius_um\n")
        file.write(f"NODES {len(node)}\n")
        for i, x in enumerate(node):
            file.write(f"{i},{single(x[0]):.4f},{single(x[1]):.4f},{single(x[2]):.4f}\n")
        file.write(f"EDGES {len(edge)}\n")
        for (a, b), r in zip(edge, radius):
            file.write(f"{a},{b},{single(r):.5f}\n")


def artery(folder, rng):
    """One chain as a tracer of voxels leaves it: steps much shorter than the radius, wiggles, a diameter at the nodes.
    Its first segment starts in the chain: node 0 is not an end."""
    n_node = 420
    at, node = (324.7, 176.988, 534.152), []
    for i in range(n_node):
        bend = (math.sin(i / 60), math.cos(i / 75), 1.2)
        at = add(at, unit(bend), 1.0)
        node.append(tuple(x + 0.2 * rng.uniform(-1, 1) for x in at))
    node[0], node[1] = node[1], node[0]
    edge = [(0, 1), (0, 2)] + [(i, i + 1) for i in range(2, n_node - 1)]
    diameter = [21.0 + 7.2 * (i // 30) / ((n_node - 1) // 30) for i in range(n_node)]
    with open(os.path.join(folder, "artery.vtk"), "w") as file:
        file.write("# vtk DataFile Version 4.2\nvtk output\nASCII\nDATASET POLYDATA\n")
        file.write(f"POINTS {n_node} float\n" + in_rows([f"{x:.6g}" for p in node for x in p], 9))
        file.write(f"LINES {len(edge)} {3 * len(edge)}\n" + "".join(f"2 {a} {b} \n" for a, b in edge))
        file.write(f"POINT_DATA {n_node}\nFIELD FieldData 1\ndiameter 1 {n_node} double\n")
        file.write(in_rows([f"{d:.11g}" for d in diameter], 9))


def icosphere(n_split):
    golden = (1 + math.sqrt(5)) / 2
    node = [unit(p) for p in ((-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0),
                              (0, -1, golden), (0, 1, golden), (0, -1, -golden), (0, 1, -golden),
                              (golden, 0, -1), (golden, 0, 1), (-golden, 0, -1), (-golden, 0, 1))]
    face = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
            (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
            (8, 6, 7), (9, 8, 1)]
    for _ in range(n_split):
        middle, split = {}, []
        for a, b, c in face:
            m = []
            for i, j in ((a, b), (b, c), (c, a)):
                key = (min(i, j), max(i, j))
                if key not in middle:
                    middle[key] = len(node)
                    node.append(unit(add(node[i], node[j])))
                m.append(middle[key])
            split += [(a, m[0], m[2]), (b, m[1], m[0]), (c, m[2], m[1]), tuple(m)]
        face = split
    return node, face


def body(rng, n_split, radius, centre):
    """A closed lumpy body, in metres as the file prints it."""
    node, face = icosphere(n_split)
    lumps = [(unit([rng.gauss(0, 1) for _ in range(3)]), rng.uniform(-0.15, 0.15)) for _ in range(5)]
    place = []
    for x in node:
        r = radius * (1 + sum(height * max(0.0, dot(x, to)) ** 2 for to, height in lumps))
        place.append(tuple(float(f"{value * 1e-6:.4e}") for value in add(centre, x, r)))
    return place, face


def measures(node, face):
    area = volume = 0.0
    for a, b, c in face:
        normal = cross(add(node[b], node[a], -1), add(node[c], node[a], -1))
        area += math.sqrt(dot(normal, normal)) / 2
        volume += dot(node[a], normal) / 6
    return area, volume


def polyhedra(path, bodies):
    """Unstructured grid of polyhedra (cell type 42) with the blocks that VTK 9 adds after each array."""
    node = [x for place, _ in bodies for x in place]
    largest = max(math.sqrt(dot(x, x)) for x in node)
    smallest = min(math.sqrt(dot(x, x)) for x in node)
    rows, first = [], 0
    for place, face in bodies:
        words = [len(face)] + [word for f in face for word in (3, *(first + i for i in f))]
        rows.append([len(words)] + words)
        first += len(place)
    found = [measures(*b) for b in bodies]
    arrays = [("cell_id", "int", range(len(bodies))), ("cell_area", "float", [f"{a:.4g}" for a, _ in found]),
              ("cell_volume", "float", [f"{v:.4g}" for _, v in found]), ("cell_is_static", "int", [0] * len(bodies))]
    with open(path, "w") as file:
        file.write("# vtk DataFile Version 4.2\nvtk output\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        file.write(f"POINTS {len(node)} float\n" + in_rows([f"{x:.5g}" for p in node for x in p], 9))
        file.write("METADATA\nINFORMATION 2\n")
        for name in ("L2_NORM_RANGE", "L2_NORM_FINITE_RANGE"):
            file.write(f"NAME {name} LOCATION vtkDataArray\nDATA 2 {smallest:.6g} {largest:.6g} \n")
        file.write(f"\nCELLS {len(bodies)} {sum(len(row) for row in rows)}\n")
        file.write("".join(" ".join(map(str, row)) + " \n" for row in rows))
        file.write(f"CELL_TYPES {len(bodies)}\n" + "42\n" * len(bodies))
        file.write(f"\nCELL_DATA {len(bodies)}\nFIELD FieldData {len(arrays)}\n")
        for name, kind, values in arrays:
            file.write(f"{name} 1 {len(bodies)} {kind}\n" + in_rows(list(values), 9) + "METADATA\nINFORMATION 0\n\n")


def main():
    folder, rng = sys.argv[1], random.Random(20)
    capillaries(folder, rng)
    artery(folder, rng)
    places = [(8.0 * i, 8.0 * j, 8.0 * k) for k in range(4) for j in range(2) for i in range(2)]
    polyhedra(os.path.join(folder, "aggregate.vtk"),
              [body(rng, 2 if i % 5 == 0 else 1, 4.5, place) for i, place in enumerate(places)])
    # Two faces that share an edge are gone from the second body: a hole of four edges.
    good, (node, face) = body(rng, 1, 10.0, (0, 0, 0)), body(rng, 1, 10.0, (20, 0, 0))
    shares = next(f for f in face[1:] if len(set(f) & set(face[0])) == 2)
    polyhedra(os.path.join(folder, "open_body.vtk"), [good, (node, [f for f in face[1:] if f != shares])])


main()

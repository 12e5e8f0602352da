"""The model of `carried` as OBJ, STL, PLY and OFF, by bytes."""

import struct

import numpy as np
from PIL import Image

from tests.scan.files.carried import (
    PICTURE,
    POLYGONS,
    TRIANGLES,
    V,
    colour_at,
    colour_towards,
    normals,
    uv_at,
)

_AWAY = np.array([50.0, 0, 0])
_TYPES = {"f4": "float", "u1": "uchar", "i4": "int"}


def rows(*parts):
    """Lines of numbers."""
    return "".join(" ".join(str(x) for x in row) + "\n" for part in parts for row in part)


def obj(folder, carries):
    """OBJ with colours of vertices, materials for faces, or a picture."""
    path = folder / "model.obj"
    colours = colour_at(V) / 255
    text = "# a model\nmtllib some colours.mtl\no one\n"
    for k, v in enumerate(V):
        text += "v " + rows([[*v, *colours[k]] if carries == "vertex colours" else v])
    text += "".join("vt " + rows([uv]) for uv in uv_at(V))
    materials = ""
    for k, (polygon, n) in enumerate(zip(POLYGONS, normals(POLYGONS), strict=True)):
        if carries == "face colours":
            text += f"usemtl side {k}\n"
            materials += f"newmtl side {k}\nKd " + rows([colour_towards(n) / 255])
        elif carries == "texture":
            text += "usemtl all\n"
        text += "f " + rows([[f"{i + 1}/{i + 1}" for i in polygon]])
    if carries == "several bodies":
        text += "o other\n" + "".join("v " + rows([v]) for v in V + _AWAY)
        text += "".join("f " + rows([[i - len(V) for i in polygon]]) for polygon in POLYGONS)
    if carries == "texture":
        materials = "newmtl all\nmap_Kd picture.png\n"
        Image.fromarray(PICTURE).save(folder / "picture.png")
    (folder / "some colours.mtl").write_text(materials)
    path.write_text(text)
    return path


def stl(folder, carries):
    """STL of text, two solids, or binary with colours as VisCAM has them."""
    path = folder / "model.stl"
    if carries == "several bodies":
        corners = [V[TRIANGLES], V[TRIANGLES] + _AWAY]
        path.write_text(
            "".join(f"solid {k}\n{_facets(part)}endsolid {k}\n" for k, part in enumerate(corners))
        )
        return path
    red, green, blue = (colour_towards(normals(TRIANGLES)) // 8).astype(int).T
    more = 1 << 15 | red << 10 | green << 5 | blue
    data = bytes(80) + struct.pack("<I", len(TRIANGLES))
    for corners, colour in zip(V[TRIANGLES], more, strict=True):
        data += struct.pack("<12fH", 0, 0, 0, *corners.ravel(), colour)
    path.write_bytes(data)
    return path


def ply(order):
    """PLY as text, or of an order of bytes."""

    def write(folder, carries):
        path = folder / "model.ply"
        vertices, faces = [("f4", "xyz", V)], []
        polygons = POLYGONS
        if carries == "several bodies":
            vertices[0] = ("f4", "xyz", np.concatenate([V, V + _AWAY]))
            polygons = [*POLYGONS, *([i + len(V) for i in polygon] for polygon in POLYGONS)]
        if carries == "vertex colours":
            vertices.append(("u1", ["diffuse_red", "diffuse_green", "diffuse_blue"], colour_at(V)))
        if carries == "face colours":
            faces.append(("f4", ["red", "green", "blue"], colour_towards(normals(POLYGONS)) / 255))
        lists, picture = {"vertex_indices": ("i4", polygons)}, ""
        if carries == "texture":
            Image.fromarray(PICTURE).save(folder / "picture.png")
            picture = "comment TextureFile picture.png\n"
            lists["texcoord"] = ("f4", [uv_at(V[polygon]).ravel() for polygon in polygons])
        name = {"": "ascii", "<": "binary_little_endian", ">": "binary_big_endian"}[order]
        head = f"ply\nformat {name} 1.0\n{picture}element vertex {len(vertices[0][2])}\n"
        head += "".join(f"property {_TYPES[kind]} {x}\n" for kind, names, _ in vertices for x in names)
        head += f"element face {len(polygons)}\n"
        head += "".join(f"property list uchar {_TYPES[kind]} {key}\n" for key, (kind, _) in lists.items())
        head += "".join(f"property {_TYPES[kind]} {x}\n" for kind, names, _ in faces for x in names)
        data = (head + "end_header\n").encode()
        for k in range(len(vertices[0][2])):
            data += _row(order, [(kind, values[k]) for kind, _, values in vertices])
        for k in range(len(polygons)):
            cells = []
            for kind, values in lists.values():
                cells += [("u1", [len(values[k])]), (kind, values[k])]
            data += _row(order, [*cells, *((kind, values[k]) for kind, _, values in faces)])
        path.write_bytes(data)
        return path

    return write


def off(folder, carries):
    """OFF with colours of vertices as whole numbers, or of faces as real ones."""
    path = folder / "model.off"
    vertices, polygons = V.tolist(), POLYGONS
    if carries == "several bodies":
        vertices = vertices + (V + _AWAY).tolist()
        polygons = [*POLYGONS, *([i + len(V) for i in polygon] for polygon in POLYGONS)]
    word = "OFF"
    if carries == "vertex colours":
        word, vertices = "COFF", [[*v, *c, 255] for v, c in zip(vertices, colour_at(V), strict=True)]
    faces = [[len(polygon), *polygon] for polygon in polygons]
    if carries == "face colours":
        shown = colour_towards(normals(POLYGONS)) / 255
        faces = [[*face, *(f"{x:.4f}" for x in c)] for face, c in zip(faces, shown, strict=True)]
    path.write_text(f"{word} # a model\n\n{len(vertices)} {len(faces)} 0\n" + rows(vertices, faces))
    return path


def _facets(corners):
    return "".join(
        "facet normal 0 0 0\n  outer loop\n"
        + "".join("    vertex " + rows([v]) for v in triangle)
        + "  endloop\nendfacet\n"
        for triangle in corners
    )


def _row(order, cells):
    if not order:
        return rows([[x for _, values in cells for x in values]]).encode()
    return b"".join(np.array(values).astype(order + kind).tobytes() for kind, values in cells)

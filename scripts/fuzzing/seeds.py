"""Small sound files of every kind, made by bytes and by libraries."""

import io
import zipfile

import numpy as np
import trimesh

__all__ = ["KINDS", "unhurt"]

KINDS = ("obj", "stl", "ply", "off", "glb", "3mf", "svg", "toml")

_TOML = b"""pieces = 12
size = 80.0
layout = "cells"
style = "quad"
format = ["stl", "3mf"]
viewer = false
clearance = 0.15
process = "mine"

[processes.mine]
thickness = 2.0
min_wall = 1.0
"""
_SVG = b"""<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 40 40">
  <style>.knob { fill: none; stroke: #000 }</style>
  <defs><path id="k" d="M 0 0 L 4 0 C 3 -3 7 -3 6 0 L 10 0"/></defs>
  <g transform="translate(5 5) scale(2)">
    <use xlink:href="#k" class="knob"/>
  </g>
</svg>
"""
_MODEL = """<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US"
  xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
  xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02">
<resources>
<m:colorgroup id="5"><m:color color="#FF0000"/><m:color color="#00FF00"/></m:colorgroup>
<object id="1" type="model" pid="5" pindex="0"><mesh><vertices>
{vertices}
</vertices><triangles>
{triangles}
</triangles></mesh></object>
<object id="2" type="model"><components>
<component objectid="1"/><component objectid="1" transform="1 0 0 0 1 0 0 0 1 60 0 0"/>
</components></object>
</resources>
<build><item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 5"/></build>
</model>
"""
_PACKAGE = {
    "[Content_Types].xml": '<?xml version="1.0" encoding="UTF-8"?>\n<Types xmlns="http://schemas.openxmlformats'
    '.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-'
    'package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.'
    '3dmanufacturing-3dmodel+xml"/></Types>',
    "_rels/.rels": '<?xml version="1.0" encoding="UTF-8"?>\n<Relationships xmlns="http://schemas.openxmlformats'
    '.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.'
    'microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>',
}


def unhurt(kind: str) -> list[bytes]:
    """Give sound files of a kind, in its variants."""
    if kind in ("svg", "toml"):
        return [{"svg": _SVG, "toml": _TOML}[kind]]
    ball = trimesh.creation.icosphere(subdivisions=2, radius=25.0)
    V, F = np.asarray(ball.vertices), np.asarray(ball.faces)
    if kind == "obj":
        return [_obj(V, F)]
    if kind == "stl":
        return [ball.export(file_type="stl"), ball.export(file_type="stl_ascii").encode()]
    if kind == "off":
        return [ball.export(file_type="off").encode()]
    ball.visual.vertex_colors = np.rint(np.c_[(V + 25) * 5.1, np.full(len(V), 255)]).astype(np.uint8)
    if kind == "ply":
        return [ball.export(file_type="ply", encoding=encoding) for encoding in ("ascii", "binary")]
    if kind == "glb":
        other = ball.copy().apply_translation([60, 0, 0])
        return [trimesh.Scene([ball, other]).export(file_type="glb")]
    return [_3mf(V, F)]


def _obj(V: np.ndarray, F: np.ndarray) -> bytes:
    """Quads where two faces follow each other would be nicer; a polygon, UVs and normals must do."""
    lines = ["o ball", "g all", "usemtl red"]
    lines += ["v {:.6g} {:.6g} {:.6g}".format(*v) for v in V.tolist()]
    lines += ["vt {:.4f} {:.4f}".format(*(v[:2] / 50 + 0.5).tolist()) for v in V]
    lines += ["vn {:.4f} {:.4f} {:.4f}".format(*(v / 25).tolist()) for v in V]
    lines += ["f " + " ".join(f"{i}/{i}/{i}" for i in face) for face in (F + 1).tolist()]
    return ("\n".join(lines) + "\n").encode()


def _3mf(V: np.ndarray, F: np.ndarray) -> bytes:
    vertices = "\n".join('<vertex x="{:.6g}" y="{:.6g}" z="{:.6g}"/>'.format(*v) for v in V.tolist())
    triangles = "\n".join('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*f) for f in F.tolist())
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in _PACKAGE.items():
            archive.writestr(name, text)
        archive.writestr("3D/3dmodel.model", _MODEL.format(vertices=vertices, triangles=triangles))
    return data.getvalue()

"""The model of `carried` as glTF, GLB and 3MF, by bytes; none of them has polygons."""

import io

import numpy as np
from PIL import Image

from tests.scan.files.carried import (
    PICTURE,
    TRIANGLES,
    V,
    colour_at,
    colour_towards,
    normals,
    uv_at,
)
from tests.scan.files.gltf.build import Build
from tests.scan.files.three_mf.build import TEXTURE, mesh, model, package

_AWAY = np.array([50.0, 0, 0])
_SIDES = colour_towards(normals(TRIANGLES))


def _linear(rgb):
    c = np.asarray(rgb) / 255
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def _scene(folder, carries):
    F, more = np.array(TRIANGLES), {}
    build = Build()
    if carries == "vertex colours":
        more = {"COLOR_0": build.array(_linear(colour_at(V)).astype("f4"))}
    if carries == "face colours":  # a part a colour, as glTF has none for faces
        colours, number = np.unique(_SIDES, axis=0, return_inverse=True)
        parts = [
            build.part(
                V, F[number == k], {"material": build.material(baseColorFactor=[*_linear(c).tolist(), 1])}
            )
            for k, c in enumerate(colours)
        ]
        return build.scene(*parts)
    if carries == "texture":
        uv = (uv_at(V) * (1, -1) + (0, 1)).astype("f4")
        return build.scene(build.part(V, F, {"material": build.texture(PICTURE)}, TEXCOORD_0=build.array(uv)))
    build.scene(build.part(V, F, **more))
    if carries == "several bodies":
        build.header["nodes"] = [{"mesh": 0}, {"mesh": 0, "translation": _AWAY.tolist()}]
        build.header["scenes"] = [{"nodes": [0, 1]}]
    return build


def glb(folder, carries):
    """GLB with colours of vertices, materials for faces, or a picture inside it."""
    return _scene(folder, carries).glb(folder / "model.glb")


def gltf(folder, carries):
    """The same as text, with its buffer in a file beside it."""
    build = _scene(folder, carries)
    (folder / "the buffer.bin").write_bytes(build.data)
    return build.gltf(folder / "model.gltf", "the%20buffer.bin")


def three_mf(folder, carries):
    """3MF in inches with a colour group, base materials, or a texture."""
    resources, words, items, more = "", None, '<item objectid="1"/>', {}
    if carries == "vertex colours":
        rows = "".join('<m:color color="#{:02X}{:02X}{:02X}"/>'.format(*c) for c in colour_at(V))
        resources = f'<m:colorgroup id="5">{rows}</m:colorgroup>'
        words = ['pid="5" p1="{}" p2="{}" p3="{}"'.format(*t) for t in TRIANGLES]
    if carries == "face colours":
        rows = "".join('<base name="a" displaycolor="#{:02X}{:02X}{:02X}"/>'.format(*c) for c in _SIDES)
        resources = f'<basematerials id="5">{rows}</basematerials>'
        words = [f'pid="5" p1="{k}"' for k in range(len(TRIANGLES))]
    if carries == "texture":
        rows = "".join('<m:tex2coord u="{}" v="{}"/>'.format(*place) for place in uv_at(V))
        resources = '<m:texture2d id="4" path="/3D/Textures/p.png" contenttype="image/png"/>'
        resources += f'<m:texture2dgroup id="5" texid="4">{rows}</m:texture2dgroup>'
        words = ['pid="5" p1="{}" p2="{}" p3="{}"'.format(*t) for t in TRIANGLES]
        buffer = io.BytesIO()
        Image.fromarray(PICTURE).save(buffer, "PNG")
        more = {
            "files": {"3D/Textures/p.png": buffer.getvalue()},
            "links": [("3D/Textures/p.png", TEXTURE)],
        }
    if carries == "several bodies":
        items += '<item objectid="1" transform="1 0 0 0 1 0 0 0 1 50 0 0"/>'
    text = model(resources + mesh(1, TRIANGLES, properties=words, V=V), items, unit="inch")
    return package(folder / "model.3mf", text, **more)

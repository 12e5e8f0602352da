"""3MF files made by bytes: small ones, of whatever kind a test wants."""

import zipfile

import numpy as np

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
MORE = "http://schemas.microsoft.com/3dmanufacturing/material/2015/02"
PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
SLICER = "http://schemas.slic3r.org/3mf/2017/06"
TYPES = """<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="png" ContentType="image/png"/>
<Default Extension="config" ContentType="text/xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>"""
RELATIONS = '<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
MODEL = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
TEXTURE = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dtexture"
TETRAHEDRON = np.array([[0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10]], float)
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])


def mesh(number, faces=FACES, more="", properties=None, V=TETRAHEDRON):
    """Write an object; properties are the words that each triangle has beside its corners."""
    corners = "".join('<vertex x="{:g}" y="{:g}" z="{:g}"/>'.format(*v) for v in V)
    words = properties or [""] * len(faces)
    rows = "".join(
        '<triangle v1="{}" v2="{}" v3="{}" {}/>'.format(*face, word)
        for face, word in zip(np.asarray(faces).tolist(), words, strict=True)
    )
    return (
        f'<object id="{number}" type="model" {more}><mesh><vertices>{corners}</vertices>'
        f"<triangles>{rows}</triangles></mesh></object>"
    )


def placed(number, parts, more=""):
    """Write an object of components, each the words of one."""
    inside = "".join(f"<component {part}/>" for part in parts)
    return f'<object id="{number}" type="model" {more}><components>{inside}</components></object>'


def model(resources, items='<item objectid="1"/>', unit="millimeter", required=""):
    return (
        f'<?xml version="1.0" encoding="UTF-8"?><model unit="{unit}" xml:lang="en-US" xmlns="{CORE}"'
        f' xmlns:m="{MORE}" xmlns:p="{PRODUCTION}" xmlns:slic3rpe="{SLICER}" {required}>'
        f"<resources>{resources}</resources><build>{items}</build></model>"
    )


def related(target, kind, number=0):
    return f'<Relationship Id="r{number}" Target="/{target}" Type="{kind}"/>'


def package(path, text, files=None, links=()):
    """Write a 3MF; links are of the model to pictures and to other models."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("[Content_Types].xml", TYPES)
        archive.writestr("_rels/.rels", RELATIONS + related("3D/m.model", MODEL) + "</Relationships>")
        archive.writestr("3D/m.model", text)
        if links:
            inside = "".join(related(target, kind, k) for k, (target, kind) in enumerate(links))
            archive.writestr("3D/_rels/m.model.rels", RELATIONS + inside + "</Relationships>")
        for name, data in (files or {}).items():
            archive.writestr(name, data)
    return path

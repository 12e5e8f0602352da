"""glTF files made by bytes: small ones, of whatever kind a test wants."""

import base64
import io
import json
import struct

import numpy as np
from PIL import Image

KINDS = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
WIDTHS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
TETRAHEDRON = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "f4")
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], "u4")


class Build:
    """A glTF file in the making; its header is a dict, to be changed at will."""

    def __init__(self, **header):
        self.data = b""
        self.header = {"asset": {"version": "2.0"}, "bufferViews": [], "accessors": [], **header}

    def view(self, data, **more):
        self.data += bytes(-len(self.data) % 4)
        self.header["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)} | more
        )
        self.data += bytes(data)
        return len(self.header["bufferViews"]) - 1

    def array(self, values, **more):
        values = np.asarray(values)
        width = 1 if values.ndim == 1 else values.shape[1]
        accessor = {
            "bufferView": self.view(values.tobytes()),
            "componentType": KINDS[values.dtype.str[1:]],
            "count": len(values),
            "type": WIDTHS[width],
        }
        return self.accessor(accessor | more)

    def accessor(self, accessor):
        self.header["accessors"].append(accessor)
        return len(self.header["accessors"]) - 1

    def part(self, V=TETRAHEDRON, F=FACES, more=None, **attributes):
        """Make a primitive; attributes are numbers of accessors."""
        return {
            "attributes": {"POSITION": self.array(np.asarray(V, "f4")), **attributes},
            "indices": self.array(np.asarray(F, "u4").ravel()),
            **(more or {}),
        }

    def scene(self, *parts):
        """Have one node show a mesh of these parts."""
        self.header |= {"meshes": [{"primitives": list(parts)}], "nodes": [{"mesh": 0}], "scene": 0}
        self.header["scenes"] = [{"nodes": [0]}]
        return self

    def texture(self, pixels, **more):
        """Add a picture and its texture; give the number of a material that shows it."""
        buffer = io.BytesIO()
        Image.fromarray(np.asarray(pixels, np.uint8)).save(buffer, "PNG")
        images = self.header.setdefault("images", [])
        images.append({"bufferView": self.view(buffer.getvalue()), "mimeType": "image/png"})
        textures = self.header.setdefault("textures", [])
        textures.append({"source": len(images) - 1})
        return self.material(baseColorTexture={"index": len(textures) - 1} | more)

    def material(self, **pbr):
        materials = self.header.setdefault("materials", [])
        materials.append({"pbrMetallicRoughness": pbr})
        return len(materials) - 1

    def glb(self, path):
        self.header["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.header).encode()
        text += b" " * (-len(text) % 4)
        body = struct.pack("<I4s", len(text), b"JSON") + text
        body += struct.pack("<I4s", len(self.data), b"BIN\0") + self.data
        path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)
        return path

    def gltf(self, path, uri=None):
        """Write as text; the buffer is in it unless it has a name of its own."""
        uri = uri or "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        self.header["buffers"] = [{"byteLength": len(self.data), "uri": uri}]
        path.write_text(json.dumps(self.header))
        return path

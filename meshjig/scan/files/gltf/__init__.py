"""glTF and GLB, as their standard has them."""

from meshjig.scan.files.gltf.read import read_gltf

__all__ = ["read_gltf"]

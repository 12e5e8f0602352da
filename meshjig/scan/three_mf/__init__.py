"""3MF files, opened by lib3mf and read as their standard has them."""

from meshjig.scan.three_mf.package import mesh_arrays, open_3mf
from meshjig.scan.three_mf.read import read_3mf_source

__all__ = ["mesh_arrays", "open_3mf", "read_3mf_source"]

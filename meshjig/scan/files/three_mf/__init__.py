"""3MF files, opened by lib3mf and read as their standard has them."""

from meshjig.scan.files.three_mf.package import matrix_of, mesh_arrays, open_3mf, unit_of
from meshjig.scan.files.three_mf.read import read_3mf_source

__all__ = ["matrix_of", "mesh_arrays", "open_3mf", "read_3mf_source", "unit_of"]

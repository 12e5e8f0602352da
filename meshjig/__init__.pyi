"""What type checkers see of meshjig; __init__.py loads the same names when they are first used."""

from meshjig import check as check
from meshjig.cells import cell_atlas as cell_atlas
from meshjig.cells import grow_cells as grow_cells
from meshjig.cells import knob_outlines as knob_outlines
from meshjig.charts import MappedAtlas as MappedAtlas
from meshjig.charts import build_atlas as build_atlas
from meshjig.cut import overlay as overlay
from meshjig.errors import ChartError as ChartError
from meshjig.errors import CutError as CutError
from meshjig.errors import InputError as InputError
from meshjig.errors import MeshjigError as MeshjigError
from meshjig.errors import OptionError as OptionError
from meshjig.errors import OutputError as OutputError
from meshjig.errors import ResourceError as ResourceError
from meshjig.errors import SolidError as SolidError
from meshjig.fleet.batch import batch as batch
from meshjig.fleet.settings import BatchSettings as BatchSettings
from meshjig.layout.stitch import stitch as stitch
from meshjig.mesh.types import Atlas as Atlas
from meshjig.mesh.types import CutMesh as CutMesh
from meshjig.mesh.types import Mesh as Mesh
from meshjig.mesh.types import Outlines as Outlines
from meshjig.options import Options as Options
from meshjig.pipeline.make import make_puzzle as make_puzzle
from meshjig.pipeline.prepare import atlas as atlas
from meshjig.puzzle import Piece as Piece
from meshjig.puzzle import Puzzle as Puzzle
from meshjig.scan import read_scan as read_scan
from meshjig.scan import repair as repair
from meshjig.solid import displacement as displacement
from meshjig.solid import kerf as kerf
from meshjig.solid import shell as shell
from meshjig.solid import solidify as solidify
from meshjig.tiling import tile_charts as tile_charts
from meshjig.tiling.registry import get_family as get_family

__version__: str

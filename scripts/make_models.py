"""Make the models in data/: shapes computed here, nothing downloaded."""

from pathlib import Path

from models.bridge import bridge
from models.duck import duck
from models.limb import limb
from models.teapot import teapot
from models.vases import slender_vase, vase

DATA = Path(__file__).parent.parent / "data"
MODELS = (vase, limb, duck, bridge, teapot, slender_vase)

if __name__ == "__main__":
    DATA.mkdir(exist_ok=True)
    for model in MODELS:
        model().export(DATA / f"{model.__name__}.ply")

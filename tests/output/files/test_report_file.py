import json
from pathlib import Path

import numpy as np

from meshjig.output.files.report_file import write_report


def test_report_is_plain_json_in_the_order_given(tmp_path):
    report = {
        "meshjig": "0.1.0",
        "z": np.int64(3),
        "a": np.float32(0.1),
        "nested": {"bad": float("nan"), "worse": np.inf, "yes": np.bool_(True), "none": None},
        "rows": np.array([[1.0, np.nan]]),
        "many": ({2, 1}, (Path("x") / "y",)),
        3: 1 / 3,
        "tiny": 1.23456789e-12,
        "text": "Büste",
    }
    write_report(tmp_path / "report.json", report)
    read = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert list(read) == ["meshjig", "z", "a", "nested", "rows", "many", "3", "tiny", "text"]
    assert read["z"] == 3
    assert read["a"] == 0.1
    assert read["nested"] == {"bad": None, "worse": None, "yes": True, "none": None}
    assert read["rows"] == [[1.0, None]]
    assert read["many"] == [[1, 2], ["x/y"]]
    assert read["3"] == 0.3333333
    assert read["tiny"] == 1.234568e-12
    assert read["text"] == "Büste"

"""`python -m xsec_sym.study draw FOLDER` draws every stored measurement; `measure [NAME...]` makes them anew."""

from __future__ import annotations

import sys
import time
from pathlib import Path

from xsec_sym.record.files import writing
from xsec_sym.study import files
from xsec_sym.study.method import HOMES


def draw(folder: str) -> None:
    Path(folder).mkdir(parents=True, exist_ok=True)
    for name in HOMES:
        data = files.stored(name)
        files.write(data, Path(folder) / f"{name}.png", ".png")
        files.write(data, Path(folder) / f"{name}_stability.png", ".png", stability=True)
        print(name)


def measure(names: list[str]) -> None:
    for name in names or HOMES:
        start = time.perf_counter()
        data = files.measured(name, jobs=-1)
        with writing(files.DATA / f"{name}.json") as out:
            out.write(files.text(data))
        print(f"{name}: {time.perf_counter() - start:.0f} s", flush=True)


if __name__ == "__main__":
    match sys.argv[1:]:
        case ["draw", folder]:
            draw(folder)
        case ["measure", *names]:
            measure(names)
        case _:
            sys.exit(__doc__)

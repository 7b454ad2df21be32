"""Files that are either written whole or not at all, and JSON that can be read as a diff."""

from __future__ import annotations

import contextlib
import json
import math
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TextIO

WIDTH = 110


@contextlib.contextmanager
def writing(path: str | Path) -> Iterator[TextIO]:
    """Open ``path`` for text that appears there only when the block ends well.

    What cannot be written fails with OSError at once, before any work is done for it.

    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with writing(Path(folder) / "a.txt") as out:
    ...         _ = out.write("whole")
    ...     (Path(folder) / "a.txt").read_text()
    'whole'
    """
    target = Path(path).resolve()
    if target.is_dir():
        raise IsADirectoryError(f"{path} is a folder")
    if target.exists() and not target.is_file():
        # a device or a pipe cannot be replaced, only written to
        with target.open("w", encoding="utf-8") as out:
            yield out
        return
    if target.exists() and not os.access(target, os.W_OK):
        raise PermissionError(f"{path} is write-protected")
    mask = os.umask(0)
    os.umask(mask)
    mode = target.stat().st_mode & 0o777 if target.exists() else 0o666 & ~mask
    handle, name = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent, text=True)
    try:
        with open(handle, "w", encoding="utf-8") as out:
            yield out
        os.chmod(name, mode)
        os.replace(name, target)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(name)
        raise


def plain(value: Any) -> Any:
    """The same as JSON can hold it: tuples as lists, numbers finite, anything else by its name.

    >>> plain({"x": (1, float("inf"), 1 + 2j)})
    {'x': [1, 'inf', '(1+2j)']}
    """
    if isinstance(value, dict):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple | set | frozenset):
        return [plain(v) for v in value]
    if value is None or isinstance(value, bool | str):
        return value
    if type(value) is int or (type(value) is float and math.isfinite(value)):
        return value
    return str(value)


def layout(value: Any, depth: int = 3, indent: int = 0) -> str:
    """JSON with a line for each thing that may change by itself: what fits stays on one line.

    >>> print(layout({"a": [1, 2], "b": {"c": "d"}}))
    {
     "a": [1, 2],
     "b": {"c": "d"}
    }
    """
    flat = json.dumps(value, ensure_ascii=False, allow_nan=False)
    if depth == 0 or not value or not isinstance(value, dict | list):
        return flat
    if len(flat) + indent <= WIDTH and indent:
        return flat
    inner = "\n" + " " * (indent + 1)
    if isinstance(value, dict):
        body = [f"{json.dumps(k, ensure_ascii=False)}: {layout(v, depth - 1, indent + 1)}" for k, v in value.items()]
        return "{" + inner + f",{inner}".join(body) + "\n" + " " * indent + "}"
    body = [layout(v, depth - 1, indent + 1) for v in value]
    return "[" + inner + f",{inner}".join(body) + "\n" + " " * indent + "]"

"""Every notebook runs from a fresh kernel without an error or a warning, and is stored without outputs."""

import ast
import asyncio
from pathlib import Path

import matplotlib.font_manager  # noqa: F401  (makes the cache of fonts, which a first import tells of on stderr)
import nbformat
import pytest
from nbclient import NotebookClient

NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("*.ipynb"))
SECONDS = 100  # each takes 9 to 14 alone; more than this means that something hangs

each_notebook = pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)


def code_cells(notebook):
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def test_there_are_notebooks():
    assert NOTEBOOKS


@each_notebook
def test_stored_without_outputs(path):
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    assert notebook.metadata.kernelspec.name == "python3"
    assert all(not cell.outputs and cell.execution_count is None for cell in code_cells(notebook))


@each_notebook
def test_runs_cleanly(path):
    notebook = nbformat.read(path, as_version=4)
    client = NotebookClient(notebook, kernel_name="python3", resources={"metadata": {"path": str(path.parent)}})
    # a cell that raises ends the run with its traceback
    asyncio.run(asyncio.wait_for(client.async_execute(), SECONDS))
    cells = [cell for cell in code_cells(notebook) if cell.source.strip()]
    assert cells and all(cell.execution_count for cell in cells)
    outputs = [output for cell in cells for output in cell.outputs]
    assert [o for o in outputs if o.output_type == "error"] == []
    assert [o.text for o in outputs if o.output_type == "stream" and o.name == "stderr"] == []
    shown = [output.data for output in outputs if output.output_type in ("display_data", "execute_result")]
    assert any("image/png" in data for data in shown)
    # a figure that only says that it is one was not drawn: nothing made Jupyter show figures
    assert [
        data["text/plain"] for data in shown if data.keys() == {"text/plain"} and "<Figure" in data["text/plain"]
    ] == []


@each_notebook
def test_every_cell_that_computes_asserts(path):
    """Itself, or by a function of the notebook that does; the first one imports."""
    trees = [ast.parse(cell.source) for cell in code_cells(nbformat.read(path, as_version=4))]
    helpers = set()

    def asserts(node):
        return any(
            isinstance(n, ast.Assert)
            or (isinstance(n, ast.Attribute) and n.attr.startswith("assert_"))
            or (isinstance(n, ast.Name) and n.id in helpers)
            for n in ast.walk(node)
        )

    helpers |= {n.name for tree in trees for n in tree.body if isinstance(n, ast.FunctionDef) and asserts(n)}
    assert [ast.unparse(tree)[:60] for tree in trees[1:] if not asserts(tree)] == []


def test_they_are_one_story():
    """Each leads to the one after it and back to the one before it, and says what to take away."""
    for number, path in enumerate(NOTEBOOKS):
        first, *_, last = (cell.source for cell in nbformat.read(path, as_version=4).cells)
        assert f"*Notebook {number + 1} of {len(NOTEBOOKS)}*" in first and "**The story" in first
        assert "## What to take away" in last
        for neighbour in NOTEBOOKS[max(number - 1, 0) : number] + NOTEBOOKS[number + 1 : number + 2]:
            assert f"({neighbour.name})" in first and f"({neighbour.name})" in last

"""The gallery: each example is run for its picture, which stands with its text and code."""

import ast
import base64
import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from itertools import repeat
from pathlib import Path
from typing import Any

from user_forces.values.value import InputError

TOP = """# Gallery

Each picture is made by the script below it when this page is built. Copy a script and run it: it writes its
picture into the folder where you are.
"""


def scripts(examples: Path) -> list[Path]:
    """The examples in a folder: scripts, and notebooks."""
    found = [*examples.glob("*.py"), *examples.glob("*.ipynb")]
    return sorted(path for path in found if path.stem != "__init__")


def gallery_page(examples: Path, pictures: Path, workers: int = 2) -> str:
    """Run the examples, and show them on a page of Markdown.

    Arguments:
        examples: folder of the scripts; each writes a picture with its own name.
        pictures: folder for the pictures, next to the page.
        workers: so many scripts at a time.

    Raises InputError that names the script if one fails or draws nothing.
    """
    pictures.mkdir(parents=True, exist_ok=True)
    found = scripts(examples)
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(run_example, found, repeat(pictures)))
    return (
        "\n\n".join([TOP, *(_section(script, f"{pictures.name}/{script.stem}.png") for script in found)]) + "\n"
    )


def run_example(script: Path, folder: Path) -> None:
    """Run a script, or a notebook, in a folder, where its picture is then.

    Raises InputError if it fails, or if there is no picture with the script's name.
    """
    picture = folder / f"{script.stem}.png"
    if script.suffix == ".ipynb":
        _run_notebook(script, folder, picture)
        reason = "no cell of it shows a picture"
    else:
        done = subprocess.run(
            [sys.executable, str(script)], cwd=folder, capture_output=True, text=True, check=False
        )
        reason = done.stderr.strip() if done.returncode else "it wrote no picture of its name"
        if done.returncode:
            picture.unlink(missing_ok=True)
    if not picture.is_file():
        raise InputError(f"{script.name}: {reason}; allowed: a script that runs and writes {picture.name}")


def _run_notebook(script: Path, folder: Path, picture: Path) -> None:
    """Run all cells of a notebook; its last picture is kept."""
    import nbformat
    from nbclient import NotebookClient
    from nbclient.exceptions import CellExecutionError

    notebook = nbformat.read(script, as_version=4)
    try:
        NotebookClient(
            notebook,
            timeout=300,
            resources={"metadata": {"path": str(folder)}},
            extra_arguments=["--IPKernelApp.log_level=40"],  # its warnings are not about the notebook
        ).execute()
    except CellExecutionError as error:
        raise InputError(f"{script.name}: {error}; allowed: a notebook whose cells run") from error
    for cell in notebook.cells:
        for output in cell.get("outputs", ()):
            if data := output.get("data", {}).get("image/png"):
                picture.write_bytes(base64.b64decode(data))


def _section(script: Path, picture: str) -> str:
    """Title, text, picture and code of an example, Markdown."""
    text = script.read_text(encoding="utf-8")
    if script.suffix == ".ipynb":
        cells: list[dict[str, Any]] = json.loads(text)["cells"]
        first = next("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
        title, _, rest = first.removeprefix("# ").partition("\n")
        code = "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
    else:
        title, _, rest = (ast.get_docstring(ast.parse(text)) or "").partition("\n")
        code = text.partition('"""\n\n')[2]
    code = f"```python\n# {script.name}\n{code.strip()}\n```"
    return "\n\n".join([f"## {title}", rest.strip(), f"![{title}]({picture})", code])

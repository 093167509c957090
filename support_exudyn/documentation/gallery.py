"""The examples: each is run for its picture, and told with its text."""

import ast
import base64
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
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
    """Run the examples, and tell of them on a page of Markdown.

    Arguments:
        examples: folder of the scripts; each writes a picture with its own name.
        pictures: folder for the pictures, beside the page.
        workers: so many scripts at a time.

    Raises InputError that names the script if one fails or draws nothing.
    """
    pictures.mkdir(parents=True, exist_ok=True)

    def told(script: Path) -> str:
        run_example(script, pictures)
        return "\n\n".join(_told(script, f"{pictures.name}/{script.stem}.png"))

    with ThreadPoolExecutor(workers) as pool:
        parts = list(pool.map(told, scripts(examples)))
    return "\n\n".join([TOP, *parts]) + "\n"


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
            extra_arguments=["--IPKernelApp.log_level=40"],  # of its warnings none is of the notebook
        ).execute()
    except CellExecutionError as error:
        raise InputError(f"{script.name}: {error}; allowed: a notebook whose cells run") from error
    for cell in notebook.cells:
        for output in cell.get("outputs", ()):
            if data := output.get("data", {}).get("image/png"):
                picture.write_bytes(base64.b64decode(data))


def _told(script: Path, picture: str) -> Iterator[str]:
    """Title, text, picture and code of an example."""
    if script.suffix == ".ipynb":
        import json

        cells: list[dict[str, Any]] = json.loads(script.read_text(encoding="utf-8"))["cells"]
        texts = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"]
        title, _, rest = texts[0].removeprefix("# ").partition("\n")
        code = "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
    else:
        text = script.read_text(encoding="utf-8")
        title, _, rest = (ast.get_docstring(ast.parse(text)) or "").partition("\n")
        code = text.partition('"""\n\n')[2]
    yield f"## {title}"
    yield rest.strip()
    yield f"![{title}]({picture})"
    yield f"```python\n# {script.name}\n{code.strip()}\n```"

"""Runs for other programs: moving meshes for ParaView, channels for tables, MATLAB and the like.

    from support_exudyn.postprocessing.export.export import Sampling, to_csv, to_hdf5, to_vtu, to_xdmf

    to_xdmf(result, "rise.xdmf", Sampling(frames_per_second=25))

Everything is in SI; names of fields and columns end in their unit. What is written are records of the run with
their times, nothing between them.
"""

from __future__ import annotations

from pathlib import Path

import h5py

from support_exudyn.formulations.progress import Progress, silent
from support_exudyn.postprocessing.export import vtu, xdmf
from support_exudyn.postprocessing.export.channels_hdf5 import write_channels
from support_exudyn.postprocessing.export.machine_mesh import MachineMesh
from support_exudyn.postprocessing.export.mesh_series import MeshSeries
from support_exudyn.postprocessing.export.names import Named, write_names
from support_exudyn.postprocessing.export.pin_points import PinPoints
from support_exudyn.postprocessing.export.sampling import Sampling
from support_exudyn.postprocessing.export.tables import write_csv
from support_exudyn.postprocessing.export.whole_set import whole_set
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

__all__ = ["MESHES", "TABLES", "Sampling", "to_csv", "to_hdf5", "to_vtu", "to_xdmf"]

MESHES = Sampling(frames_per_second=25.0)
TABLES = Sampling()
MOST_VALUES = 500_000_000  # in the HDF5 file of an XDMF; 4 GB before compression


def to_xdmf(
    result: Result, path: str | Path, sampling: Sampling = MESHES, progress: Progress = silent
) -> tuple[Path, ...]:
    """The machine and its pins as XDMF with HDF5, for ParaView's "XDMF Reader" and meshio.

    For a path `rise.xdmf` the files are, in one folder,

        rise.xdmf       the machine: a triangle mesh whose points move. Data of points: velocity_m_s, and
                        displacement_m since the first step. Of triangles: body and role.
        rise_pins.xdmf  the pins as points: force_N of the first body on the second, force_magnitude_N, depth_m
                        (negative: gap), slip_m_s, pin, loose (1 or 0). Of an ideal pin depth and slip are NaN.
                        A loose pin is at its journal's centre. In the plane a pin stands for those of a pair.
        rise_mesh.h5    the numbers of both, to which they refer by this name
        rise_names.csv  what the numbers body, role and pin stand for

    ParaView moves the points itself. meshio's TimeSeriesReader gives those of the first step, to which
    displacement_m is to be added.

    Arguments:
        result: the run; it has recorded where its bodies are and how fast they move, and forces, depths and
            slips of its pins.
        path: ends in ".xdmf".
        sampling: which records are written.
        progress: is told the share that is done.

    Returns the paths of what was written, the machine's first.

    Raises InputError if a channel is missing, no record is chosen, they take too much memory, or the path ends
    otherwise; OSError if it cannot be written. After an error or an interruption nothing has changed.
    """
    path = Path(path)
    if path.suffix != ".xdmf":
        raise InputError(f"path = {str(path)!r}: allowed: names that end in .xdmf, by which readers know it")
    if ":" in path.stem:
        raise InputError(
            f"path = {str(path)!r}: allowed: names without ':', at which readers of XDMF part the name of the "
            "HDF5 file from the place in it; VTU, CSV and HDF5 can have it"
        )
    records = sampling.records(result.time)
    series, names = _meshes(result, records[0])
    store, table = f"{path.stem}_mesh.h5", f"{path.stem}_names.csv"
    indexes = [_index(path.stem, mesh, ".xdmf") for mesh in series]
    _check_room(series, len(records))
    earlier = f"{path.stem}_pins.xdmf"  # which an earlier export of another machine may have left
    stale = {earlier} if xdmf.refers(path.parent / earlier, store) else set()
    with whole_set(path.parent, (store, table), indexes, stale) as folder:
        # made in memory: on a full disk HDF5 would end the whole process
        with h5py.File(store, "w", driver="core", backing_store=False) as file:
            writers = [xdmf.MovingMeshWriter(mesh, file, store) for mesh in series]
            for step, record in enumerate(records):
                for writer in writers:
                    writer.write_step(float(result.time[record]), record)
                progress((step + 1) / len(records))
            file.flush()
            (folder / store).write_bytes(file.id.get_file_image())
        write_names(folder / table, names)
        for writer, index in zip(writers, indexes, strict=True):
            writer.write_index(folder / index)
    return tuple(path.parent / name for name in (*indexes, store, table))


def to_vtu(
    result: Result, folder: str | Path, sampling: Sampling = MESHES, progress: Progress = silent
) -> tuple[Path, ...]:
    """The same as one VTU file per step, and PVD files that tell their times, for ParaView and what reads VTK.

    In the folder: machine.pvd and pins.pvd, which ParaView opens; machine_00000.vtu and so on; names.csv.
    Fields are those of `to_xdmf`. Steps of an earlier export are replaced, and removed if they were more; other
    files stay.

    Arguments and errors as with `to_xdmf`. Returns the paths of the PVD files, then of the table and the steps.
    """
    folder = Path(folder)
    records = sampling.records(result.time)
    series, names = _meshes(result, records[0])
    steps = {mesh.name: [vtu.step_name(mesh.name, step) for step in range(len(records))] for mesh in series}
    files = ["names.csv", *(name for of_mesh in steps.values() for name in of_mesh)]
    indexes = [f"{mesh.name}.pvd" for mesh in series]
    stale = vtu.earlier(folder, "machine") | vtu.earlier(folder, "pins")
    with whole_set(folder, files, indexes, stale) as temporary:
        for step, record in enumerate(records):
            for mesh in series:
                vtu.write_step(temporary / steps[mesh.name][step], mesh, record)
            progress((step + 1) / len(records))
        write_names(temporary / "names.csv", names)
        times = [float(time) for time in result.time[records]]
        for mesh in series:
            vtu.write_index(temporary / f"{mesh.name}.pvd", steps[mesh.name], times)
    return tuple(folder / name for name in (*indexes, *files))


def to_csv(
    result: Result, path: str | Path, sampling: Sampling = TABLES, progress: Progress = silent
) -> tuple[Path, ...]:
    """All channels as a table: a row of names with units such as `pin.rear_base.force [N]`, then the records.

    Numbers read back as the same bits; pandas before 3 needs `read_csv(path, float_precision="round_trip")` for
    that. MATLAB keeps the names with `readtable(path, VariableNamingRule="preserve")`.

    Arguments: as with `to_xdmf`; all records if nothing else is asked for. Returns the path.

    Raises InputError if no record is chosen, or if a run is at the path; OSError if it cannot be written.
    """
    write_csv(result, Path(path), sampling.records(result.time), progress)
    return (Path(path),)


def to_hdf5(result: Result, path: str | Path, sampling: Sampling = TABLES) -> tuple[Path, ...]:
    """All channels as plain HDF5, for MATLAB, Octave, h5py and others.

        /channels/NAME      doubles, with the attributes unit and meaning (text of fixed length)
        /onsets/PIN/...     time, speed, parting_time, parting_speed of every contact, likewise
        /json/...           scenario, provenance, counts, impulses as JSON text

    In MATLAB: `h5read(path, "/channels/pin.rear_base.force")`, `h5readatt(path, "/channels/tip.x", "unit")`.
    It is not the file of a run, which `Result.save` writes and only `Result.load` reads.

    Arguments: as with `to_xdmf`; all records if nothing else is asked for; onsets are always all. Returns the
    path.

    Raises InputError if no record is chosen, or if a run is at the path; OSError if it cannot be written.
    """
    write_channels(result, Path(path), sampling.records(result.time))
    return (Path(path),)


def _meshes(result: Result, first: int) -> tuple[list[MeshSeries], list[Named]]:
    """What there is to write, the machine first, and what its numbers stand for."""
    machine, pins = MachineMesh(result, first), PinPoints(result)
    series = [machine.series]
    if pins.series is not None:
        series.append(pins.series)
    return series, machine.names + pins.names


def _check_room(series: list[MeshSeries], steps: int) -> None:
    """Raise InputError if so many steps do not fit into memory."""
    values = sum(mesh.values_per_step for mesh in series)
    if steps * values > MOST_VALUES:
        raise InputError(
            f"{steps} steps of {values} numbers each: allowed in one XDMF file: {MOST_VALUES:g} numbers, "
            f"here {MOST_VALUES // values} steps; choose fewer frames a second or a shorter time, or VTU"
        )


def _index(stem: str, mesh: MeshSeries, suffix: str) -> str:
    """The machine's index has the name that was asked for, the others theirs behind it."""
    return f"{stem}{suffix}" if mesh.name == "machine" else f"{stem}_{mesh.name}{suffix}"

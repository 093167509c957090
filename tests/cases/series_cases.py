"""Files of series in every format that is read, small, for tests."""

from __future__ import annotations

import io
from datetime import datetime, timedelta
from pathlib import Path

import h5py
import numpy as np
import pyarrow as pa
import scipy.io
from pyarrow import parquet

DATA = Path(__file__).parents[1] / "files" / "series" / "data"
TIME = np.linspace(0.0, 1.0, 11)
FORCE = 3.0 + np.sin(7.0 * TIME)
UNITS = {"time": "s", "t": "s", "*.t": "s"}  # of times of files that give none

CSV = "time_s;tip.x [mm];pin.force_kN\n" + "".join(f"{t:.1f};{t**2:.4f};{3 * t:.2f}\n" for t in TIME)
REQUESTS = """ A.R3    2019-08-11 13:52:24               2         0  3D
Adams View model name: two_requests
    2     MMKGS_N_RACA 1.000000000000000E+03
    1    4    11    12    9
hinge_pin
    7    1    11    12    0
   0.00000E+00
  1.0 2.0 3.0 4.0 5.0 6.0
  7.0 8.0 9.0 10.0 11.0 12.0
   1.00000E-03
  1.5 2.5 3.5 4.5 5.5 6.5
  7.5 8.5 9.5 10.5 11.5 12.5
"""
SENSOR = """#Exudyn implicit second order time integration sensor output file
#measure Node number = 0
#OutputVariableType = Position
#simulation started = 2026-11-24,16:26:44
#columns contain: time, comma separated sensor values (e.g, x,y,z position coordinates)
#number of sensor values = 3
#Exudyn version = 1.13.6; Python3.11.15; Linux x86_64 FLOAT64; 1 thread(s)
#
0,0,0,0
0.01,0,-0.0004905,0
0.02,0,-0.001962,0
"""
SOLUTION = """#Exudyn implicit second order time integration solver solution file
#simulation started=2026-11-24,16:26:44
#columns contain: time, ODE2 displacements, ODE2 velocities
#number of system coordinates [nODE2, nODE1, nAlgebraic, nData] = [1,0,0,0]
#number of written coordinates [nODE2, nVel2, nAcc2, nODE1, nVel1, nAlgebraic, nData] = [1,1,0,0,0,0,0]
#total columns exported  (excl. time) = 2
#number of time steps (planned) = 2
#
0,0,0
0.01,-0.0004905,-0.0981
0.02,-0.001962,-0.1962
#simulation finished=2026-11-24,16:26:44
"""


def matlab(version: str, compressed: bool = False) -> bytes:
    """A MATLAB file with a force over time, a structure and a text."""
    data = {"t": TIME, "pin_force_kN": FORCE}
    if version == "5":
        data |= {"run": {"time_ms": 1e3 * TIME, "x": TIME**2, "m": np.ones((TIME.size, 2))}, "said": "abc"}
    file = io.BytesIO()
    scipy.io.savemat(file, data, format=version, do_compression=compressed)
    return file.getvalue()


def matlab_73() -> bytes:
    """One of version 7.3: HDF5 behind a block with its name, columns as rows."""
    with h5py.File("made", "w", driver="core", backing_store=False, userblock_size=512) as file:
        vectors = {"t": TIME, "pin_force_kN": FORCE, "run/t": TIME, "run/x": TIME**2}
        file.create_dataset("both", data=np.array([TIME, 2.0 * TIME]))  # of MATLAB a column each
        for name, values in vectors.items():
            file.create_dataset(name, data=values.reshape(1, -1)).attrs["MATLAB_class"] = np.bytes_("double")
        file.flush()
        image = file.id.get_file_image()
    return b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x02IM" + bytes(384) + image


def parquet_bytes() -> bytes:
    """A table with a unit in a title, one in the metadata of a field, and a column of words."""
    fields = [
        pa.field("time_s", pa.float64()),
        pa.field("pin.force", pa.float64(), metadata={"unit": "kN"}),
        pa.field("said", pa.string()),
    ]
    columns = [pa.array(TIME), pa.array(FORCE), pa.array(["a"] * TIME.size)]
    sink = pa.BufferOutputStream()
    parquet.write_table(pa.table(columns, schema=pa.schema(fields)), sink)
    return bytes(sink.getvalue())


def exudyn_binary(end: bytes = b"\xff\xff\xff\xff") -> bytes:
    """A binary solution as Exudyn 1.13 writes it: of two coordinates and their rates."""

    def text(said: str) -> bytes:
        return np.int32(len(said)).tobytes() + said.encode()

    def whole(*numbers: int) -> bytes:
        return np.array([len(numbers), *numbers], np.int32).tobytes()

    head = b"EXUBIN" + bytes([10, 4, 8, 8, 0, 0, 0, 0, 0, 0]) + text("1.13.6") + text("Mode0000")
    head += text("Exudyn solver solution file") + text("2026-11-24") + whole(1, 0, 0, 0)
    head += whole(1, 1, 0, 0, 0, 0, 0) + np.array([2, 2], np.int32).tobytes() + text("") + text("EndOfHeader")
    rows = [np.int32(3).tobytes() + np.array([t, t**2, 2 * t]).tobytes() for t in TIME]
    return head + b"".join(rows) + end


LABVIEW = """LabVIEW Measurement\t
Separator\tTab
Decimal_Separator\t,
Multi_Headings\tYes
X_Columns\tONE
Time_Pref\tRelative
Date\t2019/07/22
Time\t17:18:18,938945770263671875
***End_of_Header***\t
\t
Channels\t2\t\t
Samples\t100\t100\t
Date\t2019/07/22\t2019/07/22\t
Time\t17:18:18,5\t17:18:18,5\t
Y_Unit_Label\tVolts\tkN\t
X_Dimension\tTime\tTime\t
X0\t0,0E+0\t0,0E+0\t
Delta_X\t0,001000\t0,001000\t
***End_of_Header***\t\t
X_Value\tUntitled\tForce\tComment
0,000\t0,5\t1,5
0,001\t0,6\t1,6\thello
"""


def labview(x_columns: str = "One", segments: int = 1) -> str:
    """A measurement file of LabVIEW with a kind of columns of times, and segments two seconds apart."""
    head, title, rows = LABVIEW.replace("ONE", x_columns).partition("X_Value")
    if x_columns == "No":
        rows = rows.replace("\n0,000", "\n").replace("\n0,001", "\n")
    if x_columns == "Multi":
        rows = "\tUntitled\tX_Value\tForce\tComment\n0,000\t0,5\t0,000\t1,5\n0,001\t0,6\t0,002\t1,6\thello\n"
    own = head[head.index("Channels") :] + title + rows
    return head + title + rows + "".join(own.replace(":18,5", f":{18 + 2 * n},5") for n in range(1, segments))


def workbook() -> bytes:
    """A workbook of Excel: a sheet of words, one with dates and a line above its titles, and one more."""
    import openpyxl

    book = openpyxl.Workbook()
    book.active.append(["About", "the test"])
    data, more = book.create_sheet("Data"), book.create_sheet("More")
    begin = datetime(2023, 5, 4, 6)
    rows = [["Test rig 7"], [], ["Time", "Force [KN]", "Remark", "x (mm)"], [begin, 1.5, "ok", 1]]
    for row in [*rows, [begin + timedelta(seconds=0.5), None, "ok", 2.25]]:
        data.append(row)
    for row in (["time_s", "F_kN"], [0, 1], [1, 2]):
        more.append(row)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def modelica(form: str = "binTrans") -> bytes:
    """What Dymola and OpenModelica write: rows are variables (binTrans) or columns (binNormal)."""
    names = {
        "Time": "Time in [s]",
        "J.phi": "angle [rad|deg]",
        "back": "-J.phi",
        "J.w": "speed [rad/s]",
        "m": "[kg]",
    }
    info = np.array([[0, 1, 0, -1], [2, 2, 0, -1], [2, -2, 0, -1], [2, 3, 0, -1], [1, 2, 0, 0]], dtype=np.int32)

    def letters(words: list[str]) -> np.ndarray:
        table = np.array([list(word.ljust(max(map(len, words)))) for word in words])
        return np.array(["".join(row) for row in (table.T if form == "binTrans" else table)])

    def numbers(table: np.ndarray) -> np.ndarray:
        return table.T if form == "binTrans" else table

    data = {
        "Aclass": np.array(["Atrajectory", "1.1", " ", form]),
        "name": letters([*names]),
        "description": letters([*names.values()]),
        "dataInfo": numbers(info),
        "data_1": numbers(np.array([[0.0, 7.0], [1.0, 7.0]])),
        "data_2": numbers(np.c_[TIME, TIME**2, 3.0 * TIME]),
    }
    file = io.BytesIO()
    scipy.io.savemat(file, data, format="4")
    return file.getvalue()


def simulink() -> bytes:
    """Arrays and structures with time as Simulink saves them, with signals of one and three columns."""
    signals = np.zeros((1, 2), dtype=[("values", object), ("dimensions", object), ("label", object)])
    signals[0, 0] = (TIME.reshape(-1, 1), 1.0, "Force_kN")
    signals[0, 1] = (np.c_[TIME, 2 * TIME], 2.0, "")
    scope = {"time": TIME.reshape(-1, 1), "signals": signals, "blockName": "model/Scope"}
    single = {"values": (3 * TIME).reshape(-1, 1), "dimensions": 1.0, "label": "", "blockName": "model/x_mm"}
    file = io.BytesIO()
    data = {"tout": TIME.reshape(-1, 1), "yout": np.c_[TIME, TIME**2], "scope": scope}
    scipy.io.savemat(file, data | {"simout": {"time": TIME.reshape(-1, 1), "signals": single}})
    return file.getvalue()


def files() -> dict[str, bytes]:
    """A file of every format but MATLAB's, by its name."""
    return {
        "table.csv": CSV.encode(),
        "free_fall.res": (DATA / "free_fall.res").read_bytes(),
        "two.req": REQUESTS.encode(),
        "sensor.txt": SENSOR.encode(),
        "solution.txt": SOLUTION.encode(),
        "solution.sol": exudyn_binary(),
        "table.parquet": parquet_bytes(),
        "lab.lvm": labview().encode(),
        "stamps.csv": b"Date;Time;F_kN\n04.05.2023;06:00:00;1,5\n04.05.2023;06:00:01;1,6\n",
        "book.xlsx": workbook(),
        "rows.json": b'[{"time_s": 0, "x_mm": 1}, {"time_s": 1, "x_mm": 2.5}]',
    }


def matlab_files() -> dict[str, bytes]:
    """A file of every version of MATLAB's."""
    return {
        "v4.mat": matlab("4"), "v5.mat": matlab("5"), "v7.mat": matlab("5", True), "v73.mat": matlab_73(),
    }  # fmt: skip

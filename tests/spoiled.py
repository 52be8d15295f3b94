"""Numbers as they must not be given: what NumPy takes for numbers, in one cell or in all."""

import numpy as np


class Quantity:
    """A mass, of a units library that knows no other unit."""

    def __init__(self, value):
        self.value, self.unit = value, type("Unit", (), {"__str__": lambda _: "kilogram"})()

    def to(self, unit):
        raise LookupError(f"kilogram is no {unit}")

    def __array__(self, dtype=None, copy=None):
        return np.asarray(self.value, dtype=dtype)

    def __float__(self):
        return float(self.value)


CELLS = {
    "text": "1.0", "bytes": b"1.0", "true": True, "truth of NumPy": np.True_, "nothing": None,
    "not a number": np.nan, "infinity": -np.inf, "complex": 1j, "masked": np.ma.masked,
    "span of time": np.timedelta64(1, "s"), "span": np.timedelta64(1), "quantity": Quantity(1.0),
    "pair": (1.0, 2.0), "set": {1.0, 2.0},
}  # fmt: skip
WHOLES = {
    "masked array": lambda array: np.ma.masked_array(array, mask=array == array.flat[0]),
    "array of a quantity": Quantity,
    "array of texts": lambda array: array.astype(str),
    "array of bytes": lambda array: array.astype("S8"),
    "array of truths": lambda array: array.astype(bool),
    "array of spans": lambda array: array.astype("m8[s]"),
    "array of dates": lambda array: array.astype("m8[s]") + np.datetime64("2026-01-01"),
    "bytearray": lambda array: bytearray(array.size),
    "dictionary": lambda array: dict.fromkeys(array.ravel().tolist(), 1.0),
    "set of numbers": lambda array: {0.1, 0.2},
    "text of numbers": lambda array: str(array.tolist()),
}


def nested_with(values, place, cell):
    """Return nested lists of an array with another cell at a flat place."""
    cells = np.asarray(values).astype(object)
    whole = np.empty(cells.size, dtype=object)
    whole[:] = cells.ravel()
    whole[place % cells.size] = cell
    return whole.reshape(cells.shape).tolist()


def spoiled(values, kind, place=0):
    """Return an array of numbers with one fault."""
    if kind in CELLS:
        return nested_with(values, place, CELLS[kind])
    return WHOLES[kind](np.array(values, dtype=float))

"""What every kernel shares: NumPy's semantics for a function of real arguments, and error-free sums and products."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from typing import Any

import numpy as np

# A block of doubles is 128 KiB: a few temporaries of a kernel stay in a second-level cache, and calls cost little.
BLOCK = 16384
# NumPy copies what it broadcasts along rows shorter than its buffer, which costs more than the arithmetic.
BUFFER = 512


def real_array(name: str, value: np.typing.ArrayLike) -> np.ndarray:
    """`value` as an array of real numbers; a TypeError or ValueError that names the argument where it is none."""
    if isinstance(value, int):
        # Python's integers have no largest one, and NumPy turns those past 64 bits into objects.
        try:
            value = float(value)
        except OverflowError:
            value = math.inf if value > 0 else -math.inf
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise ValueError(f"{name} is not a rectangular array of numbers") from error
    if array.dtype.kind not in "buif":
        raise TypeError(f"{name} must hold real numbers, not {array.dtype}")
    return array


def result_dtype(arguments: dict[str, np.typing.ArrayLike], orders: Collection[str] = ()) -> type[np.floating]:
    """float32 where every argument that has a dtype of its own is float32, else float64.

    Python's numbers have none, and neither have integers among `orders`, the arguments that count something.
    """
    typed = [
        np.asarray(value).dtype
        for name, value in arguments.items()
        if not isinstance(value, (int, float)) or isinstance(value, np.generic)
        if not (name in orders and np.asarray(value).dtype.kind in "bui")
    ]
    return np.float32 if typed and all(dtype == np.float32 for dtype in typed) else np.float64


def elementwise(
    core: Callable[..., np.ndarray],
    orders: Collection[str] = (),
    block: int = BLOCK,
    dtype: type[np.floating] = np.float64,
    **arguments: np.typing.ArrayLike,
) -> np.ndarray | np.floating:
    """Broadcast the named arguments, run `core` on blocks of vectors of `dtype`, and return its values in their shape.

    `core` gets one vector an argument, all of one length, and must neither change them nor keep them; it answers
    with NaN where an argument is outside its domain. Floating-point warnings are off while it runs. Arguments are
    rounded to `dtype` first, Python's numbers beside arrays of float32 as well.

    >>> elementwise(lambda x, y: x + y, x=1, y=[2, 3.5])
    array([3. , 4.5])
    """
    return elementwise_tuple(lambda *vectors: (core(*vectors),), 1, orders, block, dtype, **arguments)[0]


def elementwise_tuple(
    core: Callable[..., tuple[np.ndarray, ...]],
    outputs: int,
    orders: Collection[str] = (),
    block: int = BLOCK,
    dtype: type[np.floating] = np.float64,
    **arguments: np.typing.ArrayLike,
) -> tuple[np.ndarray | np.floating, ...]:
    """As `elementwise`, for a `core` that returns so many vectors at once.

    >>> elementwise_tuple(lambda x, y: (x + y, x - y), 2, x=1, y=[2, 3.5])
    (array([3. , 4.5]), array([-1. , -2.5]))
    """
    arrays = [real_array(name, value) for name, value in arguments.items()]
    single = result_dtype(arguments, orders)
    shape = common_shape(dict(zip(arguments, arrays, strict=True)))
    results = [np.empty(shape, single) for _ in range(outputs)]
    access: Any = [("readonly",)] * len(arrays) + [("writeonly", "no_broadcast")] * outputs
    plain = all(
        array.shape == shape and array.dtype == dtype and array.flags.c_contiguous and array.flags.aligned
        for array in arrays
    )
    # The first block is cast as soon as there is an iterator, and may overflow.
    with np.errstate(all="ignore"):
        if plain and single == dtype and results[0].size <= block:
            np.setbufsize(BUFFER)
            for out, value in zip(results, core(*(array.reshape(-1) for array in arrays)), strict=True):
                out.reshape(-1)[:] = value
            return tuple(result[()] for result in results)
        blocks = np.nditer(
            (*arrays, *results),
            flags=("external_loop", "buffered", "zerosize_ok"),
            op_flags=access,
            op_dtypes=(dtype,) * (len(arrays) + outputs),
            casting="same_kind",
            # A buffer is as large as it is asked for, whatever it will hold.
            buffersize=min(block, max(math.prod(shape), 1)),
        )
        np.setbufsize(BUFFER)
        with blocks:
            for parts in blocks:
                vectors, outs = parts[: len(arrays)], parts[len(arrays) :]
                # Without a cast the buffer is skipped, and a block may then be the whole array.
                for start in range(0, outs[0].size, block):
                    part = slice(start, start + block)
                    for out, value in zip(outs, core(*(vector[part] for vector in vectors)), strict=True):
                        out[part] = value
    return tuple(result[()] for result in results)


def common_shape(arrays: dict[str, np.ndarray]) -> tuple[int, ...]:
    """The shape that the named arrays broadcast to; a ValueError that names their shapes where there is none."""
    try:
        return np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError as error:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise ValueError(f"these shapes do not broadcast: {shapes}") from error


def scalar(x: np.ndarray) -> float:
    """The only value of `x`; Python's arithmetic is that of double precision, and faster."""
    return x.item() if x.dtype == np.float64 else x[0]


def horner(coefficients: Collection[float], x: Any) -> Any:
    """The polynomial with these coefficients, highest power first, of an array or of a float."""
    first, *rest = coefficients
    if isinstance(x, float) or x.size == 1:
        # The same products and sums, without a call for each.
        one, sum_ = x if isinstance(x, float) else scalar(x), first
        for coefficient in rest:
            sum_ = sum_ * one + coefficient
        return sum_ if isinstance(x, float) else np.full_like(x, sum_)
    total = np.full_like(x, first)
    for coefficient in rest:
        total *= x
        total += coefficient
    return total


def two_sum(a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """a + b as its rounded value and the exact rounding error (Knuth).

    >>> [float(part) for part in two_sum(1.0, 2.0**-60)] == [1.0, 2.0**-60]
    True
    """
    total = a + b
    shadow = total - a
    return total, (a - (total - shadow)) + (b - shadow)


def quick_two_sum(a: np.ndarray | float, b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """As `two_sum`, in half the steps, where |a| >= |b| or a = 0 (Dekker)."""
    total = a + b
    return total, b - (total - a)


def split(a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """a as the exact sum of two numbers of 26 bits each (Veltkamp); |a| < 2^996."""
    scaled = 134217729.0 * a
    high = scaled - (scaled - a)
    return high, a - high


def two_prod(a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """a b as its rounded value and the rounding error, exact unless it underflows (Dekker; NumPy has no fma).

    >>> product, error = two_prod(1 + 2.0**-30, 1 - 2.0**-30)
    >>> float(product), float(error) == -(2.0**-60)
    (1.0, True)
    """
    product = a * b
    a_high, a_low = split(a)
    b_high, b_low = split(b)
    return product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low


def two_square(a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """a^2 as its rounded value and the rounding error: `two_prod` with one split."""
    square = a * a
    high, low = split(a)
    return square, ((high * high - square) + 2.0 * high * low) + low * low

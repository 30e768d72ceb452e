"""A reward as a line of code, such as `10*hit - 0.01*turned`: numbers, names of quantities, + - * /, comparisons, min,
max, abs, and `a if b else c`.

A line is parsed into a program of a small stack machine, never run by Python. The program is a record, so compiled
loops follow another line without being compiled again, and both bodies give the same bits.

A line is a sum; its terms such as `10*hit` are `weights`, the others together its `rest`. Dividing by zero gives 0, a
true comparison 1; rewards end at 1000 and -1000.
"""

import ast
import logging
import warnings
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib import import_module
from types import FunctionType
from typing import Annotated, Any, TypeVar

from pigaming_app.sim.kernel import compiled, kernel
from pigaming_app.sim.record import packed, record

LONGEST = 80  # characters of a line
STEPS, DEPTH = 128, 32  # of a program, and numbers on its stack
MOST = 1000.0  # points, of a number and of a reward

NUMBER, NAME, NEGATIVE, ABS, ADD, SUBTRACT, MULTIPLY, DIVIDE, LESS, AT_MOST, EQUAL, MIN, MAX, CHOICE = range(14)
OPERATORS: Mapping[type, int] = {ast.Add: ADD, ast.Sub: SUBTRACT, ast.Mult: MULTIPLY, ast.Div: DIVIDE}
COMPARISONS: Mapping[type, tuple[int, bool, bool]] = {  # operation, operands swapped, result negated
    ast.Lt: (LESS, False, False),
    ast.LtE: (AT_MOST, False, False),
    ast.Gt: (LESS, True, False),
    ast.GtE: (AT_MOST, True, False),
    ast.Eq: (EQUAL, False, False),
    ast.NotEq: (EQUAL, False, True),
}
FUNCTIONS = {"min": MIN, "max": MAX, "abs": ABS}
SIGNS = str.maketrans({"×": "*", "·": "*", "−": "-", "÷": "/"})
REASONS = {
    "empty": "there is no reward in the line",
    "long": "more than {most} characters",
    "name": "'{found}' is unknown; there are {names}",
    "big": "numbers end at 1000",
    "syntax": "'{found}' cannot be understood",
}

log = logging.getLogger("pigaming")
Recipe = TypeVar("Recipe")


class LineError(ValueError):
    """A line is no reward. `reason`: a key of REASONS; `values`: what its sentence names."""

    def __init__(self, reason: str, **values: Any) -> None:
        super().__init__(REASONS[reason].format(**values))
        self.reason, self.values = reason, values


@record
class RewardProgram:
    """Steps of a stack machine; without any, the reward is 0."""

    size: int
    codes: Annotated[list[int], STEPS]
    numbers: Annotated[list[float], STEPS]  # of NUMBER its value, of NAME its place among the quantities
    stack: Annotated[list[float], DEPTH]


@kernel
def points(program: RewardProgram, quantities: Sequence[float]) -> float:
    """The reward of a program for these quantities, points from -MOST to MOST."""
    stack, top = program.stack, 0
    for i in range(program.size):
        code, number = program.codes[i], program.numbers[i]
        if code <= NAME:
            stack[top] = number if code == NUMBER else quantities[int(number)]
            top += 1
        elif code == NEGATIVE:
            stack[top - 1] = -stack[top - 1]
        elif code == ABS:
            stack[top - 1] = abs(stack[top - 1])
        elif code == CHOICE:
            top -= 2
            stack[top - 1] = stack[top - 1] if stack[top] != 0.0 else stack[top + 1]
        else:
            top -= 1
            stack[top - 1] = combined(code, stack[top - 1], stack[top])
    value: float = stack[0] if program.size else 0.0
    return value if -MOST <= value <= MOST else MOST if value > MOST else -MOST if value < -MOST else 0.0


@kernel
def combined(code: int, a: float, b: float) -> float:
    """The result of an operation with two operands."""
    if code == ADD:
        return a + b
    if code == SUBTRACT:
        return a - b
    if code == MULTIPLY:
        return a * b
    if code == DIVIDE:
        return a / b if b != 0.0 else 0.0
    if code == LESS:
        return 1.0 if a < b else 0.0
    if code == AT_MOST:
        return 1.0 if a <= b else 0.0
    if code == EQUAL:
        return 1.0 if a == b else 0.0
    if code == MIN:
        return b if b < a else a
    return b if b > a else a


def judge_rows(programs: Any, rows: Any, worths: Any) -> None:
    """Write the rewards (n,) of a program for the quantities of rows (n, k)."""
    for i in range(len(rows)):
        worths[i] = points(programs[0], rows[i])


@cache
def _loop(fast: bool) -> Any:
    return compiled(judge_rows) if fast else judge_rows


def points_of(program: RewardProgram, rows: Any, fast: bool) -> Any:
    """The rewards (...) of a program for the quantities of rows (..., k); `fast`: compiled, which needs numba."""
    import numpy as np

    flat = np.ascontiguousarray(rows, np.float64).reshape(-1, rows.shape[-1])
    worths = np.zeros(len(flat))
    _loop(fast)(packed([program]) if fast else [program], flat, worths)
    return worths.reshape(rows.shape[:-1])


def elementwise(function: Callable[..., float], count: int, fast: bool) -> Callable[..., Any]:
    """A function of `count` numbers as one of arrays; `fast`: compiled, if it is a plain function that numba can."""
    import numpy as np

    if fast and isinstance(function, FunctionType):
        numba: Any = import_module("numba")
        try:
            quick: Callable[..., Any] = numba.vectorize(function)
            given = quick(*np.zeros((count, 0))).dtype
        except Exception as error:  # whatever numba's stages raise
            log.info("%s is not compiled: %s", function, error)
        else:
            if np.can_cast(given, float):
                return quick
    return np.vectorize(function, otypes=[float])


@dataclass(frozen=True)
class RewardLine:
    """A line, in parts."""

    weights: Mapping[str, float]  # of the names that have one
    rest: str  # "" for none
    program: RewardProgram  # of the rest


def parsed(text: str, names: Sequence[str], weighted: Collection[str] = ()) -> RewardLine:
    """A line over `names`, whose places are those of the quantities; terms of `weighted` ones become weights.

    Raises LineError.
    """
    if len(text.strip()) > LONGEST:
        raise LineError("long", most=LONGEST)
    tree = _tree(text)
    _compile(tree, names, [])  # refuses what is no line
    weights: dict[str, float] = {}
    others: list[tuple[bool, ast.expr]] = []
    for negative, term in _terms(tree):
        if (found := _weight(term, weighted)) is None:
            others.append((negative, term))
        else:
            name, weight = found
            weights[name] = weights.get(name, 0.0) + (-weight if negative else weight)
    if any(abs(weight) > MOST for weight in weights.values()):
        raise LineError("big")
    rest = _joined((negative, _written(term, negative or len(others) > 1)) for negative, term in others)
    return RewardLine(weights, rest, program_of(rest, names))


def program_of(text: str, names: Sequence[str]) -> RewardProgram:
    """The program of a whole line, or of none ("") one without steps. Raises LineError."""
    program, steps = RewardProgram(), list[tuple[int, float]]()
    if text:
        _compile(_tree(text), names, steps)
    program.size = len(steps)
    for i, (code, number) in enumerate(steps):
        program.codes[i], program.numbers[i] = code, number
    return program


def line_of(recipe: Any, weighted: Sequence[str]) -> str:
    """The line of a recipe, a dataclass: its weights, which are fields of these names, and its field `rest`."""
    weights = [(name, float(getattr(recipe, name))) for name in weighted]
    terms = [(weight < 0, _term(abs(weight), name)) for name, weight in weights if weight]
    rest: str = recipe.rest
    if rest:
        tree = _tree(rest)
        parts = list(_terms(tree))
        terms += [(negative, _written(part, negative or len(parts) + len(terms) > 1)) for negative, part in parts]
    return _joined(terms) or "0"


def with_line(recipe: Recipe, text: str, names: Sequence[str], weighted: Sequence[str]) -> Recipe:
    """The recipe with the reward of a line. Raises LineError."""
    line = parsed(text, names, weighted)
    changes: dict[str, Any] = {name: line.weights.get(name, 0.0) for name in weighted}
    return replace(recipe, **changes, rest=line.rest)  # type: ignore[type-var]


def _tree(text: str) -> ast.expr:
    text = text.translate(SIGNS).strip()
    if not text:
        raise LineError("empty")
    try:
        with warnings.catch_warnings(action="ignore"):
            return ast.parse(text, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise LineError("syntax", found=text) from None


def _compile(tree: ast.expr, names: Sequence[str], steps: list[tuple[int, float]], depth: int = 0) -> None:
    """Add the steps of an expression. `depth`: numbers on the stack before it."""
    if depth >= DEPTH:
        raise LineError("long", most=LONGEST)
    match tree:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            if not abs(value) <= MOST:
                raise LineError("big")
            steps.append((NUMBER, float(value)))
        case ast.Name(id=name) if name in names:
            steps.append((NAME, float(names.index(name))))
        case ast.Name(id=name):
            raise LineError("name", found=name, names=", ".join(names))
        case ast.UnaryOp(op=ast.USub() | ast.UAdd() as sign, operand=operand):
            _compile(operand, names, steps, depth)
            if isinstance(sign, ast.USub):
                steps.append((NEGATIVE, 0.0))
        case ast.BinOp(left=left, op=operator, right=right) if type(operator) in OPERATORS:
            _compile_pair(OPERATORS[type(operator)], left, right, names, steps, depth)
        case ast.Compare(left=left, ops=[operator], comparators=[right]) if type(operator) in COMPARISONS:
            code, swapped, negated = COMPARISONS[type(operator)]
            _compile_pair(code, *((right, left) if swapped else (left, right)), names, steps, depth)
            if negated:
                steps += [(NUMBER, 0.0), (EQUAL, 0.0)]
        case ast.Compare(left=left, ops=[operator, *others], comparators=[right, *rest]):  # a < b < c
            first = ast.Compare(left, [operator], [right])
            _compile_pair(MULTIPLY, first, ast.Compare(right, others, rest), names, steps, depth)
        case ast.IfExp(test=test, body=body, orelse=other):
            for offset, part in enumerate((body, test, other)):
                _compile(part, names, steps, depth + offset)
            steps.append((CHOICE, 0.0))
        case ast.Call(func=ast.Name(id="abs"), args=[operand], keywords=[]):
            _compile(operand, names, steps, depth)
            steps.append((ABS, 0.0))
        case ast.Call(func=ast.Name(id="min" | "max" as name), args=[first, *others], keywords=[]) if others:
            _compile(first, names, steps, depth)
            for other in others:
                _compile(other, names, steps, depth + 1)
                steps.append((FUNCTIONS[name], 0.0))
        case _:
            raise LineError("syntax", found=ast.unparse(tree))
    if len(steps) > STEPS:
        raise LineError("long", most=LONGEST)


def _compile_pair(
    code: int, left: ast.expr, right: ast.expr, names: Sequence[str], steps: list[tuple[int, float]], depth: int
) -> None:
    _compile(left, names, steps, depth)
    _compile(right, names, steps, depth + 1)
    steps.append((code, 0.0))


def _terms(tree: ast.expr, negative: bool = False) -> list[tuple[bool, ast.expr]]:
    """The terms of a sum, and whether each is subtracted."""
    match tree:
        case ast.BinOp(left=left, op=ast.Add() | ast.Sub() as operator, right=right):
            return [*_terms(left, negative), *_terms(right, negative ^ isinstance(operator, ast.Sub))]
        case ast.UnaryOp(op=ast.USub() | ast.UAdd() as sign, operand=operand):
            return _terms(operand, negative ^ isinstance(sign, ast.USub))
        case ast.BinOp(left=ast.UnaryOp(op=ast.USub(), operand=left), op=ast.Mult() as times, right=right):
            return _terms(ast.BinOp(left, times, right), not negative)
        case _:
            return [(negative, tree)]


def _weight(term: ast.expr, weighted: Collection[str]) -> tuple[str, float] | None:
    """Name and weight of a term such as `10*hit`, `hit*-10` or `hit`; None for another one."""
    match term:
        case ast.Name(id=name) if name in weighted:
            return name, 1.0
        case ast.BinOp(left=left, op=ast.Mult(), right=ast.Name(id=name)) if name in weighted:
            weight = _number(left)
        case ast.BinOp(left=ast.Name(id=name), op=ast.Mult(), right=right) if name in weighted:
            weight = _number(right)
        case _:
            return None
    return None if weight is None else (name, weight)


def _number(tree: ast.expr) -> float | None:
    match tree:
        case ast.Constant(value=int() | float() as value):
            return float(value)
        case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int() | float() as value)):
            return -float(value)
        case _:
            return None


def _written(term: ast.expr, in_sum: bool) -> str:
    text = ast.unparse(term).replace(" * ", "*").replace(" / ", "/")
    return f"({text})" if in_sum and isinstance(term, ast.IfExp | ast.Compare) else text


def _term(weight: float, name: str) -> str:
    return name if weight == 1.0 else f"{weight!r}".removesuffix(".0") + f"*{name}"


def _joined(terms: Any) -> str:
    """A sum of terms, each with whether it is subtracted."""
    text = "".join(f"{' - ' if negative else ' + '}{term}" for negative, term in terms)
    return text.removeprefix(" + ") if text.startswith(" + ") else text.replace(" - ", "-", 1)

"""`<Agent>.vardesc`: the variables of a mind (thesis, A.2). Reader and writer.

A line `name:type(:default)` for each variable. The fields after the default are ours:

- `name:CounterVariableModule:default:maximum:increment:reset`
- `name:SharedVariableModule:default:Group`: a variable that the members of a group share
- `name:RegulatedVariableModule:default:function`, of the Python file that is called as the
  `.vardesc` is, or `…:file.py:function`

A default may be left empty.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from socialmind.errors import ModelError, nearest
from socialmind.mind.files.evoagents.text_file import Line, Lines, field
from socialmind.mind.files.python_file import load_beside
from socialmind.mind.modules import Variable
from socialmind.mind.regulation import REGULATIONS, Counter, Regulated, Regulation, Simple, Wave

SHARED = "SharedVariableModule"
"""The type of a simple variable that a group shares."""
TYPES = {
    Simple.keyword: (0, 1, "name:VariableModule:default"),
    Wave.keyword: (0, 1, "name:TickWaveSinVariableModule"),
    Counter.keyword: (0, 4, "name:CounterVariableModule:default:maximum:increment:reset"),
    SHARED: (2, 2, "name:SharedVariableModule:default:Group"),
    Regulated.keyword: (2, 3, "name:RegulatedVariableModule:default:file.py:function"),
}
"""The types: how many fields must and may follow, and the whole form."""


def parse(text: str, file: str | Path) -> tuple[Variable, ...]:
    r"""Return the variables that a file describes.

    Args:
        text: the file's content.
        file: its path, for messages and for the Python files beside it.

    Raises:
        ModelError: the text is no such file; says at which line and why.

    >>> text = "SIN:TickWaveSinVariableModule\nROLE: VariableModule: 0.5\n"
    >>> sine, role = parse(text, "B.vardesc")
    >>> sine.start, role.start
    (0.5, 0.5)
    """
    lines = Lines(text, file)
    return tuple(_variable(lines, line) for line in lines.rest())


def _variable(lines: Lines, line: Line) -> Variable:
    fields = line.fields
    if len(fields) < 2:
        raise lines.error(
            repr(line.text), "a variable, name:type(:default)", f"write {line.text}:VariableModule",
            line.number,
        )  # fmt: skip
    name, kind, further = fields[0], fields[1], fields[2:]
    if kind not in TYPES:
        raise lines.error(
            f"{kind!r} as the type of the variable {name!r}",
            f"one of {', '.join(TYPES)}",
            nearest(kind, TYPES),
            line.number,
        )
    least, most, form = TYPES[kind]
    if not least <= len(further) <= most:
        raise lines.error(
            f"{len(further)} fields after the type of the variable {name!r}",
            f"{least} … {most}" if least < most else str(least),
            f"write {form}",
            line.number,
        )
    default = None
    if further and further[0]:
        default = lines.number(further[0], f"the default of the variable {name!r}", line.number)
    group = further[1] if kind == SHARED else None
    with lines.placing(line.number, f"write {form}"):
        regulation = _regulation(lines, line, kind, further[1:])
        return Variable(name, regulation, default, group, lines.file, line.number)


def _regulation(lines: Lines, line: Line, kind: str, further: tuple[str, ...]) -> Regulation:
    if kind == Counter.keyword:
        return _counter(lines, line, further)
    if kind == Regulated.keyword:
        file, name = further if len(further) == 2 else ("", further[0])
        path = Path(lines.file).with_suffix(".py")
        return Regulated(load_beside(path, file, name, lines.file, line.number))
    return Simple() if kind == SHARED else REGULATIONS[kind]()


def _counter(lines: Lines, line: Line, further: tuple[str, ...]) -> Counter:
    known = Counter()
    values = (*further, *[""] * (3 - len(further)))
    maximum, increment, reset = values
    here = line.number
    return Counter(
        lines.whole_number(maximum, "the counter's maximum", here) if maximum else known.maximum,
        lines.number(increment, "the counting threshold", here) if increment else known.increment,
        lines.number(reset, "the resetting threshold", here) if reset else known.reset,
    )


def written(variables: Iterable[Variable], files: Mapping[str, str] | None = None) -> str:
    """Return the file of variables, which reads back as equal ones.

    Args:
        variables: the variables.
        files: for each regulated variable by name, the Python file that holds its function.

    Raises:
        ModelError: a variable that does not go into a line.

    >>> print(written([Variable("ROLE", default=0.5), Variable("N", Counter(5))]), end="")
    ROLE:VariableModule:0.5
    N:CounterVariableModule::5:0.8:0.2
    """
    held = files or {}
    lines = [_line(variable, held.get(variable.name, "")) for variable in variables]
    return "\n".join(lines) + "\n" if lines else ""


def _line(variable: Variable, file: str) -> str:
    what = f"the variable {variable.name!r}"
    regulation = variable.regulation
    default = "" if variable.default is None else repr(float(variable.default))
    fields = [field(variable.name, f"the name of {what}")]
    if variable.group is not None:
        check_shared(variable)
        fields += [SHARED, default, field(variable.group, f"the group of {what}")]
    elif isinstance(regulation, Counter):
        fields += [regulation.keyword, default, str(regulation.maximum)]
        fields += [repr(float(regulation.increment)), repr(float(regulation.reset))]
    elif isinstance(regulation, Regulated):
        fields += [regulation.keyword, default, *([file] if file else [])]
        fields.append(regulation.function.__name__)
    else:
        fields += [regulation.keyword, *([default] if default else [])]
    return ":".join(fields)


def check_shared(variable: Variable) -> None:
    """Refuse a variable of a group that files cannot hold.

    Raises:
        ModelError: it is not a simple one.
    """
    if variable.regulation != Simple():
        raise ModelError(
            f"the variable {variable.name!r}, shared by a group and regulated by "
            f"{variable.regulation}",
            "a simple variable where it is shared",
            "share a simple variable and regulate another",
        )

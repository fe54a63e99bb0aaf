"""`<Agent>.botdesc`: the sensors and actuators of a mind (thesis, A.1). Reader and writer.

The line SENSORS, a line `name:type(:parameters)` for each sensor, the line ACTUATORS and a line
`name:type(:neutral(:parameters))` for each actuator. The third field of an actuator, its command
when nothing influences it, is ours.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from socialmind.mind.files.evoagents.text_file import Line, Lines, field
from socialmind.mind.modules import Actuator, Sensor

SENSORS, ACTUATORS = "SENSORS", "ACTUATORS"
NEUTRAL = 0.5


def parse(text: str, file: str | Path) -> tuple[tuple[Sensor, ...], tuple[Actuator, ...]]:
    r"""Return the sensors and actuators that a file describes.

    Args:
        text: the file's content.
        file: its path, for messages.

    Raises:
        ModelError: the text is no such file; says at which line and why.

    >>> sensors, actuators = parse("SENSORS\nS1:proxSensor\nACTUATORS\nM1:propeller\n", "B.botdesc")
    >>> sensors[0].kind, actuators[0].neutral
    ('proxSensor', 0.5)
    """
    lines = Lines(text, file)
    lines.keyword(SENSORS, "begin with SENSORS, then one name:type a line")
    sensors = []
    while lines.next is not None and lines.next.text != ACTUATORS:
        sensors.append(_sensor(lines, lines.take("a sensor")))
    lines.keyword(ACTUATORS, "after the sensors, write ACTUATORS, even if there are none")
    return tuple(sensors), tuple(_actuator(lines, line) for line in lines.rest())


def _fields(lines: Lines, line: Line, what: str, form: str) -> tuple[str, ...]:
    if line.text in (SENSORS, ACTUATORS):
        raise lines.error(
            f"{line.text} again" if line.text == ACTUATORS else f"{line.text} in the wrong place",
            f"{what}, {form}",
            "write SENSORS once, at the top, and ACTUATORS once, after the sensors",
            line.number,
        )
    if len(line.fields) < 2:
        raise lines.error(
            repr(line.text), f"{what}, {form}", f"write {line.text}:type", line.number
        )
    return line.fields


def _sensor(lines: Lines, line: Line) -> Sensor:
    name, kind, *parameters = _fields(lines, line, "a sensor", "name:type(:parameters)")
    with lines.placing(line.number, "write it as S1:proxSensor"):
        return Sensor(name, kind, tuple(parameters), lines.file, line.number)


def _actuator(lines: Lines, line: Line) -> Actuator:
    name, kind, *further = _fields(lines, line, "an actuator", "name:type(:neutral command)")
    neutral = NEUTRAL
    if further:
        what = f"the neutral command of the actuator {name!r}"
        neutral = lines.number(further[0], what, line.number)
    with lines.placing(line.number, "write it as M1:propeller:0.5"):
        return Actuator(name, kind, neutral, tuple(further[1:]), lines.file, line.number)


def written(sensors: Iterable[Sensor], actuators: Iterable[Actuator]) -> str:
    """Return the file of sensors and actuators, which reads back as equal ones.

    Raises:
        ModelError: a type or parameter that does not go into a line.

    >>> print(written([Sensor("S1", "proxSensor")], [Actuator("M1", "propeller", 0.0)]), end="")
    SENSORS
    S1:proxSensor
    ACTUATORS
    M1:propeller:0.0
    """
    lines = [SENSORS]
    for sensor in sensors:
        what = f"the sensor {sensor.name!r}"
        lines.append(_line(what, sensor.name, sensor.kind, *sensor.parameters))
    lines.append(ACTUATORS)
    for actuator in actuators:
        what = f"the actuator {actuator.name!r}"
        further: tuple[str, ...] = actuator.parameters
        if further or actuator.neutral != NEUTRAL:
            further = (repr(float(actuator.neutral)), *further)
        lines.append(_line(what, actuator.name, actuator.kind, *further))
    return "\n".join(lines) + "\n"


def _line(what: str, name: str, kind: str, *parameters: str) -> str:
    fields = [field(name, f"the name of {what}"), field(kind, f"the type of {what}")]
    fields += [field(one, f"a parameter of {what}") for one in parameters]
    return ":".join(fields)

"""The map in a model's file: terrains, what patches are like, how the ground changes."""

from __future__ import annotations

import re

from socialmind.metaciv.description import Terrain
from socialmind.metaciv.writing.layout import block, fractional, function, listed, sentence, table
from socialmind.metaciv.writing.sheet import Sheet, written

PERIOD = 150
"""Ticks after which pheromones grow and roads wear off."""


class MapText:
    """What a model's file says of the map.

    Args:
        sheet: the model file.
    """

    def __init__(self, sheet: Sheet) -> None:
        self.sheet, self.model = sheet, sheet.model

    # What the map is like -------------------------------------------------------------------------

    @property
    def terrains(self) -> list[Terrain | None]:
        """The terrains of the map by index; None for one that no file has."""
        known = {one.name: one for one in self.model.terrains}
        return [known.get(name) for name in self.model.environment.terrains]

    @property
    def used_indices(self) -> list[int]:
        """The indices that the map has."""
        return sorted({one for row in self.model.environment.rows for one in row})

    @property
    def mapped(self) -> bool:
        """Whether the map has more than one terrain, or rules ask for them."""
        return len(self.used_indices) > 1 or "terrains" in self.sheet.needs

    def _of_terrains(self, value: object) -> list[object]:
        """Return what is said of each terrain, by index."""
        return [value(one) if one is not None else None for one in self.terrains]  # type: ignore[operator]

    def _only(self, values: list[object]) -> object | None:
        """Return the one value that all terrains of the map have, or None."""
        found = {repr(values[one]) for one in self.used_indices}
        return values[self.used_indices[0]] if len(found) == 1 else None

    @property
    def closed(self) -> bool:
        """Whether the map has ground that nobody can enter."""
        terrains = self.terrains
        return any(one is not None and one.impassable for one in
                   (terrains[index] for index in self.used_indices))  # fmt: skip

    @property
    def grounded(self) -> bool:
        """Whether rules ask how hard the ground is to cross."""
        return "walk" in self.sheet.needs or (self.scattered and self.closed)

    @property
    def scattered(self) -> bool:
        """Whether founders appear around their places, not on them."""
        return self.model.parameters.dispersion or any(
            one.scattered > 0 for one in self.sheet.people.civilisations
        )

    @property
    def _growing(self) -> list[str]:
        """The pheromones that grow on some terrain of the map."""
        found = []
        for name in self.sheet.smelt:
            values = self._of_terrains(_deposit(name, "growth"))
            if any(values[one] for one in self.used_indices):
                found.append(name)
        return found

    @property
    def grows(self) -> bool:
        """Whether the ground changes by itself."""
        return bool(self._growing) or "roads" in self.sheet.needs

    def _varies(self, what: str) -> bool:
        if what == "passability":
            values = self._of_terrains(lambda one: (one.passability, one.impassable))
            only = self._only(values)
            return only is None or bool(only[1])  # type: ignore[index]
        name, column = what.rsplit(" ", 1)
        return self._only(self._of_terrains(_deposit(name, column))) is None

    # Text -----------------------------------------------------------------------------------------

    def land(self) -> str:
        """Return the class of patches."""
        sheet = self.sheet
        base = "Ground" if self.grounded else "Patch"
        lines = [f"class Land({base}):", '    """A patch of the map."""', ""]
        if self.mapped:
            lines.append("    terrain: int = 0")
        if self.grounded and not self._varies("passability"):
            (first,) = (self.terrains[self.used_indices[0]],)
            passability = first.passability if first is not None else 20
            lines.append(f"    passability: int = {passability}")
            if "ways" in sheet.needs:
                lines.append(f"    effort: float = {max(passability, 1)}.0")
        for name in sheet.smelt:
            only = self._only(self._of_terrains(_deposit(name, "initial")))
            start = fractional(float(only)) if isinstance(only, int | float) else "0.0"
            lines.append(f"    {sheet.pheromone_fields[name]}: float = {start}")
        if lines[-1] == "":
            lines.pop()
        return "\n".join(lines)

    def tables(self, text: str) -> list[str]:
        """Return the constants of terrains that the rest of the file uses."""
        names = ", ".join("–" if one is None else one.name for one in self.terrains)
        lines = []
        if "PASSABILITY" in text:
            numbers = [str(one.passability) if one else "20" for one in self.terrains]
            closed = [str(one.impassable) if one else "False" for one in self.terrains]
            lines.append(f"# Of each terrain of the map: {names}.")
            lines += table("PASSABILITY", numbers) + table("IMPASSABLE", closed)
        for name, field in self.sheet.pheromone_fields.items():
            for column, constant in (("initial", f"FIRST_{field.upper()}"),
                                     ("growth", f"{field.upper()}_GROWTH")):  # fmt: skip
                if re.search(rf"\b{constant}\b", text):
                    values = self._of_terrains(_deposit(name, column))
                    if self._only(values) is not None and column == "growth":
                        value = values[self.used_indices[0]]
                        lines.append(f"{constant} = {written(float(value))}")  # type: ignore[arg-type]
                        continue
                    if not lines or not any("Of each terrain" in one for one in lines):
                        lines.append(f"# Of each terrain of the map: {names}.")
                    lines += table(constant, [written(float(one or 0)) for one in values])  # type: ignore[arg-type]
        return lines

    def lay_ground(self) -> str:
        """Return the rule that gives patches what their terrains have; empty for none."""
        lines = []
        if self.grounded and self._varies("passability"):
            lines += [
                "patch.passability = PASSABILITY[patch.terrain]",
                "patch.impassable = IMPASSABLE[patch.terrain]",
            ]
            if "ways" in self.sheet.needs:
                lines.append(
                    "patch.effort = math.inf if patch.impassable else max(patch.passability, 1)"
                )
        for name in self.sheet.smelt:
            if self._varies(f"{name} initial"):
                field = self.sheet.pheromone_fields[name]
                lines.append(f"patch.{field} = FIRST_{field.upper()}[patch.terrain]")
        if not lines:
            return ""
        loop = ["for patch in model.world.patches:", *(f"    {one}" for one in lines)]
        return function("lay_ground", "Give each patch what its terrain has.", loop)

    def renew(self) -> str:
        """Return the rule by which the ground changes."""
        lines = ["if (model.tick + 1) % PERIOD == 0:"]
        if self._growing:
            lines.append("    for patch in model.world.patches:")
        for name in self._growing:
            field = self.sheet.pheromone_fields[name]
            table = "[patch.terrain]" if self._varies(f"{name} growth") else ""
            lines.append(f"        patch.{field} += {field.upper()}_GROWTH{table}")
        if "roads" in self.sheet.needs:
            lines.append("    wear_off(model, model.road_evaporation)")
        what = [self.sheet.pheromone_fields[one] for one in self._growing]
        doc = f"Let {listed(what)} grow" if what else "Let roads wear off"
        if what and "roads" in self.sheet.needs:
            doc += " and roads wear off"
        return f"def renew(model):\n{sentence(f'{doc}, every {PERIOD} ticks.')}\n{block(lines)}"


def _deposit(name: str, column: str) -> object:
    """Return what says how much of a pheromone a terrain has, or gets."""

    def found(terrain: Terrain) -> float:
        return next(
            (getattr(one, column) for one in terrain.deposits if one.pheromone == name), 0.0
        )

    return found
